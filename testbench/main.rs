//! What the library and the generated design have to hold, a file a capability. One program, so that it is linked once and
//! both cores have work to the end; `cargo test --release --test testbench stream::` runs one file of it.

mod accuracy;
mod agreement;
mod baseline;
mod book;
mod cascade;
mod cli;
mod compare;
mod diagrams;
mod drop_in;
mod effects;
mod engine;
mod engine_clocks;
mod engine_rtl;
mod engine_volume;
mod examples;
mod extent;
mod files;
mod formats;
mod guard;
mod hierarchy;
mod house;
mod mutation;
mod operators;
mod proofs;
mod protocol;
mod readers;
mod scenes;
mod schedule;
mod soak;
mod stream;
mod stress;
mod strict;
mod synth;
mod tools;
mod wall;
