//! `efsat tree build`.

use super::VolumeArguments;
use crate::error::Failure;
use crate::file::{self, Output};
use crate::output::{counted, print, warn};
use crate::params::{choice, whole};
use crate::source::load_mesh;
use efsat_engine::host::Image;
use efsat_engine::params::{EngineParams, FACTOR_BITS};
use efsat_geometry::mesh::{Findings, Mesh};
use efsat_hardware::number::Upper;
use efsat_unit::design::top::DesignError;
use efsat_unit::params::Params;
use efsat_unit::params::options::{INT_BITS, TRANSFORM_WIDTH, WIDTH};
use std::path::PathBuf;

/// Builds the image of a mesh: its tree of local blocks and its triangles, as the engine reads them
#[derive(Debug, clap::Args)]
pub(super) struct Arguments {
    /// Mesh file (.stl, .obj, .ply or .off), or builtin:NAME
    #[arg(value_name = "MESH")]
    mesh: PathBuf,
    /// The image
    #[arg(long, value_name = "FILE")]
    out: PathBuf,
    /// The faces of the mesh file, one row for each triangle of the image: its number there, the number of the face, from 0,
    /// and which triangle of the face it is, from 0
    #[arg(long, value_name = "FILE")]
    faces: Option<PathBuf>,
    /// Another mesh that this one meets in queries: all get one scale. Give every image of a scene the same meshes
    #[arg(long, value_name = "MESH")]
    beside: Vec<PathBuf>,
    #[command(flatten)]
    volumes: VolumeArguments,
    /// Integral digits of a number of a triangle, as in efsat generate
    #[arg(long, value_name = "K", default_value_t = 4, value_parser = whole(INT_BITS), allow_negative_numbers = true)]
    int_bits: u32,
    /// Bits of a number of a triangle, as in efsat generate
    #[arg(long, value_name = "N", default_value_t = 32, value_parser = whole(*WIDTH.start()..=TRANSFORM_WIDTH), allow_negative_numbers = true)]
    transform_width: u32,
    /// Upper bound of a number of a triangle, as in efsat generate
    #[arg(long, value_name = "RULE", default_value = "implied", value_parser = choice::<Upper>())]
    upper: Upper,
}

pub(super) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let paths = || std::iter::once(&arguments.mesh).chain(&arguments.beside);
    let (meshes, findings): (Vec<Mesh>, Vec<Findings>) =
        paths().map(|path| load_mesh(path)).collect::<Result<Vec<_>, Failure>>()?.into_iter().unzip();
    file::distinct(std::iter::once(arguments.out.as_path()).chain(arguments.faces.as_deref()))?;
    let mut out = Output::new(&arguments.out)?;
    let faces = arguments.faces.as_deref().map(Output::new).transpose()?;
    let numbers = &findings[0].numbers;
    if !numbers.are_plain() && faces.is_none() {
        let why = "the image numbers triangles from 0, which are not the numbers of the faces in the file";
        warn(&format!("{}: {why}: --faces FILE lists both", arguments.mesh.display()));
    }
    let unit = Params {
        // The width of the unit behind the engine is not in an image.
        width: Params::default().width.min(arguments.transform_width),
        int_bits: arguments.int_bits,
        transform_width: arguments.transform_width,
        upper: arguments.upper,
        ..Params::default()
    };
    // Factors are in queries, not in images.
    let engine = EngineParams { factor_bits: *FACTOR_BITS.start(), ..arguments.volumes.engine() };
    let format = engine.format(&unit).map_err(DesignError::from)?;
    let image = Image::build_first(&meshes.iter().collect::<Vec<_>>(), &format)
        .map_err(|e| Failure::Usage(format!("{}: {e}", arguments.mesh.display())))?;
    let header = *image.header();
    out.write(image.bytes())?;
    if let Some(mut faces) = faces {
        faces.write("triangle,face,part\n")?;
        for triangle in 0..meshes[0].faces().len() as u32 {
            let [face, part] = numbers.of(triangle);
            faces.write(format!("{triangle},{face},{part}\n"))?;
        }
        faces.finish()?;
    }
    out.finish()?;
    let file = arguments.out.display();
    let (triangles, size, height, power) =
        (counted(header.triangles, "triangles"), header.size(), header.height, header.power);
    print(&format!("{file}: {triangles}, {size} bytes, height {height}, scale 2^{power}\n"))
}
