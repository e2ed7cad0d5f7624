//! As much of a shell as pages use: words, quotes, comments, and what stands between commands.

/// The commands of a text, each as its words, without settings of variables before it and files behind it.
pub fn commands(text: &str) -> Vec<Vec<String>> {
    let mut commands = vec![vec![]];
    let mut word: Option<String> = None;
    let mut signs = text.chars().peekable();
    let end_of_word = |word: &mut Option<String>, commands: &mut Vec<Vec<String>>| {
        commands.last_mut().expect("one at least").extend(word.take());
    };
    while let Some(sign) = signs.next() {
        match sign {
            '\\' => match signs.next() {
                Some('\n') | None => {}
                Some(next) => word.get_or_insert_default().push(next),
            },
            '\'' | '"' => {
                let inner: String = signs.by_ref().take_while(|&c| c != sign).collect();
                word.get_or_insert_default().push_str(&inner);
            }
            '#' if word.is_none() => while signs.next_if(|&c| c != '\n').is_some() {},
            '\n' | ';' | '|' | '&' => {
                end_of_word(&mut word, &mut commands);
                commands.push(vec![]);
            }
            '>' | '<' => {
                end_of_word(&mut word, &mut commands);
                commands.last_mut().expect("one at least").push(">".to_owned());
            }
            _ if sign.is_whitespace() => end_of_word(&mut word, &mut commands),
            _ => word.get_or_insert_default().push(sign),
        }
    }
    end_of_word(&mut word, &mut commands);
    commands.into_iter().map(plain).filter(|words| !words.is_empty()).collect()
}

/// A command without `NAME=value` before it, and without `> file` in it.
fn plain(words: Vec<String>) -> Vec<String> {
    let setting = |word: &String| {
        let name = word.split_once('=').map_or("", |(name, _)| name);
        !name.is_empty() && name.chars().all(|c| c.is_ascii_uppercase() || c == '_')
    };
    let mut words = words.into_iter().skip_while(setting);
    let mut found = vec![];
    while let Some(word) = words.next() {
        if word == ">" {
            words.next();
        } else {
            found.push(word);
        }
    }
    found
}

#[test]
fn commands_are_told_apart() {
    let text = "A=1 B_C='x y' a 'b # c' d\\\n  e # f 'g\n./h > i j 2>&1 | k=1 \"l\" && m\n\n# n\no; p";
    let expected: [&[&str]; 7] =
        [&["a", "b # c", "d", "e"], &["./h", "j", "2"], &["1"], &["k=1", "l"], &["m"], &["o"], &["p"]];
    assert_eq!(commands(text), expected);
}
