//! Pairs of triangles answered as the unit answers them, and exactly.
//!
//! `cargo run --release --example classify [FILE]` reads a file of pairs, or `examples/three_pairs.csv`.

use efsat::NotFinite;
use efsat::exact::Exact;
use efsat::host::Reference;
use efsat::pair::Verdict;
use efsat::pair_file;
use efsat::params::Params;
use efsat::software::retest::retest;
use std::error::Error;

const PAIRS: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/three_pairs.csv");

fn main() -> Result<(), Box<dyn Error>> {
    let file = std::env::args().nth(1).unwrap_or_else(|| PAIRS.to_owned());
    for (number, (verdict, exact)) in answers(&file)?.into_iter().enumerate() {
        println!("pair {number}: {verdict}, exactly {exact}");
    }
    Ok(())
}

/// The verdict of the unit for every pair of a file, and the exact answer.
pub fn answers(file: &str) -> Result<Vec<(Verdict, Exact)>, Box<dyn Error>> {
    // The default design: separating axes, 18 bits. Both triangles of a pair are in one frame.
    let unit = Reference::new(&Params::default());
    let pairs = pair_file::read(file)?;
    let answer = |points: &[[f64; 3]; 6]| -> Result<(Verdict, Exact), NotFinite> {
        // Each pair is moved and scaled into the range of the unit. What does not fit the host decides. The retest is needed only
        // where the verdict is possibly incorrect: a definite verdict is never wrong.
        Ok((unit.loose(points)?.verdict, retest(points)?))
    };
    Ok(pairs.iter().map(answer).collect::<Result<_, _>>()?)
}
