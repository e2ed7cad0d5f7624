//! Faults of GHDL 2.0's Verilog, and what makes them good.

use std::collections::HashMap;

/// Applies every fix to a Verilog text.
///
/// # Errors
/// What cannot be mended, in words.
pub fn all(text: &str) -> Result<String, String> {
    complete_cases(text)?;
    let text = without_self_assignments(&binary_literals(text)?);
    Ok(text.split_inclusive("endmodule").map(signed_products).collect())
}

/// GHDL 2.0 forgets the last arm of a case, which makes it a latch, but where all values have arms: reading a table.
fn complete_cases(text: &str) -> Result<(), String> {
    let complete = |case: &str| {
        let arms: Vec<&str> = case.lines().skip(1).filter_map(|line| Some(line.split_once(':')?.0.trim())).collect();
        let bits = arms.first().and_then(|arm| arm.split_once('\'')?.0.parse::<u32>().ok());
        arms.contains(&"default") || bits.is_some_and(|bits| 1usize.checked_shl(bits) == Some(arms.len()))
    };
    let mut cases = text.split("endcase").filter_map(|before| Some(before.rsplit_once("case (")?.1));
    if cases.all(complete) { Ok(()) } else { Err("a case without its last arm".to_owned()) }
}

/// GHDL 2.0 writes constants of more than 32 bits as strings, which Verilog reads as characters.
fn binary_literals(text: &str) -> Result<String, String> {
    let part = |(i, part): (usize, &str)| match i % 2 {
        0 => Ok(part.to_owned()),
        _ if part.contains(|c| c != '0' && c != '1') => Err(format!("a string that is no constant: {part}")),
        _ => Ok(format!("{}'b{part}", part.len())),
    };
    text.split('"').enumerate().map(part).collect()
}

/// GHDL 2.0 assigns a signal behind the output of an instance to itself where both have one name: a loop without gates.
fn without_self_assignments(text: &str) -> String {
    let loops = |line: &str| {
        let assignment = line.trim().strip_prefix("assign ").and_then(|rest| rest.split_once(';'));
        assignment.and_then(|(assignment, _)| assignment.split_once(" = ")).is_some_and(|(to, from)| to == from)
    };
    text.split_inclusive('\n').filter(|line| !loops(line)).collect()
}

/// GHDL 2.0 writes a signed product as an unsigned one of operands extended to the width of the product. That is the
/// same number on twice the bits, six multipliers instead of one; this writes it as it was meant.
fn signed_products(module: &str) -> String {
    let assignment = |line: &str, end: &str| -> Option<(String, String)> {
        let (name, value) = line.trim().strip_prefix("assign ")?.split_once(" = ")?;
        Some((name.to_owned(), value.strip_suffix(end)?.to_owned()))
    };
    let extended: HashMap<String, String> = module
        .lines()
        .filter_map(|line| {
            let (name, value) = assignment(line, "}; // sext")?;
            Some((name, value.rsplit_once("}, ")?.1.to_owned()))
        })
        .collect();
    let product = |line: &str| -> Option<String> {
        let (name, value) = assignment(line, "; // smul")?;
        let (x, y) = value.split_once(" * ")?;
        Some(format!("  assign {name} = $signed({}) * $signed({});", extended.get(x)?, extended.get(y)?))
    };
    module.split_inclusive('\n').map(|line| product(line).map_or_else(|| line.to_owned(), |new| new + "\n")).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn long_constants_are_numbers() {
        assert_eq!(binary_literals("a = \"0110\";").unwrap(), "a = 4'b0110;");
        assert!(binary_literals("a = \"yes\";").is_err());
    }

    #[test]
    fn signed_products_are_signed() {
        let text = "  assign n1 = {{18{a[17]}}, a}; // sext\n  assign n2 = {{18{b[17]}}, b}; // sext\n\
                    \x20 assign n3 = n1 * n2; // smul\nendmodule\n";
        assert!(all(text).unwrap().contains("  assign n3 = $signed(a) * $signed(b);\n"));
        // What newer versions write stays.
        let newer = "  assign n3 = $signed(a) * $signed(b);\nendmodule\n";
        assert_eq!(all(newer).unwrap(), newer);
    }

    #[test]
    fn signals_are_not_assigned_to_themselves() {
        let text = "  assign a_lo = a_lo; // (signal)\n  assign a_hi = a_lo;\nendmodule\n";
        assert_eq!(all(text).unwrap(), "  assign a_hi = a_lo;\nendmodule\n");
    }

    #[test]
    fn a_case_needs_its_last_arm() {
        assert!(all("case (s)\n1'b0: q = a;\nendcase\n").is_err());
        assert!(all("case (s)\n1'b0: q = a;\n1'b1: q = b;\nendcase\n").is_ok());
        assert!(all("case (s)\n1'b0: q = a;\ndefault: q = b;\nendcase\n").is_ok());
    }
}
