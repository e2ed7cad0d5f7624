//! What the options of an engine and those of the unit behind it have to agree on.

use super::{EngineFormat, ORIGIN_OVER_OFFSET};
use crate::params::EngineParams;
use crate::words::BlockLayout;
use efsat_unit::params::options::Choice;
use efsat_unit::params::{Method, ParamError, Params, Transform};

impl EngineParams {
    /// Checks every range, and every relation between options and with those of the unit behind the engine, and derives the
    /// formats.
    ///
    /// # Errors
    /// The first option outside its range, with the legal range.
    pub fn format(&self, unit: &Params) -> Result<EngineFormat, ParamError> {
        unit.validate()?;
        if unit.method == Method::Exact && unit.transform != Transform::On {
            let found = unit.truth.name().to_owned();
            let legal = "expected snapped with --transform-width 26 in the engine, which gives the unit both triangles in their \
                own frames";
            return Err(ParamError { option: "truth", found, legal: legal.to_owned() });
        }
        if unit.transform != Transform::On {
            let found = unit.transform.name().to_owned();
            let legal = "expected on: the engine gives the unit both triangles in their own frames".to_owned();
            return Err(ParamError { option: "transform", found, legal });
        }
        self.ranges()?;
        let wrong = |option, found: u32, legal: String| Err(ParamError { option, found: found.to_string(), legal });
        let format = EngineFormat::new(self, unit);
        let most = self.offset_bits + ORIGIN_OVER_OFFSET;
        if self.origin_bits > most {
            let legal = format!(
                "expected at most {most}, the bits of a code and {ORIGIN_OVER_OFFSET}: origins lie on the grid of codes"
            );
            return wrong("origin-bits", self.origin_bits, legal);
        }
        if format.shift_error_bound() >= 1 << format.shift_error_bits() {
            let legal = "expected more: the error of a shift would not fit its 16 bits (origin-bits, and transform-width \
                less int-bits, against offset-bits)";
            return wrong("origin-bits", self.origin_bits, legal.to_owned());
        }
        if format.rest_at() + format.rest_bits() > u64::BITS {
            let most = (u64::BITS - format.rest_bits()) / 3 - format.choice_bits();
            let legal = format!(
                "expected at most {most} with --directions {} --offset-bits {}: a row of a query has 64 bits",
                format.k(),
                self.offset_bits
            );
            return wrong("factor-bits", self.factor_bits, legal);
        }
        let bits = format.block().bits;
        if bits > BlockLayout::MOST_BITS {
            let legal = format!("expected fewer: a block would have {bits} bits of {}", BlockLayout::MOST_BITS);
            return wrong("offset-bits", self.offset_bits, legal);
        }
        self.block_numbers()?;
        let (all, usual) = (self.options(), Self::default().options());
        self.refuse_of_port(all.iter().filter(|option| !usual.contains(option)))?;
        let least = 3 * self.tree_height + 2;
        if self.stack < least {
            return wrong("stack", self.stack, format!("expected at least 3 x tree-height + 2 = {least}"));
        }
        Ok(format)
    }
}
