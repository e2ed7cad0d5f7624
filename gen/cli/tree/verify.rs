//! `efsat tree verify`.

use super::{read, wrong};
use crate::error::Failure;
use crate::output::{counted, print};
use crate::source::load_mesh;
use std::path::PathBuf;

/// Checks an image: every field, that its blocks are one tree over all triangles, and that no code excludes a triangle
///
/// With the mesh it is exact: every triangle is there as it would be rounded, and every code holds the real triangles below it.
/// Without, codes are compared with the triangles as they are stored, which are rounded.
#[derive(Debug, clap::Args)]
pub(super) struct Arguments {
    /// An image made by efsat tree build
    #[arg(value_name = "FILE")]
    file: PathBuf,
    /// The mesh that it is of
    #[arg(value_name = "MESH")]
    mesh: Option<PathBuf>,
}

pub(super) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let file = arguments.file.display();
    let image = read(&arguments.file, Failure::Check)?;
    if let Some(path) = &arguments.mesh {
        image.verify(&load_mesh(path)?.0).map_err(|e| Failure::Check(wrong(&arguments.file, &e)))?;
    }
    let header = image.header();
    let (blocks, triangles) = (counted(header.blocks, "blocks"), counted(header.triangles, "triangles"));
    print(&format!("{file}: {blocks} and {triangles} are in order\n"))
}
