//! Stress: families of hard pairs, the ways to write a pair, and the campaign that counts wrong answers.
