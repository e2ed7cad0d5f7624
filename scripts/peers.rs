//! All contacts of two meshes by parry: `parry DIR ROUNDS` reads, writes and prints what peers.cpp does.
use std::fs::{File, read};
use std::io::{BufWriter, Write};
use std::path::Path;
use std::{env, error, process};

use parry3d_f64::bounding_volume::BoundingVolume;
use parry3d_f64::math::{Matrix, Pose, Rotation, Vector};
use parry3d_f64::query::intersection_test;
use parry3d_f64::shape::TriMesh;
use rustix::time::{ClockId, clock_gettime};

type Result<T> = std::result::Result<T, Box<dyn error::Error>>;

fn now() -> f64 {
    let time = clock_gettime(ClockId::ProcessCPUTime);
    time.tv_sec as f64 + 1e-9 * time.tv_nsec as f64
}

/// The seconds of a call, and what it returns.
fn timed<T>(call: impl FnOnce() -> T) -> (f64, T) {
    let start = now();
    let value = call();
    (now() - start, value)
}

/// The numbers of a file, three a vector.
fn vectors(file: &Path) -> Result<Vec<Vector>> {
    let bytes = read(file)?;
    let numbers: Vec<f64> = bytes.as_chunks().0.iter().map(|&eight| f64::from_le_bytes(eight)).collect();
    Ok(numbers.as_chunks().0.iter().map(|&three| Vector::from_array(three)).collect())
}

fn mesh(corners: &[Vector]) -> Result<TriMesh> {
    let faces = (0..corners.len() as u32 / 3).map(|face| [3 * face, 3 * face + 1, 3 * face + 2]).collect();
    Ok(TriMesh::new(corners.to_vec(), faces)?)
}

/// Pairs of leaves whose boxes meet, decided by GJK.
fn query(a: &TriMesh, b: &TriMesh, pose: &Pose) -> Result<Vec<[u32; 2]>> {
    let near = a.bvh().leaf_pairs(b.bvh(), |p, q| p.aabb().intersects(&q.aabb().transform_by(pose)));
    let mut found = Vec::new();
    for (p, q) in near {
        if intersection_test(&Pose::IDENTITY, &a.triangle(p), pose, &b.triangle(q))?.intersecting {
            found.push([p, q]);
        }
    }
    Ok(found)
}

fn main() -> Result<()> {
    let words: Vec<String> = env::args().skip(1).collect();
    let [folder, rounds] = &words[..] else {
        eprintln!("expected a folder and a number of rounds");
        process::exit(2);
    };
    let (folder, rounds) = (Path::new(folder), rounds.parse::<usize>()?);
    let corners = [vectors(&folder.join("a.f64"))?, vectors(&folder.join("b.f64"))?];
    // A pose is three rows and a translation.
    let poses: Vec<Pose> = (vectors(&folder.join("poses.f64"))?.as_chunks::<4>().0.iter())
        .map(|&[x, y, z, t]| Pose::from_parts(t, Rotation::from_mat3(&Matrix::from_cols(x, y, z).transpose())))
        .collect();

    let build = || -> Result<_> { Ok((mesh(&corners[0])?, mesh(&corners[1])?)) };
    let (mut built, trees) = timed(build);
    let (a, b) = trees?;
    let mut best = vec![f64::INFINITY; poses.len()];
    let mut out = BufWriter::new(File::create(folder.join("found.u32"))?);
    for round in 0..rounds {
        built = built.min(timed(build).0);
        for (i, pose) in poses.iter().enumerate() {
            let (seconds, found) = timed(|| query(&a, &b, pose));
            best[i] = best[i].min(seconds);
            for [p, q] in found? {
                if round == 0 {
                    for number in [i as u32, p, q] {
                        out.write_all(&number.to_le_bytes())?;
                    }
                }
            }
        }
    }
    out.flush()?;
    println!("{built:.9} {:.9}", best.iter().sum::<f64>() / best.len() as f64);
    Ok(())
}
