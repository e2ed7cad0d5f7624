//! Types of values: how many bits, with a sign or without, and where the binary point is.

/// Type of a value: a two's-complement or unsigned integer of `bits` bits. One unsigned bit is a flag.
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
pub struct Type {
    /// Whether the top bit is a sign.
    pub signed: bool,
    /// Number of bits, at least one.
    pub bits: u32,
    /// Fraction bits, possibly negative: the unit in the last place is 2^-fraction. `None` for what has no binary point
    /// (flags, selectors) and where the point moves with the phase.
    pub fraction: Option<i32>,
}

/// A set of integers from the first to the second bound, both included.
pub type Range = (i128, i128);

impl Type {
    /// One bit.
    pub const FLAG: Self = Self::unsigned(1);

    /// A signed number.
    pub const fn signed(bits: u32, fraction: i32) -> Self {
        Self { signed: true, bits, fraction: Some(fraction) }
    }

    /// An unsigned integer without a binary point.
    pub const fn unsigned(bits: u32) -> Self {
        Self { signed: false, bits, fraction: None }
    }

    /// The unsigned type that counts from 0 to `count - 1`.
    pub const fn index(count: usize) -> Self {
        let most = if count > 2 { count - 1 } else { 1 };
        Self::unsigned(usize::BITS - most.leading_zeros())
    }

    /// Whether it is one unsigned bit.
    pub fn is_flag(self) -> bool {
        !self.signed && self.bits == 1
    }

    /// The least and the greatest value.
    pub const fn limits(self) -> Range {
        if self.signed { (-(1 << (self.bits - 1)), (1 << (self.bits - 1)) - 1) } else { (0, (1 << self.bits) - 1) }
    }

    /// Whether values of a range fit.
    pub const fn holds(self, range: Range) -> bool {
        let (least, greatest) = self.limits();
        least <= range.0 && range.1 <= greatest
    }

    /// Whether it has the same bits as another type, wherever the binary point is.
    pub fn same_bits(self, other: Self) -> bool {
        (self.signed, self.bits) == (other.signed, other.bits)
    }

    /// The bits of a value, read in this type.
    pub fn wrap(self, value: i128) -> i128 {
        let low = value & ((1 << self.bits) - 1);
        if self.signed && low >> (self.bits - 1) == 1 { low - (1 << self.bits) } else { low }
    }

    /// The common type of values that are chosen among or compared: the widest.
    pub(crate) fn joint(types: &[Self]) -> Result<Self, String> {
        let (first, rest) = types.split_first().ok_or("expected an operand")?;
        rest.iter().try_fold(*first, |joint, t| {
            if t.signed != joint.signed {
                return Err(format!("expected operands of one sign, found {joint} and {t}"));
            }
            let fraction = common_point(joint, *t)?;
            Ok(Self { bits: joint.bits.max(t.bits), fraction, ..joint })
        })
    }
}

/// The binary point of two values that are added or compared; what has none adapts to the other.
pub(crate) fn common_point(a: Type, b: Type) -> Result<Option<i32>, String> {
    match (a.fraction, b.fraction) {
        (Some(x), Some(y)) if x != y => Err(format!("expected one binary point, found {a} and {b}")),
        (x, y) => Ok(x.or(y)),
    }
}

/// `s4.28`; `18 bits` without a binary point.
impl std::fmt::Display for Type {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self.fraction {
            Some(fraction) => {
                write!(f, "{}{}.{fraction}", if self.signed { 's' } else { 'u' }, self.bits as i32 - fraction)
            }
            None if self.is_flag() => write!(f, "flag"),
            None => write!(f, "{} bits", self.bits),
        }
    }
}

impl std::fmt::Debug for Type {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{self}")
    }
}
