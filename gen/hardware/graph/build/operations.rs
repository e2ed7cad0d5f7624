//! The operations of signals, as methods and operators.

use super::Sig;
use crate::graph::block::Op;
use crate::op::*;
use std::ops;

/// Shorthand for operations.
impl<'l> Sig<'l> {
    /// A constant with this signal's type.
    ///
    /// ```
    /// # use efsat_hardware::testing::examples::*;
    /// assert_eq!(value(&[5], |x| x[0] - x[0].like(2)), 3);
    /// ```
    pub fn like(self, value: i128) -> Self {
        self.block().constant(value, self.ty())
    }

    /// The bits above the lowest `drop`, or with a negative number that many zeros appended: the value rounded toward
    /// minus infinity to fewer fraction bits, or with more of them.
    ///
    /// ```
    /// # use efsat_hardware::testing::examples::*;
    /// assert_eq!(value(&[-13], |x| x[0].floor(2)), -4);
    /// assert_eq!(value(&[-13], |x| x[0].floor(-2)), -52);
    /// ```
    pub fn floor(self, drop: i32) -> Self {
        match drop {
            0 => self,
            1.. => self.apply(Floor(drop as u32), &[]),
            _ => self.apply(Append(drop.unsigned_abs()), &[]),
        }
    }

    /// Multiplied by a power of two in as many bits: nothing but signs may be shifted out.
    ///
    /// ```
    /// # use efsat_hardware::testing::examples::*;
    /// assert_eq!(value(&[-13], |x| x[0].shift_left(2)), -52);
    /// ```
    pub fn shift_left(self, bits: u32) -> Self {
        self.apply(ShiftLeft(bits), &[])
    }

    /// The lowest bits.
    ///
    /// ```
    /// # use efsat_hardware::testing::examples::*;
    /// assert_eq!(value(&[13], |x| x[0].low(3)), 0b101);
    /// ```
    pub fn low(self, bits: u32) -> Self {
        if self.ty() == Type::unsigned(bits) { self } else { self.apply(LowBits(bits), &[]) }
    }

    /// The same value in a type. A sum or choice that has no name yet is made in as many bits at once.
    ///
    /// ```
    /// # use efsat_hardware::testing::examples::*;
    /// assert_eq!(value(&[-13], |x| x[0].resize(Type::signed(40, 0))), -13);
    /// ```
    pub fn resize(self, ty: Type) -> Self {
        let own = self.ty();
        let (op, args, named) = self.node(|n| (n.op.clone(), n.args.clone(), n.named));
        let bits = Some(ty.bits);
        let sum: Option<Comb> = match op {
            Op::Comb(Comb::Add(_)) => Some(Add(bits).into()),
            Op::Comb(Comb::Subtract(_)) => Some(Subtract(bits).into()),
            Op::Comb(Comb::Negate(_)) => Some(Negate(bits).into()),
            Op::Comb(Comb::Select(_)) => Some(Select(bits).into()),
            _ => None,
        };
        match sum.filter(|_| !named && ty.bits < own.bits && ty.signed == own.signed) {
            _ if own == ty => self,
            Some(sum) => {
                let args: Vec<Self> = args.iter().map(|id| Self { id: *id, ..self }).collect();
                args[0].apply(sum, &args[1..]).resize(ty)
            }
            None => self.apply(Resize(ty), &[]),
        }
    }

    /// The same value in so many bits of its own kind.
    ///
    /// ```
    /// # use efsat_hardware::testing::examples::*;
    /// assert_eq!(value(&[500], |x| (x[0] - x[0].like(1)).bits(11)), 499);
    /// ```
    pub fn bits(self, bits: u32) -> Self {
        self.resize(Type { bits, ..self.ty() })
    }

    /// Flag: some bit is set.
    ///
    /// ```
    /// # use efsat_hardware::testing::examples::*;
    /// assert_eq!([0, 8].map(|a| value(&[a], |x| x[0].low(4).any())), [0, 1]);
    /// ```
    pub fn any(self) -> Self {
        if self.ty().is_flag() { self.at_point(None) } else { self.apply(OrReduce, &[]) }
    }

    /// Flag: it is negative.
    ///
    /// ```
    /// # use efsat_hardware::testing::examples::*;
    /// assert_eq!([-1, 0].map(|a| value(&[a], |x| x[0].negative())), [1, 0]);
    /// ```
    pub fn negative(self) -> Self {
        self.apply(SignBit, &[])
    }

    /// Absolute value.
    ///
    /// ```
    /// # use efsat_hardware::testing::examples::*;
    /// assert_eq!(value(&[-13], |x| x[0].magnitude()), 13);
    /// ```
    pub fn magnitude(self) -> Self {
        self.apply(Magnitude, &[])
    }

    /// The greater of the number and zero in so many bits, without a sign.
    ///
    /// ```
    /// # use efsat_hardware::testing::examples::*;
    /// assert_eq!([-13, 13].map(|a| value(&[a], |x| x[0].positive(10))), [0, 13]);
    /// ```
    pub fn positive(self, bits: u32) -> Self {
        if self.range().1 >> bits > 0 {
            self.refuse(&format!("values up to {} do not fit {bits} bits", self.range().1));
        }
        let magnitude = self.low(bits);
        self.negative().choose(magnitude.like(0), magnitude)
    }

    /// The sum of two numbers and a flag in one carry chain.
    ///
    /// ```
    /// # use efsat_hardware::testing::examples::*;
    /// assert_eq!(value(&[13, 4], |x| x[0].plus(x[1], x[1].less(x[0]))), 18);
    /// ```
    pub fn plus(self, other: Self, carry: Self) -> Self {
        let fraction = self.ty().fraction;
        let below = |low: Self, x: Self| low.below(&[x.at_point(None)]);
        (below(self.block().constant(1, Type::FLAG), self) + below(carry, other)).floor(1).at_point(fraction)
    }

    /// Flag: both are equal.
    ///
    /// ```
    /// # use efsat_hardware::testing::examples::*;
    /// assert_eq!(value(&[13, 4], |x| x[0].equals(x[1])), 0);
    /// ```
    pub fn equals(self, other: Self) -> Self {
        self.apply(Equal, &[other])
    }

    /// Flag: it is less than another.
    ///
    /// ```
    /// # use efsat_hardware::testing::examples::*;
    /// assert_eq!(value(&[4, 13], |x| x[0].less(x[1])), 1);
    /// ```
    pub fn less(self, other: Self) -> Self {
        self.apply(Less, &[other])
    }

    /// Within `[-bound, bound]`: sound where the true value lies inside by the lemma.
    ///
    /// ```
    /// # use efsat_hardware::testing::examples::*;
    /// assert_eq!([-70, 7, 70].map(|a| value(&[a], |x| x[0].saturate(50, "the true value is"))), [-50, 7, 50]);
    /// ```
    pub fn saturate(self, bound: i128, lemma: &'static str) -> Self {
        let ty = self.ty();
        let (most, least) = (self.block().constant(bound, ty), self.block().constant(-bound, ty));
        let bits = 129 - bound.leading_zeros();
        let inside = self.less(least).called("too_low").choose(least, self).called("raised");
        let saturated = most.less(self).called("too_high").choose(most, inside).called("saturated");
        saturated.assume_range((-bound, bound), lemma, &[]).bits(bits.min(ty.bits))
    }

    /// Negated where the flag is set.
    ///
    /// ```
    /// # use efsat_hardware::testing::examples::*;
    /// assert_eq!(value(&[4, -1], |x| x[0].negate_if(x[1].negative())), -4);
    /// ```
    pub fn negate_if(self, flag: Self) -> Self {
        flag.apply(NegateIf, &[self])
    }

    /// Entry of a table by this index.
    ///
    /// ```
    /// # use efsat_hardware::testing::examples::*;
    /// assert_eq!(value(&[2], |x| x[0].low(2).at_point(None).lookup(vec![7, 1, 5, 3], Type::unsigned(3))), 5);
    /// ```
    pub fn lookup(self, table: Vec<i128>, ty: Type) -> Self {
        self.apply(Lookup(table, ty), &[])
    }

    /// This in the low bits, others above it.
    ///
    /// ```
    /// # use efsat_hardware::testing::examples::*;
    /// let word = |low, high| value(&[low, high], |x| x[0].low(4).at_point(None).below(&[x[1]]));
    /// assert_eq!(word(5, -2), -2 * 16 + 5);
    /// ```
    pub fn below(self, others: &[Self]) -> Self {
        if others.is_empty() { self } else { self.apply(Concatenate, others) }
    }
}

macro_rules! operator {
    ($($trait:ident $method:ident $op:expr),*) => {
        $(impl ops::$trait for Sig<'_> {
            type Output = Self;

            fn $method(self, other: Self) -> Self {
                self.apply($op, &[other])
            }
        })*
    };
}

operator!(Add add Add::default(), Sub sub Subtract::default(), Mul mul Multiply, BitOr bitor Or);

/// A flag that is always set changes nothing.
impl ops::BitAnd for Sig<'_> {
    type Output = Self;

    fn bitand(self, other: Self) -> Self {
        match (self.ty().is_flag(), self.range(), other.range()) {
            (true, (1, 1), _) => other,
            (true, _, (1, 1)) => self,
            _ => self.apply(And, &[other]),
        }
    }
}

impl ops::Neg for Sig<'_> {
    type Output = Self;

    fn neg(self) -> Self {
        self.apply(Negate::default(), &[])
    }
}

impl ops::Not for Sig<'_> {
    type Output = Self;

    fn not(self) -> Self {
        self.apply(Not, &[])
    }
}
