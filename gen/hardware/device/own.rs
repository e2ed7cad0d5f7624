//! A part in a file of one's own: a known one, and what differs.

use super::{Device, DeviceError, known};
use serde::Deserialize;
use std::collections::BTreeMap;
use std::sync::Mutex;

/// What a file says; delays are in nanoseconds.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Own {
    /// A known part of its family, which has what is not given.
    like: String,
    name: String,
    part: Part,
    multipliers: u32,
    luts: u64,
    memory_luts: u64,
    flip_flops: u64,
    /// Of 18 kbit.
    block_rams: u32,
    clock_to_output: Option<f64>,
    setup: Option<f64>,
    lut: Option<f64>,
    net: Option<f64>,
    wide_net: Option<f64>,
    carry: Option<f64>,
    carry_bit: Option<f64>,
    product: Option<f64>,
    product_behind_register: Option<f64>,
    /// Whether multipliers make chains by the adders behind them.
    chains: Option<bool>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Part {
    family: String,
    device: String,
    package: String,
    speed: String,
}

/// Files that have been read; what they say lives as long as the program.
static READ: Mutex<BTreeMap<String, &'static Device>> = Mutex::new(BTreeMap::new());

/// The part in a file.
pub(super) fn read(path: &str) -> Result<&'static Device, DeviceError> {
    let mut files = READ.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
    if let Some(device) = files.get(path) {
        return Ok(device);
    }
    let refused = |why: String| DeviceError { found: path.to_owned(), why };
    // The name is printed into every generated file.
    let letter = |c: char| c.is_ascii_alphanumeric() || "-_./".contains(c);
    if !path.chars().all(letter) {
        return Err(refused("expected a path of letters, digits, hyphens, underscores, dots and slashes".to_owned()));
    }
    let text = std::fs::read_to_string(path).map_err(|e| refused(format!("cannot be read: {e}")))?;
    let device: &Device = Box::leak(Box::new(parse(&text).map_err(refused)?));
    files.insert(path.to_owned(), device);
    Ok(device)
}

fn parse(text: &str) -> Result<Device, String> {
    let own: Own = toml::from_str(text).map_err(|e| {
        let line =
            e.span().map_or(String::new(), |span| format!("line {}: ", text[..span.start].matches('\n').count() + 1));
        format!("{line}{}", e.message())
    })?;
    let like = known(&own.like).map_err(|e| format!("like = {:?}: {}", e.found, e.why))?;
    word("name", &own.name)?;
    if known(&own.name).is_ok() {
        return Err(format!("name = {:?}: expected a name that no part of efsat has", own.name));
    }
    if own.memory_luts > own.luts {
        return Err(format!("memory_luts = {}: expected at most luts, {}", own.memory_luts, own.luts));
    }
    let names = [
        ("family", &own.part.family),
        ("device", &own.part.device),
        ("package", &own.part.package),
        ("speed", &own.part.speed),
    ];
    names.into_iter().try_for_each(|(key, name)| word(&format!("part.{key}"), name))?;
    let [family, device, package, speed] = names.map(|(_, name)| -> &'static str { name.clone().leak() });
    let delay = |key: &str, given: Option<f64>, usual: f64, least: f64| match given {
        Some(ns) if !(least..=100.0).contains(&ns) => Err(format!("{key} = {ns}: expected {least} to 100 ns")),
        _ => Ok(given.unwrap_or(usual)),
    };
    let product = (
        delay("product", own.product, like.product.0, 0.01)?,
        if own.product.is_some() { 0.0 } else { like.product.1 },
    );
    let behind = delay("product_behind_register", own.product_behind_register, like.product_behind_register, 0.0)?;
    // Where a key is not given its value is the known part's.
    let of = |given: Option<f64>| if given.is_some() { String::new() } else { format!(" of {}", like.name) };
    if behind > product.0 {
        let whose = of(own.product_behind_register);
        return Err(format!("product_behind_register = {behind}{whose}: expected at most product, {}", product.0));
    }
    let adder = match own.chains {
        Some(false) => 0,
        Some(true) if like.adder == 0 => return Err(format!("chains = true: expected false, as of {}", like.name)),
        _ => like.adder,
    };
    let clock_to_output = delay("clock_to_output", own.clock_to_output, like.clock_to_output, 0.01)?;
    let (net, wide_net) = (delay("net", own.net, like.net, 0.0)?, delay("wide_net", own.wide_net, like.wide_net, 0.0)?);
    if wide_net < net {
        return Err(format!("wide_net = {wide_net}{}: expected at least net, {net}", of(own.wide_net)));
    }
    Ok(Device {
        name: own.name.leak(),
        part: super::Part { family, device, package, speed },
        capacity: super::Resources {
            multipliers: own.multipliers.into(),
            luts: own.luts,
            memory_luts: own.memory_luts,
            flip_flops: own.flip_flops,
            carry: own.luts,
        },
        multipliers: own.multipliers,
        block_rams: own.block_rams,
        source: "a file of the user",
        clock_to_output,
        // What its net takes more stays.
        product_to_output: clock_to_output + like.product_to_output - like.clock_to_output,
        setup: delay("setup", own.setup, like.setup, 0.0)?,
        lut: delay("lut", own.lut, like.lut, 0.01)?,
        net,
        wide_net,
        carry: delay("carry", own.carry, like.carry, 0.01)?,
        carry_bit: delay("carry_bit", own.carry_bit, like.carry_bit, 0.0)?,
        product,
        product_behind_register: behind,
        adder,
        ..like.clone()
    })
}

/// What stands in project files and reports is one word.
fn word(key: &str, value: &str) -> Result<(), String> {
    let letter = |c: char| c.is_ascii_alphanumeric() || "-_.".contains(c);
    if !value.is_empty() && value.len() <= 64 && value.chars().all(letter) {
        return Ok(());
    }
    Err(format!("{key} = {value:?}: expected 1 to 64 letters, digits, hyphens, underscores and dots"))
}

#[cfg(test)]
mod tests {
    use super::*;

    const KINTEX: &str = "like = 'xc7a200t-1'\nname = 'xc7k325t-2'\nmultipliers = 840\nluts = 203800\nmemory_luts = 64000\n\
        flip_flops = 407600\nblock_rams = 890\nlut = 0.05\n\
        [part]\nfamily = 'Kintex7'\ndevice = 'xc7k325t'\npackage = 'ffg900'\nspeed = '-2'\n";

    #[test]
    fn what_is_not_given_is_that_of_the_known_part() {
        let (own, like) = (parse(KINTEX).unwrap(), known("xc7a200t-1").unwrap());
        assert_eq!((own.name, own.part.device, own.multipliers, own.lut), ("xc7k325t-2", "xc7k325t", 840, 0.05));
        assert_eq!((own.net, own.product, own.family, own.fabric), (like.net, like.product, like.family, like.fabric));
        assert_eq!((own.adder, parse(&KINTEX.replace("lut = 0.05", "chains = false")).unwrap().adder), (like.adder, 0));
    }

    #[test]
    fn nets_behind_multipliers_stay_longer_than_others() {
        let text = KINTEX.replace("xc7a200t-1", "lfe5u-85-6").replace("lut = 0.05", "clock_to_output = 0.4");
        let (own, like) = (parse(&text).unwrap(), known("lfe5u-85-6").unwrap());
        assert!((own.product_to_output - (like.product_to_output - 0.12)).abs() < 1e-9, "{}", own.product_to_output);
    }

    #[test]
    fn faults_are_named() {
        let with = |from: &str, to: &str| parse(&KINTEX.replace(from, to)).unwrap_err();
        let like = with("xc7a200t-1", "xc7");
        assert!(
            like.starts_with("like = \"xc7\": expected one of xc2v6000-4, ") && like.ends_with("lifcl-40-9"),
            "{like}"
        );
        assert_eq!(with("lut = 0.05", "lut = 0"), "lut = 0: expected 0.01 to 100 ns");
        assert_eq!(with("lut = 0.05", "lut = nan"), "lut = NaN: expected 0.01 to 100 ns");
        assert_eq!(
            with("lut = 0.05", "product_behind_register = 9"),
            "product_behind_register = 9: expected at most product, 4.036"
        );
        assert_eq!(
            with("'xc7k325t-2'", "'xc7a200t-1'"),
            "name = \"xc7a200t-1\": expected a name that no part of efsat has"
        );
        assert_eq!(
            with("memory_luts = 64000", "memory_luts = 203801"),
            "memory_luts = 203801: expected at most luts, 203800"
        );
        assert_eq!(with("lut = 0.05", "net = 9"), "wide_net = 1.5 of xc7a200t-1: expected at least net, 9");
        assert_eq!(with("lut = 0.05", "net = 9\nwide_net = 8"), "wide_net = 8: expected at least net, 9");
        assert!(with("lut = 0.05", "luts = 9").contains("line 8"));
        assert!(
            with("lut = 0.05", "speed_of_light = 9").contains("speed_of_light"),
            "{}",
            with("lut = 0.05", "speed_of_light = 9")
        );
        assert!(with("multipliers = 840", "").contains("multipliers"));
        let chains = |part: &str| parse(&KINTEX.replace("xc7a200t-1", part).replace("lut = 0.05", "chains = true"));
        assert_eq!(chains("lfe5u-85-6").unwrap_err(), "chains = true: expected false, as of lfe5u-85-6");
        assert!(with("'xc7k325t'", "'a b; exec c'").starts_with("part.device = "));
    }
}
