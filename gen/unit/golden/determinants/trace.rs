//! Every inner number by name, for comparison with another implementation of docs/determinants.md.

use super::differences::{Frame, Points};
use super::fifteen::{Dots, Fifteen};
use super::moments::Moments;
use super::number::{Number, Vector};
use super::verdict::{boxes_apart, edges, outcome};
use super::{Computed, DeterminantTest};
use crate::pair::Pair;

/// The record being written.
#[derive(Default)]
pub(in crate::golden) struct Record(pub Vec<(String, i128)>);

impl Record {
    pub fn number(&mut self, name: impl Into<String>, x: impl Into<i128>) {
        self.0.push((name.into(), x.into()));
    }

    fn vector(&mut self, name: &str, x: &Vector) {
        for (component, x) in ["x", "y", "z"].iter().zip(x) {
            self.number(format!("{name}_{component}"), *x);
        }
    }

    fn vectors(&mut self, name: &str, first: usize, x: &[Vector]) {
        for (i, x) in (first..).zip(x) {
            self.vector(&format!("{name}{i}"), x);
        }
    }

    pub fn points(&mut self, stage: &str, points: &Points) {
        self.vectors(&format!("{stage}.v"), 1, &points.v);
        self.vectors(&format!("{stage}.w"), 0, &points.w);
    }

    pub fn moments(&mut self, stage: &str, moments: &Moments) {
        self.vectors(&format!("{stage}.m"), 0, &moments.m);
        self.vector(&format!("{stage}.n"), &moments.n);
    }

    pub fn dots<N: Number>(&mut self, dots: &Dots<N>) {
        (0..3).for_each(|l| self.number(format!("dot.a{l}"), dots.a[l]));
        (0..6).for_each(|i| self.number(format!("dot.d{}{}", i / 3 + 1, i % 3), dots.d[i / 3][i % 3]));
        self.number("dot.v", dots.v);
    }

    pub fn determinants<N: Number>(&mut self, determinants: Fifteen<N>) {
        determinants.named().for_each(|(name, x)| self.number(format!("determinant.{name}"), x));
    }
}

impl DeterminantTest {
    /// See [`Golden::trace`](crate::golden::Golden::trace).
    pub fn trace(&self, frame: &Frame, pair: &Pair) -> Vec<(String, i128)> {
        let differences = self.differences.points(frame, pair);
        let mut record = Record::default();
        record.points("difference", &differences);
        self.trace_from(&differences, &mut record);
        record.0
    }

    /// What comes after the differences.
    pub fn trace_from(&self, differences: &Points, record: &mut Record) {
        if self.narrow { self.record::<i64>(differences, record) } else { self.record::<i128>(differences, record) }
    }

    fn record<N: Number>(&self, differences: &Points, record: &mut Record) {
        let coordinates = self.scaling.coordinates(differences);
        let apart = self.boxes && boxes_apart(&coordinates);
        let Computed { moments, rounded, shift, dots, determinants, bounds, signs } = self.computed::<N>(&coordinates);
        record.vector("dropped", &coordinates.dropped.map(i64::from));
        record.number("level", coordinates.level);
        record.points("coordinate", &coordinates.points);
        record.moments("exact", &moments);
        record.moments("moment", &rounded);
        record.number("shift", shift);
        record.dots(&dots);
        record.determinants(determinants);
        bounds.named().for_each(|(name, x)| record.number(format!("bound.{name}"), x));
        signs.named().for_each(|(name, x)| record.number(format!("sign.{name}"), x));
        for (side, edges) in ["a", "b"].iter().zip(edges(&signs)) {
            for (k, edge) in edges.iter().enumerate() {
                record.number(format!("missed.{side}{k}"), edge.missed);
                record.number(format!("pierces.{side}{k}"), edge.pierces);
            }
        }
        record.number("boxes_apart", apart);
        record.number("verdict", outcome(apart, &signs).verdict as u8);
    }
}
