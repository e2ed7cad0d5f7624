//! The ready designs: those that are generated ahead, each in a folder of its own.

use crate::params::{Method, Params};
use crate::words::StreamWidth;

/// A design that is generated ahead for its users.
pub struct ReadyDesign {
    /// Its folder.
    pub name: &'static str,
    /// What it is for.
    pub what: &'static str,
    /// The options that make it, where they are not the defaults.
    pub options: &'static str,
    /// Those options as values.
    pub params: Params,
    /// Words of its stream wrapper.
    pub stream_width: StreamWidth,
}

/// The ready designs, the default first.
pub fn ready_designs() -> [ReadyDesign; 5] {
    let determinants = |clocks_per_pair| Params { method: Method::Determinants, clocks_per_pair, ..Params::default() };
    [
        ReadyDesign {
            name: "axes",
            what: "Separating axes, the default: few multipliers, few undecided pairs.",
            options: "",
            params: Params::default(),
            stream_width: StreamWidth::default(),
        },
        ReadyDesign {
            name: "paper",
            what: "Separating axes with the roundings of the paper.",
            options: "--like-paper",
            params: Params::paper(),
            stream_width: StreamWidth::default(),
        },
        ReadyDesign {
            name: "determinants",
            what: "Determinants, one pair per clock.",
            options: "--method determinants --stream-width 1024",
            params: determinants(1),
            stream_width: StreamWidth::Bits1024,
        },
        ReadyDesign {
            name: "determinants-2",
            what: "Determinants, one pair every two clocks.",
            options: "--method determinants --clocks-per-pair 2 --stream-width 512",
            params: determinants(2),
            stream_width: StreamWidth::Bits512,
        },
        ReadyDesign {
            name: "exact",
            what: "For points on a grid: exact, no pair undecided, one pair per clock.",
            options: "--method exact --stream-width 1024",
            params: Params::of(Method::Exact),
            stream_width: StreamWidth::Bits1024,
        },
    ]
}
