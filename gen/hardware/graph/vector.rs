//! Vectors of three components.

use super::bundle::{Bundle, element};
use super::place::Step;
use std::ops::{Add, Index, Mul, Neg, Sub};

/// Three components: x, y, z.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Vec3<T>(pub [T; 3]);

impl<T> Vec3<T> {
    /// A vector from its components.
    pub fn each(f: impl FnMut(usize) -> T) -> Self {
        Self(std::array::from_fn(f))
    }

    /// The vector of a function of the components.
    pub fn map<U>(self, f: impl FnMut(T) -> U) -> Vec3<U> {
        Vec3(self.0.map(f))
    }

    /// The vector of a function of the components of two vectors.
    pub fn zip<U, R>(self, other: Vec3<U>, mut f: impl FnMut(T, U) -> R) -> Vec3<R> {
        let mut other = other.0.into_iter();
        Vec3(self.0.map(|x| f(x, other.next().expect("three components"))))
    }
}

/// Components by their number, modulo three: `e[i + 1]`.
impl<T> Index<usize> for Vec3<T> {
    type Output = T;

    fn index(&self, i: usize) -> &T {
        &self.0[i % 3]
    }
}

impl<T: Copy> Vec3<T> {
    /// The cross product: component i is `e_j f_k - e_k f_j`.
    pub fn cross<P: Sub<Output = P>>(self, f: Self) -> Vec3<P>
    where
        T: Mul<Output = P>,
    {
        let e = self;
        Vec3::each(|i| e[i + 1] * f[i + 2] - e[i + 2] * f[i + 1])
    }

    /// The dot product, `(x + y) + z`.
    pub fn dot<U: Copy, P: Add<Output = P>>(self, l: Vec3<U>) -> P
    where
        T: Mul<U, Output = P>,
    {
        let v = self;
        v[0] * l[0] + v[1] * l[1] + v[2] * l[2]
    }
}

impl<T: Add> Add for Vec3<T> {
    type Output = Vec3<T::Output>;

    fn add(self, other: Self) -> Self::Output {
        self.zip(other, |a, b| a + b)
    }
}

impl<T: Sub> Sub for Vec3<T> {
    type Output = Vec3<T::Output>;

    fn sub(self, other: Self) -> Self::Output {
        self.zip(other, |a, b| a - b)
    }
}

impl<T: Neg> Neg for Vec3<T> {
    type Output = Vec3<T::Output>;

    fn neg(self) -> Self::Output {
        self.map(|x| -x)
    }
}

impl<S, B: Bundle<S>> Bundle<S> for Vec3<B> {
    fn map(&self, path: &mut Vec<Step>, f: &mut dyn FnMut(&[Step], S) -> S) -> Self {
        Self::each(|i| element(&self.0[i], Step::Component(i), path, f))
    }
}
