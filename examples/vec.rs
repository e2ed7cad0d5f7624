#[path = "../testbench/theorems/vectors.rs"]
mod vectors;
fn main() {
    let n = std::env::args().nth(1).unwrap().parse().unwrap();
    let v = vectors::Vectors::new(n);
    print!("{}", v.text());
    eprintln!("{v}");
}
