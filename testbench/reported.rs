//! Mesh files that users of other programs have reported, in `testbench/reported/`: each gives its right answer or its right
//! refusal. The answers are those of an oracle that is not part of this repository.

use crate::tools::program::efsat;
use efsat::mesh;
use rand::rngs::ChaCha8Rng;
use rand::{RngExt, SeedableRng};
use serde_json::Value;
use std::fs;
use std::path::{Path, PathBuf};

/// What a file gives.
enum Right {
    /// Triangles, and pairs of them that cross and that touch; no other defect, and nothing on standard error.
    Pairs(u64, [u64; 2]),
    /// The same, and a warning with this in it.
    Said(u64, [u64; 2], &'static str),
    /// Status 2, and one line with this behind the name of the file.
    Refused(&'static str),
}

use Right::{Pairs, Refused, Said};

/// Where it was reported, the file, and what is right.
const FILES: [(&str, &str, Right); 17] = [
    ("f3d-app/f3d 473", "polygon_f3d_473.obj", Pairs(14, [0, 0])),
    ("PyMesh/PyMesh 74", "pymesh_74.obj", Pairs(4, [0, 0])),
    ("assimp/assimp 6253", "obj_bom_hidden.obj", Pairs(2, [1, 0])),
    ("cinder/Cinder 1121", "obj_continuation.obj", Pairs(3, [1, 1])),
    (
        "cnr-isti-vclab/vcglib 90",
        "obj_zero_based.obj",
        Refused("7: vertex 0 in 'f 0 1 2': expected vertices counted from 1: counted from 0, every face"),
    ),
    (
        "MeshInspector/MeshLib 5670",
        "csv_numbers.obj",
        Said(2, [1, 0], "faces left out: 1 with a vertex out of range (first: line 7: vertex '9' in a file of 6)"),
    ),
    ("ddiakopoulos/tinyply 46", "ply_nan_normal_one.ply", Pairs(2, [1, 0])),
    ("PointCloudLibrary/pcl 1466", "ply_nan_texcoord.ply", Pairs(2, [1, 0])),
    ("openscad/openscad 1225", "stl_nan_normal.stl", Pairs(2, [1, 0])),
    ("CloudCompare/CloudCompare 232", "stl_utm.stl", Pairs(2, [1, 0])),
    ("cnr-isti-vclab/meshlab 194", "stl_end_loop.stl", Pairs(2, [1, 0])),
    ("mrdoob/three.js 5734", "stl_trailing.stl", Said(2, [1, 0], "bytes behind the last triangle, not read (428)")),
    ("ros-visualization/rviz 1244", "stl_bom.stl", Pairs(2, [1, 0])),
    (
        "cnr-isti-vclab/meshlab 39",
        "stl_comma.stl",
        Refused("4: '0,000': a decimal comma or a comma between numbers is no"),
    ),
    ("nmwsharp/happly 27", "ply_blank_line.ply", Pairs(2, [1, 0])),
    (
        "Dezinater/osrscachereader 16",
        "obj_commas.obj",
        Refused("1: '0,': a decimal comma or a comma between numbers in 'v 0, 0, 0' is no number"),
    ),
    ("mikedh/trimesh 542", "trimesh_542.off", Pairs(2, [1, 0])),
];

fn file(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("testbench/reported").join(name)
}

#[test]
fn every_mesh_file_gives_its_right_answer_or_refusal() {
    let home = tempfile::tempdir().unwrap();
    for (source, name, right) in &FILES {
        let path = file(name);
        let (status, output, errors) = efsat(&home, &format!("self-intersections '{}' --json", path.display()));
        let (triangles, [crossing, touching], said) = match right {
            Refused(part) => {
                assert_eq!(status, Some(2), "{source}: {name}");
                let expected = format!("error: {}:{part}", path.display());
                assert!(errors.starts_with(&expected) && errors.lines().count() == 1, "{source}: {errors}");
                continue;
            }
            Pairs(triangles, crossing) => (*triangles, *crossing, None),
            Said(triangles, crossing, part) => (*triangles, *crossing, Some(part)),
        };
        assert_eq!(status, Some(0), "{source}: {errors}");
        match said {
            None => assert_eq!(errors, "", "{source}: {name}"),
            Some(part) => assert_eq!(errors, format!("warning: {}: {part}\n", path.display()), "{source}"),
        }
        let told: Value = serde_json::from_str(&output).unwrap();
        let found = ["triangles", "crossing", "touching", "defects"].map(|key| told[key].as_u64().unwrap());
        assert_eq!(found, [triangles, crossing, touching, crossing + touching], "{source}: {name}");
    }
}

/// Numbers of triangles are those of the file, and faces that are left out are named, whatever the command.
#[test]
fn all_commands_say_the_same_of_a_file_and_number_its_faces() {
    let home = tempfile::tempdir().unwrap();
    let dir = home.path();
    fs::copy(file("csv_numbers.obj"), dir.join("m.obj")).unwrap();
    // The last face of the file, alone.
    fs::write(dir.join("t.obj"), "v 1 1 -1\nv 1 1 1\nv 2 1.5 1\nf 1 2 3\n").unwrap();
    fs::write(dir.join("s.toml"), "name = \"s\"\n[a]\nmesh = \"m.obj\"\n[b]\nmesh = \"t.obj\"\n[[pose]]\n").unwrap();
    let said = "faces left out: 1 with a vertex out of range (first: line 7: vertex '9' in a file of 6)\n";
    for arguments in [
        "self-intersections m.obj --csv d.csv",
        "tree build m.obj --out m.tree --faces f.csv",
        "compare --mesh m.obj --steps 1 --distances 1",
        "scene pairs s.toml",
        "scene run s.toml --cosim none --view v.html --pairs p.csv",
        "classify s.toml --summary",
    ] {
        let (status, _, errors) = efsat(dir, arguments);
        assert!(status == Some(0) && errors.contains(said), "{arguments}: {errors}");
    }
    let text = |name: &str| fs::read_to_string(dir.join(name)).unwrap();
    assert_eq!(text("d.csv"), "first,second,kind\n1,2,crossing\n");
    assert_eq!(text("f.csv"), "triangle,face,part\n0,1,0\n1,2,0\n");
    let faces = |name: &str| -> Vec<String> {
        let pick = |line: &str| line.split(',').skip(3).take(2).collect::<Vec<_>>().join(",");
        text(name).lines().map(pick).collect()
    };
    assert_eq!(faces("p.csv"), ["triangle_a,triangle_b", "1,0", "2,0"]);
    assert!(text("v.html").contains(r#""triangles":["1","2"]"#));
    // Behind a quad, and with the triangle of it that is crossed; without the list of faces the image is warned of.
    let quad = "v 0 0 0\nv 4 0 0\nv 4 4 0\nv 0 4 0\nv 1 2 -1\nv 1 2 1\nv 1 3 1\nf 1 2 9\nf 1 2 3 4\nf 5 6 7\n";
    fs::write(dir.join("m.obj"), quad).unwrap();
    efsat(dir, "self-intersections m.obj --csv d.csv");
    assert_eq!(text("d.csv"), "first,second,kind,first_part,second_part\n1,2,crossing,1,0\n");
    fs::write(dir.join("t.obj"), "v 1 2 -1\nv 1 2 1\nv 1 3 1\nf 1 2 3\n").unwrap();
    efsat(dir, "scene run s.toml --cosim none --pairs q.csv");
    assert_eq!(faces("q.csv"), ["triangle_a,triangle_b", "1,0", "2,0"]);
    let parts = |line: &str| line.rsplitn(3, ',').take(2).map(str::to_owned).collect::<Vec<_>>();
    assert_eq!(text("q.csv").lines().map(parts).collect::<Vec<_>>(), [["part_b", "part_a"], ["0", "1"], ["0", "0"]]);
    let (_, _, errors) = efsat(dir, "tree build m.obj --out m.tree");
    assert!(errors.contains("which are not the numbers of the faces in the file: --faces FILE lists both"), "{errors}");
}

/// A name of 200,000 letters is not repeated whole.
#[test]
fn long_names_are_cut_in_errors() {
    let home = tempfile::tempdir().unwrap();
    let name = "n".repeat(200_000);
    let scene =
        format!("name = \"s\"\n[[object]]\nname = \"{name}\"\nmesh = \"builtin:{name}\"\n[[object]]\nname = \"b\"\n");
    fs::write(home.path().join("s.toml"), format!("{scene}mesh = \"builtin:gear\"\n")).unwrap();
    fs::write(home.path().join("m.obj"), format!("v 0 0 {name}\nf 1 1 1\n")).unwrap();
    let typed = &name[..100_000];
    for arguments in ["scene pairs s.toml", &format!("scene pairs {typed}"), &format!("tree inspect {typed}")] {
        let (status, _, errors) = efsat(&home, arguments);
        assert!(status != Some(0) && (20..2000).contains(&errors.len()), "{}", errors.len());
    }
    assert!(efsat(&home, "self-intersections m.obj").2.contains("is no number: expected 'v x y z'"));
}

/// Random changes of bytes; what is accepted is a mesh.
#[test]
fn changed_files_never_panic() {
    let home = tempfile::tempdir().unwrap();
    let mut rng = ChaCha8Rng::seed_from_u64(1);
    for (_, name, _) in &FILES {
        let (bytes, path) = (fs::read(file(name)).unwrap(), home.path().join(name));
        for _ in 0..40 {
            let mut bytes = bytes.clone();
            for _ in 0..rng.random_range(1..6) {
                let at = rng.random_range(0..bytes.len());
                bytes[at] = if rng.random() { rng.random() } else { b"-/1 9\n.#e\\,\r"[at % 12] };
            }
            bytes.truncate(rng.random_range(bytes.len() / 2..=2 * bytes.len()));
            fs::write(&path, &bytes).unwrap();
            if let Ok((mesh, findings)) = mesh::survey(&path) {
                assert!(mesh.vertices().iter().flat_map(|v| v.iter()).all(|x| x.is_finite()), "{bytes:?}");
                assert!(mesh.faces().iter().flatten().all(|&v| (v as usize) < mesh.vertices().len()), "{bytes:?}");
                assert!(!findings.to_string().contains(char::is_control), "{bytes:?}");
                findings.numbers.of(mesh.faces().len() as u32 - 1);
            }
        }
    }
}
