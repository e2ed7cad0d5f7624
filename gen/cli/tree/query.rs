//! `efsat tree query`.

use super::hexadecimal;
use crate::error::Failure;
use crate::file::{self, Output};
use crate::output::{counted, print};
use crate::params::{EngineArguments, ParamArguments};
use crate::source::load_scene;
use efsat_engine::host::{Images, Layout, Numbers, memory};
use efsat_engine::model::Query;
use efsat_engine::params::Memory;
use efsat_engine::words::QueryFlags;
use efsat_unit::design::top::DesignError;
use std::path::PathBuf;

/// Writes the packets of a scene's queries, for a host without Rust: one query for each two objects whose boxes overlap in a frame
///
/// A row has the frame, the numbers of both objects, that of the query, and the 64-bit words in hexadecimal digits; none if the
/// engine cannot answer the query, which software then has to do. With block RAM the packets that fill it come first, with `load`
/// for a frame.
#[derive(Debug, clap::Args)]
pub(super) struct Arguments {
    /// A scene: a TOML file, or `headlight` for the built-in one
    #[arg(value_name = "FILE")]
    file: String,
    /// The packets
    #[arg(long, value_name = "FILE")]
    out: PathBuf,
    /// Write what lies in memory from address 0 on: the images that the queries are about
    #[arg(long, value_name = "FILE")]
    image: Option<PathBuf>,
    /// The queries of one frame alone
    #[arg(long, value_name = "N")]
    frame: Option<usize>,
    /// Stop each query at the first certain contact
    #[arg(long)]
    first_contact: bool,
    #[command(flatten)]
    params: ParamArguments,
    #[command(flatten)]
    engine: EngineArguments,
}

pub(super) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let design = arguments.engine.design(&arguments.params)?;
    if arguments.image.is_some() && design.params.memory == Memory::BlockRam {
        return Err(Failure::Usage("--image with --memory block-ram: expected --memory axi".to_owned()));
    }
    let scene = load_scene(&arguments.file)?;
    file::distinct([&arguments.out].into_iter().chain(&arguments.image).map(PathBuf::as_path))?;
    let frames = match arguments.frame {
        Some(frame) if frame >= scene.frames() => {
            let message = format!("--frame {frame}: expected a number below {}", scene.frames());
            return Err(Failure::Usage(message));
        }
        Some(frame) => frame..frame + 1,
        None => 0..scene.frames(),
    };
    let mut out = Output::new(&arguments.out)?;
    let image = arguments.image.as_deref().map(Output::new).transpose()?;
    let numbers = Numbers::new(&design.params, &design.unit.params).map_err(DesignError::from)?;
    let images =
        Images::new(&scene.meshes().0, numbers).map_err(|e| Failure::Usage(format!("{}: {e}", arguments.file)))?;
    let layout = Layout::new(&design.params, &design.format, &images.all()).map_err(DesignError::from)?;
    let (_, sides) = memory(&images.all());
    let text = |words: &[u64]| hexadecimal(words).join(" ");
    out.write("frame,a,b,number,words\n")?;
    for load in &layout.loads {
        out.write(format!("load,,,,{}\n", text(load)))?;
    }
    let (mut queries, mut refused) = (0u32, 0u32);
    let near = scene.near();
    for meeting in frames.flat_map(|frame| near.meetings(frame)) {
        let number = queries % QueryFlags::NUMBERS;
        let words = images.query(meeting.meshes, &meeting.pose, &sides).map(|query| {
            let query = Query { number, first_contact: arguments.first_contact, ..query };
            text(&layout.moved(&query, &sides).words(&design.format))
        });
        refused += u32::from(words.is_err());
        queries += 1;
        let (frame, a, b) = (meeting.frame, meeting.a, meeting.b);
        out.write(format!("{frame},{a},{b},{number},{}\n", words.unwrap_or_default()))?;
    }
    out.finish()?;
    if let Some(mut image) = image {
        let bytes: Vec<u8> = layout.memory.iter().flat_map(|word| word.to_le_bytes()).collect();
        image.write(bytes)?;
        image.finish()?;
    }
    let (file, packets) = (arguments.out.display(), counted(queries - refused, "packets"));
    print(&format!("{file}: {packets}, and {refused} without, for software\n"))
}
