//! What a sweep goes over, as it is written: `width=10..32,upper=implied|sticky; device=lfe5u-85-6`.
//!
//! ```text
//! sweep   = grid { ";" grid }
//! grid    = setting { "," setting }          every combination of the values of its settings
//! setting = option "=" values
//! values  = value { "|" value }
//! value   = word | number ".." number [ "/" step ]
//! ```
//!
//! Options are those of the design without their dashes; what a grid does not name is as on the command line. Blanks
//! are free.

/// The sweep where none is given: one option at a time around the point given, and the combinations that matter.
pub const DEFAULT: &str = "width=10..32; \
    width=10..32,projections=all,projection-width=rounded,axis-shift=0,edge-test=off; \
    axis-shift=0|1|2|3|5|30; projection-width=rounded|+0|+2|+8|full; edge-test=off; \
    width=10..32,frequency=250; \
    width=10..32,upper=sticky,projections=intersect; \
    width=10..30/2,renormalise=off; \
    width=12..22/2|24|28|32,axes-per-clock=2|3|6|11; \
    width=14..32/2,axes=17,upper=sticky,projections=intersect; \
    transform-width=18|20|24|28|40|48; upper=sticky; projections=all|skip|intersect; axes=17; frequency=50|150|200; \
    width=12|18|25|32,device=xc6slx150-3|xc7a200t-1|lfe5u-85-6; \
    width=24..32/4,transform-width=48,axes=17,upper=sticky,projections=intersect; \
    method=determinants,width=10..32; method=determinants,clocks-per-pair=2|3|6|11; \
    method=determinants,bound=static|edges|products; method=determinants,bound=products,span=3,clocks-per-pair=1|2; \
    method=determinants,transform=off,clocks-per-pair=1|2; method=determinants,device=xc7a200t-1|lfe5u-85-6";

/// An option with the value that a combination gives it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Setting {
    /// The option, without dashes.
    pub option: String,
    /// The value, as the command line spells it.
    pub value: String,
    /// Where the value is written, in characters from 1.
    pub at: usize,
}

/// What is wrong with a sweep, and where.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("at character {at}: found {found}; expected {legal}")]
pub struct SweepError {
    /// Characters from 1.
    pub at: usize,
    /// What is there.
    pub found: String,
    /// What could be.
    pub legal: String,
}

/// The most combinations of a sweep.
const MOST: usize = 100_000;

/// A part of the text and where it begins, in characters from 1.
type Part<'a> = (usize, &'a str);
/// Values and where they are written.
type Values = Vec<(usize, String)>;

/// The combinations of a sweep, grid by grid, the last setting of a grid changing fastest; `options` are the legal
/// options.
///
/// # Errors
/// The first thing that is wrong. Values are words to this function, and so right.
pub fn parse(text: &str, options: &[&str]) -> Result<Vec<Vec<Setting>>, SweepError> {
    let mut all = vec![];
    for grid in split((1, text), ';') {
        let mut combinations: Vec<Vec<Setting>> = vec![vec![]];
        for setting in split(grid, ',') {
            let (option, values) = parse_setting(setting, options)?;
            if let Some(twice) = combinations[0].iter().find(|known| known.option == option) {
                let found = format!("{option} again (first at character {})", twice.at);
                return Err(SweepError { at: setting.0, found, legal: "each option once in a grid".to_owned() });
            }
            if all.len() + combinations.len() * values.len() > MOST {
                let legal = format!("a sweep of at most {MOST}");
                return Err(SweepError { at: setting.0, found: "too many combinations".to_owned(), legal });
            }
            let with = |known: &Vec<Setting>, (at, value): &(usize, String)| {
                let setting = Setting { option: option.to_owned(), value: value.clone(), at: *at };
                known.iter().cloned().chain([setting]).collect::<Vec<_>>()
            };
            combinations = combinations.iter().flat_map(|known| values.iter().map(move |v| with(known, v))).collect();
        }
        all.extend(combinations);
    }
    Ok(all)
}

/// The parts between separators, trimmed.
fn split<'a>((at, text): Part<'a>, separator: char) -> impl Iterator<Item = Part<'a>> {
    let mut next = at;
    text.split(separator).map(move |part| {
        let blanks = part.chars().take_while(|c| c.is_whitespace()).count();
        let found = (next + blanks, part.trim());
        next += part.chars().count() + 1;
        found
    })
}

fn parse_setting<'a>((at, text): Part<'a>, options: &[&str]) -> Result<(&'a str, Values), SweepError> {
    let legal = || format!("OPTION=VALUES with OPTION one of {}", options.join(", "));
    let quoted = |text: &str| if text.is_empty() { "nothing".to_owned() } else { format!("'{text}'") };
    let Some((option, values)) = text.split_once('=') else {
        return Err(SweepError { at, found: quoted(text), legal: legal() });
    };
    let begin = at + option.chars().count() + 1;
    let option = option.trim();
    if !options.contains(&option) {
        return Err(SweepError { at, found: quoted(option), legal: legal() });
    }
    let mut found = vec![];
    for (at, value) in split((begin, values), '|') {
        let error = |legal: &str| SweepError { at, found: quoted(value), legal: legal.to_owned() };
        match value.split_once("..") {
            _ if value.is_empty() => return Err(error("a value of the option")),
            None => found.push((at, value.to_owned())),
            Some((first, rest)) => {
                let (last, step) = rest.split_once('/').unwrap_or((rest, "1"));
                let number = |text: &str| text.trim().parse::<u32>().ok().filter(|n| *n <= 10_000);
                let (Some(first), Some(last), Some(step)) = (number(first), number(last), number(step)) else {
                    return Err(error("FIRST..LAST or FIRST..LAST/STEP in whole numbers"));
                };
                if first > last || step == 0 {
                    return Err(error("FIRST..LAST with FIRST not above LAST, and a STEP from 1"));
                }
                found.extend((first..=last).step_by(step as usize).map(|n| (at, n.to_string())));
            }
        }
    }
    Ok((option, found))
}

#[cfg(test)]
mod tests {
    use super::*;

    const OPTIONS: [&str; 3] = ["width", "axes", "upper"];

    fn texts(text: &str) -> Vec<String> {
        let text_of = |settings: &Vec<Setting>| {
            settings.iter().map(|s| format!("{}={}", s.option, s.value)).collect::<Vec<_>>().join(" ")
        };
        parse(text, &OPTIONS).unwrap().iter().map(text_of).collect()
    }

    #[test]
    fn grids_are_all_combinations() {
        assert_eq!(
            texts("width=12..14,axes=11|17; upper = sticky"),
            [
                "width=12 axes=11",
                "width=12 axes=17",
                "width=13 axes=11",
                "width=13 axes=17",
                "width=14 axes=11",
                "width=14 axes=17",
                "upper=sticky"
            ]
        );
        assert_eq!(texts("width=10..15/2|32"), ["width=10", "width=12", "width=14", "width=32"]);
    }

    #[test]
    fn errors_name_the_place_and_what_is_legal() {
        let error = |text: &str| parse(text, &OPTIONS).unwrap_err().to_string();
        let legal = "expected OPTION=VALUES with OPTION one of width, axes, upper";
        assert_eq!(error(""), format!("at character 1: found nothing; {legal}"));
        assert_eq!(error("width=12; wide=3"), format!("at character 11: found 'wide'; {legal}"));
        assert_eq!(error("width=12,axes"), format!("at character 10: found 'axes'; {legal}"));
        assert_eq!(error("axes=11|"), "at character 9: found nothing; expected a value of the option");
        assert!(error("width=12..x").starts_with("at character 7: found '12..x'; expected FIRST..LAST"));
        assert!(
            error("axes=11, width= 20..12").starts_with("at character 17: found '20..12'; expected FIRST..LAST with")
        );
        assert!(error("width=1,width=2").starts_with("at character 9: found width again"));
        assert!(error("width=0..9999,axes=0..9999").contains("too many combinations"));
    }

    #[test]
    fn the_default_sweep_holds_every_width() {
        let names: Vec<&str> = efsat_unit::params::Params::OPTIONS.iter().map(|option| option.name).collect();
        let all = parse(DEFAULT, &names).unwrap();
        let alone =
            |width: u32| all.iter().any(|s| s.len() == 1 && s[0].option == "width" && s[0].value == width.to_string());
        assert!((10..=32).all(alone) && all.len() > 100);
    }
}
