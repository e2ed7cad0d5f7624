//! Images: files of a mesh's tree and triangles that are copied to memory as they are.

use crate::format::EngineFormat;
use crate::model::Side;
use crate::params::{EngineParams, FACTOR_BITS};
use crate::words::LINK_NUMBER_BITS;
use efsat_geometry::directions::Directions;
use efsat_hardware::number::Upper;
use efsat_unit::params::Params;

/// The first bytes of an image.
pub const MAGIC: [u8; 8] = *b"EFSATTR1";
/// Bytes of the header; addresses are multiples of it.
pub const LINE: u32 = 64;

/// What is wrong with an image, and where.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("byte {at}: {what}: {found}; expected {expected}")]
pub struct ImageError {
    /// The first byte of the field.
    pub at: u64,
    /// What the field is.
    pub what: String,
    /// What was found.
    pub found: String,
    /// What was expected.
    pub expected: String,
}

impl ImageError {
    pub(super) fn new(at: u64, what: impl ToString, found: impl ToString, expected: impl ToString) -> Self {
        Self { at, what: what.to_string(), found: found.to_string(), expected: expected.to_string() }
    }
}

/// The header of an image, which is for the host.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Header {
    /// The formats of blocks and triangles.
    pub format: EngineFormat,
    /// Number of blocks.
    pub blocks: u32,
    /// Number of triangles.
    pub triangles: u32,
    /// The scale of the mesh is 2^power.
    pub power: i32,
    /// The most links from the root's block to a triangle.
    pub height: u32,
    /// What is the origin of the image, in the coordinates of the mesh.
    pub centre: [f64; 3],
}

impl Header {
    /// The byte at which blocks begin.
    pub fn blocks_at(&self) -> u32 {
        LINE
    }

    /// The byte at which triangles begin.
    pub fn triangles_at(&self) -> u64 {
        let end = u64::from(LINE) + u64::from(self.blocks) * u64::from(self.format.block().stride);
        end.next_multiple_of(LINE.into())
    }

    /// The bytes of the image.
    pub fn size(&self) -> u64 {
        self.triangles_at() + u64::from(self.triangles) * u64::from(self.format.triangle().stride)
    }

    /// The first two words of an image of a format.
    pub(crate) fn head(format: &EngineFormat) -> [u64; 2] {
        let bytes = [
            format.k(),
            format.offset_bits,
            format.origin_fraction(),
            format.grid_fraction(),
            format.transform_width,
            format.int_bits,
            format.sticky.into(),
            0,
        ];
        [MAGIC, bytes.map(|byte| byte as u8)].map(u64::from_le_bytes)
    }

    /// Its eight words.
    pub fn words(&self) -> [u64; 8] {
        let both = |low: u32, high: u32| u64::from(low) | u64::from(high) << 32;
        let [magic, format] = Self::head(&self.format);
        let [x, y, z] = self.centre.map(f64::to_bits);
        [
            magic,
            format,
            both(self.blocks, self.triangles),
            both(self.blocks_at(), self.triangles_at() as u32),
            both(self.power as u32, self.height),
            x,
            y,
            z,
        ]
    }

    /// Reads a header.
    pub(super) fn of(words: &[u64; 8]) -> Result<Self, ImageError> {
        let magic = words[0].to_le_bytes();
        if magic != MAGIC {
            let found = String::from_utf8_lossy(&magic).escape_debug().to_string();
            return Err(ImageError::new(0, "first bytes", format!("'{found}'"), "EFSATTR1"));
        }
        let format = Self::formats(words[1].to_le_bytes())?;
        let half = |index: usize, high: u32| (words[index / 8] >> (32 * high)) as u32;
        let [blocks, triangles] = [half(16, 0), half(16, 1)];
        let header = Self {
            format,
            blocks,
            triangles,
            power: half(32, 0) as i32,
            height: half(32, 1),
            centre: [5, 6, 7].map(|index| f64::from_bits(words[index])),
        };
        let most = 1 << LINK_NUMBER_BITS;
        let expected_blocks = triangles.saturating_sub(1).max(1);
        let number = |at, what, found: u32, fine: bool, expected: String| match fine {
            true => Ok(()),
            false => Err(ImageError::new(at, what, found, expected)),
        };
        number(20, "number of triangles", triangles, triangles <= most, format!("at most {most}"))?;
        let expected = format!("{expected_blocks} for {triangles} triangles");
        number(16, "number of blocks", blocks, blocks == expected_blocks, expected)?;
        let (found, expected) = (half(24, 0), header.blocks_at());
        number(24, "offset of the blocks", found, found == expected, expected.to_string())?;
        let (found, expected) = (half(24, 1), header.triangles_at());
        number(28, "offset of the triangles", found, u64::from(found) == expected, expected.to_string())?;
        if !(-1024..=1022).contains(&header.power) {
            return Err(ImageError::new(32, "power of two of the scale", header.power, "-1024 to 1022"));
        }
        if let Some(axis) = header.centre.iter().position(|x| !x.is_finite()) {
            let at = 40 + 8 * axis as u64;
            return Err(ImageError::new(at, "centre", header.centre[axis], "a finite number"));
        }
        Ok(header)
    }

    /// The formats that bytes 8 to 15 state.
    fn formats(bytes: [u8; 8]) -> Result<EngineFormat, ImageError> {
        let [k, offset_bits, origin, grid, width, int_bits, flags, zero] = bytes.map(u32::from);
        let wrong = |at, what, found: u32, expected: &str| Err(ImageError::new(at, what, found, expected));
        let Some(directions) = Directions::of(k as usize) else {
            return wrong(8, "directions", k, "6, 14, 18 or 26");
        };
        if flags > 1 {
            return wrong(14, "flags", flags, "0 or 1");
        }
        if zero != 0 {
            return wrong(15, "spare byte", zero, "0");
        }
        let upper = if flags == 1 { Upper::Sticky } else { Upper::Implied };
        let fit = Params::default().width.min(width);
        let unit = Params { width: fit, transform_width: width, int_bits, upper, ..Params::default() };
        let mut engine = EngineParams { directions, offset_bits, origin_bits: origin + 1, ..EngineParams::default() };
        // An image has no rows.
        engine.factor_bits = *FACTOR_BITS.start();
        let format = engine.format(&unit).map_err(|e| {
            let at = match e.option {
                "offset-bits" => 9,
                "origin-bits" => 10,
                "int-bits" => 13,
                _ => 12,
            };
            ImageError::new(at, e.option, e.found, e.legal.trim_start_matches("expected "))
        })?;
        match grid == format.grid_fraction() {
            true => Ok(format),
            false => wrong(11, "grid fraction", grid, &format.grid_fraction().to_string()),
        }
    }
}

/// An image whose every field is in order.
#[derive(Clone, Debug, PartialEq)]
pub struct Image {
    pub(super) header: Header,
    /// All of the file.
    pub(super) words: Vec<u64>,
}

impl Image {
    /// Reads an image and checks all that can be told without its mesh: each field, that the blocks are one tree over all
    /// triangles, and that no code excludes a triangle as it is stored.
    ///
    /// # Errors
    /// The first thing that is wrong.
    pub fn read(bytes: &[u8]) -> Result<Self, ImageError> {
        let whole = bytes.chunks_exact(8).map(|chunk| u64::from_le_bytes(chunk.try_into().expect("eight bytes")));
        let words: Vec<u64> = whole.collect();
        let Some(head) = words.first_chunk() else {
            let (end, found) = (bytes.len() as u64, format!("{} of 64 bytes", bytes.len()));
            return Err(ImageError::new(end, "end of the file", found, "a header of 64 bytes"));
        };
        let header = Header::of(head)?;
        if header.size() != bytes.len() as u64 {
            let expected = format!("{} bytes, as the header says", header.size());
            return Err(ImageError::new(
                bytes.len() as u64,
                "end of the file",
                format!("{} bytes", bytes.len()),
                expected,
            ));
        }
        let image = Self { header, words };
        image.check()?;
        Ok(image)
    }

    /// The header.
    pub fn header(&self) -> &Header {
        &self.header
    }

    /// The file, as 64-bit words.
    pub fn words(&self) -> &[u64] {
        &self.words
    }

    /// The file.
    pub fn bytes(&self) -> Vec<u8> {
        self.words.iter().flat_map(|word| word.to_le_bytes()).collect()
    }

    /// Where the triangle of each face of the mesh is in the image.
    #[doc(hidden)]
    pub fn places(&self) -> Vec<u32> {
        let (layout, first) = (self.header.format.triangle(), self.header.triangles_at() as usize / 8);
        let mut places = vec![0; self.header.triangles as usize];
        for (place, record) in (0..).zip(self.words[first..].chunks_exact(layout.stride as usize / 8)) {
            places[(record[0] & ((1 << layout.number_bits) - 1)) as usize] = place;
        }
        places
    }

    /// Where its parts are if the image is copied to an address, in units of 64 bytes.
    pub fn side(&self, address: u32) -> Side {
        let at = |byte: u64| address + (byte / u64::from(LINE)) as u32;
        Side {
            blocks_at: at(self.header.blocks_at().into()),
            triangles_at: at(self.header.triangles_at()),
            blocks: self.header.blocks,
            triangles: self.header.triangles,
        }
    }

    /// The words of a block, and the byte at which it begins.
    pub(super) fn block_words(&self, number: u32) -> (&[u64], u64) {
        self.record(self.header.blocks_at().into(), number, self.header.format.block().stride)
    }

    /// The words of a triangle, and the byte at which it begins.
    pub(super) fn triangle_words(&self, number: u32) -> (&[u64], u64) {
        self.record(self.header.triangles_at(), number, self.header.format.triangle().stride)
    }

    fn record(&self, from: u64, number: u32, stride: u32) -> (&[u64], u64) {
        let at = from + u64::from(number) * u64::from(stride);
        (&self.words[at as usize / 8..][..stride as usize / 8], at)
    }
}

/// A memory that holds images one after the other from address 0, and where each of them is.
pub fn memory(images: &[&Image]) -> (Vec<u64>, Vec<Side>) {
    let mut memory = vec![];
    let sides = images.iter().map(|image| {
        let address = memory.len() as u32 / (LINE / 8);
        memory.extend_from_slice(&image.words);
        memory.resize(memory.len().next_multiple_of(LINE as usize / 8), 0);
        image.side(address)
    });
    let sides = sides.collect();
    (memory, sides)
}
