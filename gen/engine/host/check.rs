//! Whether an image is in order.

use super::image::{Image, ImageError};
use crate::model::{BadBlock, Block, Link, Triangle};
use efsat_geometry::{collide::hierarchy::Placement, mesh::Mesh};
use efsat_hardware::number::Upper;

impl Image {
    /// The block of a number.
    ///
    /// # Errors
    /// If it is none of the format.
    pub fn block(&self, number: u32) -> Result<Block, ImageError> {
        let format = &self.header.format;
        let (words, at) = self.block_words(number);
        let wrong = |what: &str, found: String, expected: String| {
            Err(ImageError::new(at, format!("block {number}: {what}"), found, expected))
        };
        let block = match Block::of(words, format) {
            Ok(block) => block,
            Err(e) => {
                let what = match e {
                    BadBlock::Tag { .. } => "tag".to_owned(),
                    BadBlock::NotZero { from, to } => format!("bits {from} to {to}"),
                    BadBlock::Code { child, direction, .. } => format!("code {direction} of child {child}"),
                };
                return wrong(&what, e.found(), e.expected());
            }
        };
        let least = -format.most_origin();
        if let Some(&found) = block.origin.iter().find(|&&x| x < least) {
            return wrong("origin", found.to_string(), format!("at least {least}"));
        }
        for link in block.links {
            let (found, most) = match link {
                Link::None => continue,
                Link::Leaf(found) => (found, self.header.triangles),
                Link::Inner(found) => (found, self.header.blocks),
            };
            if found >= most {
                return wrong("link", found.to_string(), format!("a number below {most}"));
            }
        }
        match block.words(format) == words {
            true => Ok(block),
            false => wrong("bits after the codes", "not all zero".to_owned(), "zeros".to_owned()),
        }
    }

    /// The triangle of a number.
    ///
    /// # Errors
    /// If it is none of the format.
    pub fn triangle(&self, number: u32) -> Result<Triangle, ImageError> {
        let format = &self.header.format;
        let (words, at) = self.triangle_words(number);
        let triangle = Triangle::of(words, format);
        let one = 1i64 << format.word_fraction();
        let error = |what, found: String, expected: String| {
            Err(ImageError::new(at, format!("triangle {number}: {what}"), found, expected))
        };
        let outside = |x: &i64| !(-one..=one).contains(x);
        if let Some(found) = triangle.corners.as_flattened().iter().map(|x| x.lo).find(outside) {
            return error("coordinate", found.to_string(), format!("{} to {one}", -one));
        }
        match triangle.words(format) == words {
            true => Ok(triangle),
            false => error("spare bits", "other than zeros and copies of signs".to_owned(), "no others".to_owned()),
        }
    }

    /// Checks blocks and triangles.
    pub(super) fn check(&self) -> Result<(), ImageError> {
        self.check_tree()?;
        let format = &self.header.format;
        let upper = if format.sticky { Upper::Sticky } else { Upper::Implied };
        let triangles = (0..self.header.triangles).map(|number| self.triangle(number));
        let triangles = triangles.collect::<Result<Vec<Triangle>, _>>()?;
        let mut seen = vec![false; triangles.len()];
        for (place, triangle) in (0..).zip(&triangles) {
            self.take_number(&mut seen, place, triangle)?;
        }
        // The real corner is not below its lower bound, nor above the next grid point: a code that excludes both is wrong.
        self.check_codes(format.word_fraction(), |number, n| {
            let corner = |corner: &[efsat_unit::pair::Input; 3]| {
                let along = |(&n, x): (&i8, &efsat_unit::pair::Input)| {
                    let x = x.interval(upper);
                    i64::from(n) * if n < 0 { x.hi } else { x.lo }
                };
                n.iter().zip(corner).map(along).sum::<i64>()
            };
            triangles[number as usize].corners.iter().map(corner).max().unwrap_or(i64::MIN)
        })
    }

    /// Notes the number of a triangle, which no other one may have.
    fn take_number(&self, seen: &mut [bool], place: u32, triangle: &Triangle) -> Result<(), ImageError> {
        if seen.get_mut(triangle.number as usize).is_some_and(|seen| !std::mem::replace(seen, true)) {
            return Ok(());
        }
        let (at, what) = (self.triangle_words(place).1, format!("triangle {place}: its number"));
        Err(ImageError::new(at, what, triangle.number, format!("each number below {} once", seen.len())))
    }

    /// Checks that the blocks are one tree over all triangles, each child after its parent, of the height in the header.
    fn check_tree(&self) -> Result<(), ImageError> {
        let header = &self.header;
        let mut levels = vec![None; header.blocks as usize];
        let mut seen = vec![false; header.triangles as usize];
        levels[0] = Some(1);
        let mut height = 0;
        for number in 0..header.blocks {
            let block = self.block(number)?;
            let at = self.block_words(number).1;
            let wrong = |what: &str, found: String, expected: &str| {
                Err(ImageError::new(at, format!("block {number}: {what}"), found, expected))
            };
            let Some(level) = levels[number as usize] else {
                return wrong("links to it", "none".to_owned(), "one, from a block before it");
            };
            // Only meshes of less than two triangles lack children.
            for (child, link) in (0..).zip(block.links) {
                let there = header.triangles > 1 || child < header.triangles;
                match link {
                    Link::None if there => return wrong("link", "none".to_owned(), "a block or a triangle"),
                    Link::None => {}
                    _ if !there => return wrong("link", "a child".to_owned(), "none, as there are so few triangles"),
                    Link::Leaf(triangle) => {
                        if std::mem::replace(&mut seen[triangle as usize], true) {
                            return wrong("link", format!("triangle {triangle} again"), "each triangle once");
                        }
                        height = height.max(level);
                    }
                    Link::Inner(other) if other <= number => {
                        return wrong("link", format!("block {other}"), "a block with a greater number");
                    }
                    Link::Inner(other) => {
                        if levels[other as usize].replace(level + 1).is_some() {
                            return wrong("link", format!("block {other} again"), "each block once");
                        }
                    }
                }
            }
        }
        match height == header.height {
            true => Ok(()),
            false => Err(ImageError::new(36, "height of the tree", header.height, height)),
        }
    }

    /// Checks that every code holds the triangles below its child. `least` gives a bound that the offset of a triangle along a
    /// direction surely has, in steps of 2^-fraction.
    fn check_codes(&self, fraction: u32, least: impl Fn(u32, [i8; 3]) -> i64) -> Result<(), ImageError> {
        let format = &self.header.format;
        let common = fraction.max(format.grid_fraction());
        let mut of_blocks = vec![vec![]; self.header.blocks as usize];
        for number in (0..self.header.blocks).rev() {
            let block = self.block(number)?;
            let mut of_block = vec![i64::MIN; format.directions.count()];
            for (child, link) in block.links.into_iter().enumerate() {
                let below = match link {
                    Link::None => continue,
                    Link::Inner(other) => std::mem::take(&mut of_blocks[other as usize]),
                    Link::Leaf(triangle) => {
                        let directions = 0..format.directions.count();
                        directions.map(|i| least(triangle, format.directions.vector(i))).collect::<Vec<i64>>()
                    }
                };
                for (direction, (&bound, greatest)) in below.iter().zip(&mut of_block).enumerate() {
                    let n = format.directions.vector(direction).into_iter().map(i64::from);
                    let origin: i64 = n.zip(block.origin).map(|(n, o)| n * i64::from(o)).sum();
                    let code = i64::from(block.codes[child][direction]) << block.exponent;
                    let held = (code + (origin << format.origin_shift())) << (common - format.grid_fraction());
                    if held < bound << (common - fraction) {
                        let what = format!("block {number}: code {direction} of child {child}");
                        let found = block.codes[child][direction];
                        let expected = "a greater one: it excludes a triangle below it";
                        return Err(ImageError::new(self.block_words(number).1, what, found, expected));
                    }
                    *greatest = bound.max(*greatest);
                }
            }
            of_blocks[number as usize] = of_block;
        }
        Ok(())
    }

    /// Checks the image against the mesh that it is said to be of: every triangle is there with its number, rounded as
    /// described, and every code holds the exact triangles below it.
    ///
    /// # Errors
    /// The first thing that is wrong.
    pub fn verify(&self, mesh: &Mesh) -> Result<(), ImageError> {
        let header = &self.header;
        let placement = Placement { centre: header.centre, power: header.power };
        if mesh.faces().len() != header.triangles as usize {
            return Err(ImageError::new(20, "number of triangles", header.triangles, mesh.faces().len()));
        }
        if !placement.holds(mesh) {
            return Err(ImageError::new(
                32,
                "scale and centre",
                "a vertex outside the cube from -1 to 1",
                "none outside",
            ));
        }
        let mut seen = vec![false; mesh.faces().len()];
        let mut faces = vec![];
        for number in 0..header.triangles {
            let triangle = self.triangle(number)?;
            let at = self.triangle_words(number).1;
            self.take_number(&mut seen, number, &triangle)?;
            let face = triangle.number as usize;
            if triangle.corners != self.corners(mesh, face, &placement) {
                let what = format!("triangle {number}: coordinates");
                return Err(ImageError::new(at, what, "others", format!("those of face {face} of the mesh")));
            }
            faces.push(face);
        }
        self.check_codes(header.format.grid_fraction(), |number, n| {
            let corners = mesh.triangle(faces[number as usize]);
            let offset = |v: nalgebra::Point3<f64>| placement.offset(v.into(), n, header.format.grid_fraction());
            i64::from(corners.map(offset).into_iter().max().unwrap_or(0))
        })
    }
}
