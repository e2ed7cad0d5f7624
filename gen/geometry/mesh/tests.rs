//! Tests of the readers: the formats, and every way a file can be wrong.

use super::*;
use rand::rngs::ChaCha8Rng;
use rand::{RngExt, SeedableRng};
use std::io::Write;
use std::sync::Arc;

const FACET: &str =
    "facet normal 0 0 1\n outer loop\n  vertex 0 0 0\n  vertex 1 0 0\n  vertex 0 1 0.5\n endloop\nendfacet\n";

/// Reads `bytes` from a temporary file of that extension.
fn read_bytes(extension: &str, bytes: &[u8]) -> Result<Mesh, MeshError> {
    let mut file = tempfile::Builder::new().suffix(extension).tempfile().unwrap();
    file.write_all(bytes).unwrap();
    read(file.path())
}

/// The message for `bytes`, without the directory and the name of the temporary file.
fn message(extension: &str, bytes: &[u8]) -> String {
    let error = read_bytes(extension, bytes).unwrap_err();
    let text = error.to_string();
    assert!(!text.contains(char::is_control), "one line: {text}");
    text.strip_prefix(&format!("{}:", error.file.display())).unwrap().trim_start().to_owned()
}

/// A binary STL file whose header promises `count` triangles.
fn binary(header: &[u8], count: u32, triangles: &[[f32; 9]]) -> Vec<u8> {
    let mut bytes = header.to_vec();
    bytes.resize(80, b' ');
    bytes.extend(count.to_le_bytes());
    for corners in triangles {
        bytes.extend([0; 12]);
        bytes.extend(corners.iter().flat_map(|x| x.to_le_bytes()));
        bytes.extend([0; 2]);
    }
    bytes
}

const PLY: &str = "ply\nformat ascii 1.0\ncomment made by hand\nelement vertex 4\nproperty double x\n\
    property float y\nproperty float z\nproperty uchar red\nelement edge 1\nproperty int vertex1\n\
    element face 2\nproperty list uchar int vertex_indices\nend_header\n0 0 0 9\n1 0 0 9\n0 1 0.5 9\n-1e99 0 0 9\n7\n\
    3 0 1 2\n4 0 1 2 3\n";

/// The mesh of [`PLY`] as a binary file, with another name for the list and another order of the elements.
fn binary_ply(big: bool) -> Vec<u8> {
    let order = if big { "big" } else { "little" };
    let mut bytes = format!(
        "ply\nformat binary_{order}_endian 1.0\nelement face 2\nproperty uchar flag\n\
         property list uint ushort vertex_index\nelement vertex 4\nproperty double x\nproperty short y\n\
         property float z\nend_header\n"
    )
    .into_bytes();
    let push = |bytes: &mut Vec<u8>, mut number: Vec<u8>| {
        // The numbers come in little-endian order.
        if big {
            number.reverse();
        }
        bytes.extend(number);
    };
    for corners in [&[0u16, 1, 2][..], &[0, 1, 2, 3]] {
        bytes.push(255);
        push(&mut bytes, (corners.len() as u32).to_le_bytes().to_vec());
        corners.iter().for_each(|i| push(&mut bytes, i.to_le_bytes().to_vec()));
    }
    for (x, y, z) in [(0.0, 0i16, 0.0), (1.0, 0, 0.0), (0.0, 1, 0.5), (-1e99, 0, 0.0f32)] {
        push(&mut bytes, f64::to_le_bytes(x).to_vec());
        push(&mut bytes, y.to_le_bytes().to_vec());
        push(&mut bytes, z.to_le_bytes().to_vec());
    }
    bytes
}

#[test]
fn ply_is_read_in_all_encodings() {
    let vertices = [[0., 0., 0.], [1., 0., 0.], [0., 1., 0.5], [-1e99, 0., 0.]];
    let vertices = vertices.into_iter().map(Point3::from).collect();
    let expected = Mesh { vertices, faces: vec![[0, 1, 2], [0, 1, 2], [0, 2, 3]] };
    assert_eq!(read_bytes(".ply", PLY.as_bytes()).unwrap(), expected);
    assert_eq!(read_bytes(".ply", PLY.replace('\n', "\r\n").as_bytes()).unwrap(), expected);
    for big in [false, true] {
        assert_eq!(read_bytes(".PLY", &binary_ply(big)).unwrap(), expected, "big-endian: {big}");
    }
}

#[test]
fn every_fault_of_a_ply_file_is_one_clear_line() {
    let cut = |bytes: &[u8], less: usize| bytes[..bytes.len() - less].to_vec();
    let huge = |from: &str, to: &str| PLY.replace(from, to).into_bytes();
    let cases: [(Vec<u8>, &str); 14] = [
        (vec![], "Unexpected end of file while reading magic number"),
        (huge("ply\n", "plu\n"), "1: Expected magic number"),
        (huge("element vertex 4", "element vertex"), "4: Couldn't parse line"),
        (huge("property float z", "property float w"), "no number z of a vertex: expected a PLY header with"),
        (huge("element face", "element fase"), "no element face: expected"),
        (huge("int vertex_indices", "float vertex_indices"), "no list of vertex indices of a face: expected"),
        (huge("element face 2", "element face 0"), "no face: expected"),
        (huge("element face 2", "element face 4000000000"), "21: face 2: the file ends before it, of 4000000000"),
        (huge("0 1 0.5 9", "0 one 0.5 9"), "16: vertex 2: 'one' is no finite number: expected"),
        (huge("3 0 1 2", "4000000000000 0 1 2"), "19: face 0: a list with fewer numbers than it announces: expected"),
        (huge("3 0 1 2", "3 0 1 9"), "19: face 0 has vertex 9 in a file of 4: expected three or more"),
        (huge("3 0 1 2", "2 0 1"), "19: face 0 has 2 vertices: expected"),
        (huge("-1e99", "nan"), "17: vertex 3 has the coordinate NaN: expected a finite number"),
        (cut(&binary_ply(false), 1), "vertex 3: the file ends within it: expected the numbers"),
    ];
    for (bytes, expected) in cases {
        let found = message(".ply", &bytes);
        assert!(found.starts_with(expected), "{found} instead of {expected}");
    }
    let mut list = binary_ply(true);
    let at = list.windows(4).position(|w| w == [0, 0, 0, 3]).unwrap();
    list[at] = 0xff;
    assert!(message(".ply", &list).starts_with("face 0: the file ends within it"), "a list of 4 G numbers");
}

/// What a survey of `bytes` says.
fn survey_bytes(extension: &str, bytes: &[u8]) -> (Mesh, Findings) {
    let mut file = tempfile::Builder::new().suffix(extension).tempfile().unwrap();
    file.write_all(bytes).unwrap();
    survey(file.path()).unwrap()
}

#[test]
fn broken_faces_are_reported_and_left_out() {
    let obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv nan 0 0\nv 2 0 -0\nf 1 2 3\nf 1 2\nf 1 2 9\nf 1 2 0\nf 1 2 4\nf 3 2 1\n\
        f 1 2 5\nf 2 2 3\n";
    let (mesh, findings) = survey_bytes(".obj", obj.as_bytes());
    assert_eq!(mesh.faces, [[0, 1, 2], [2, 1, 0], [0, 1, 3], [1, 1, 2]]);
    assert_eq!(mesh.vertices.len(), 4);
    assert_eq!(findings.left_out(), 4);
    assert_eq!(
        findings.to_string(),
        "faces left out: 1 with fewer than three corners (first: line 7: a face of 2 vertices), 2 with a vertex out of \
         range (first: line 8: vertex '9' in a file of 5), 1 with a coordinate that is not finite (first: line 4: \
         'v nan 0 0'); faces kept: 2 degenerate (first: triangle 2), 1 duplicate (first: triangle 1)"
    );
    let defects: Vec<Defect> = findings.list.iter().map(|finding| finding.defect).collect();
    assert_eq!(defects, Defect::ALL);

    let stl = binary(b"", 3, &[[0., 0., 0., 1., 0., 0., 0., 1., 0.], [f32::INFINITY; 9], [3.; 9]]);
    let (mesh, findings) = survey_bytes(".stl", &stl);
    assert_eq!(mesh.faces.len(), 2);
    let text = "faces left out: 1 with a coordinate that is not finite (first: triangle 1 has the coordinate inf); \
        faces kept: 1 degenerate (first: triangle 1)";
    assert_eq!(findings.to_string(), text);

    let ply = PLY.replace("3 0 1 2", "3 0 1 -1").replace("-1e99", "inf");
    let (mesh, findings) = survey_bytes(".ply", ply.as_bytes());
    assert_eq!((mesh.faces.len(), findings.left_out()), (1, 2));
    assert!(findings.to_string().contains("(first: line 19: face 0 has vertex -1 in a file of 4)"), "{findings}");
    assert!(findings.to_string().contains("(first: line 17: vertex 3 has the coordinate inf)"), "{findings}");
    assert!(survey_bytes(".ply", &binary_ply(true)).1.to_string().starts_with("faces kept: 1 duplicate"));
}

#[test]
fn a_survey_of_nothing_that_can_be_used_is_an_error() {
    let mut file = tempfile::Builder::new().suffix(".obj").tempfile().unwrap();
    file.write_all(b"v 0 0 0\nf 1 2 3\n").unwrap();
    let error = survey(file.path()).unwrap_err().to_string();
    assert!(error.contains(":2: vertex '2' in a file of 1: expected 'f'"), "{error}");
}

#[test]
fn the_headlight_is_complete() {
    let mesh = headlight();
    assert_eq!((mesh.faces.len(), mesh.vertices.len()), (5962, 2979));
    let bounds = mesh.bounds();
    assert_eq!(bounds.half_size(), 122.0);
    assert_eq!((bounds.max - bounds.min).y, 140.0);
    assert!(Arc::ptr_eq(&mesh, &headlight()));
}

#[test]
fn formats_agree_on_one_triangle() {
    let expected = Mesh {
        vertices: vec![Point3::new(0., 0., 0.), Point3::new(1., 0., 0.), Point3::new(0., 1., 0.5)],
        faces: vec![[0, 1, 2]],
    };
    let corners = [0., 0., 0., 1., 0., 0., 0., 1., 0.5];
    // The header of the first is the trap: a binary file that begins as an ASCII file does.
    assert_eq!(read_bytes(".stl", &binary(b"solid trap", 1, &[corners])).unwrap(), expected);
    assert_eq!(read_bytes(".STL", format!("solid\n{FACET}endsolid\n").as_bytes()).unwrap(), expected);
    assert_eq!(
        read_bytes(".stl", format!("\r\nSOLID name\r\n{FACET}ENDSOLID name").to_uppercase().as_bytes()).unwrap(),
        expected
    );
    let obj = b"mtllib none.mtl\no name\nv 0 0 0 # origin\nv 1 0 0 0.5 0.5 0.5\nv 0 2 1 2\nvt 0 0\nusemtl x\n\
        f 1/1/9 -2 3//\n";
    assert_eq!(read_bytes(".obj", obj).unwrap(), expected);
}

#[test]
fn several_solids_and_polygons_are_read_whole() {
    let two = format!("solid a\n{FACET}{FACET}endsolid a\n\nsolid b\n{FACET}endsolid b\n");
    assert_eq!(read_bytes(".stl", two.as_bytes()).unwrap().faces, [[0, 1, 2]; 3]);
    let pentagon = b"g a\nf 1 2 3 4 5\ng b\nf 5 4 3\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0.5 2 0\nv 0 1 0\nl 1 2\n";
    let mesh = read_bytes(".obj", pentagon).unwrap();
    assert_eq!(mesh.faces, [[0, 1, 2], [0, 2, 3], [0, 3, 4], [4, 3, 2]]);
}

#[test]
fn every_fault_of_an_stl_file_is_one_clear_line() {
    let nan = binary(b"", 2, &[[0.; 9], [f32::NAN; 9]]);
    let cases: [(Vec<u8>, &str); 9] = [
        (vec![], "empty file: expected binary STL"),
        (vec![7; 50], "50 bytes, less than the header of a binary STL: expected"),
        (binary(b"", u32::MAX, &[[0.; 9]]), "134 bytes where 4294967295 triangles take 214748364834: expected"),
        (binary(b"solid", 2, &[[0.; 9]]), "134 bytes where 2 triangles take 184: expected"),
        (binary(b"", 0, &[]), "no triangle: expected at least one"),
        (nan, "triangle 1 has the coordinate NaN: expected a finite number"),
        (b"solid empty\nendsolid\n".to_vec(), "no triangle: expected at least one"),
        (format!("solid\n{FACET}").into(), "8: EOF while expecting facet or endsolid.: expected facet normal"),
        (format!("solid\n{FACET}endsolid\nliquid").into(), "10: 'liquid': expected 'solid' and a name"),
    ];
    for (bytes, expected) in cases {
        let found = message(".stl", &bytes);
        assert!(found.starts_with(expected), "{found}");
    }
    for (bad, line) in [("vertex 1 0", 5), ("vertex 1 0 inf", 5), ("vertex 1 0 1e99", 5), ("vertex a b c", 5)] {
        let found = message(".stl", format!("solid\n{FACET}endsolid").replace("vertex 1 0 0", bad).as_bytes());
        assert!(found.starts_with(&format!("{line}: ")), "{found}");
    }
    let long = message(".stl", format!("solid x\n{}\u{7}", "garbage".repeat(1000)).as_bytes());
    assert!(long.starts_with("2: invalid facet header") && long.len() < 400, "{long}");
}

#[test]
fn every_fault_of_an_obj_file_is_one_clear_line() {
    let triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    let cases = [
        (String::new(), "empty file: expected"),
        (triangle.to_owned(), "no face: expected at least one line 'f'"),
        (format!("{triangle}f 1 2 4\n"), "4: vertex '4' in a file of 3: expected 'f' and three"),
        (format!("{triangle}f 1 2 0\n"), "4: vertex '0' in"),
        (format!("{triangle}f 1 2 -4\n"), "4: vertex '-4' in"),
        (format!("{triangle}f 1 2 99999999999999999999\n"), "4: vertex '99999999999999999999' in"),
        (format!("{triangle}f 1 2 x/1\n"), "4: vertex 'x/1' in"),
        (format!("{triangle}f 1 2\n"), "4: a face of 2 vertices: expected"),
        (format!("{triangle}\nv 1 2\nf 1 2 3\n"), "5: position parse error: expected 'v x y z'"),
        (format!("{triangle}v 1 2 3 4 5\nf 1 2 3\n"), "4: color parse error"),
        (format!("{triangle}v 1 2 3 0\nf 1 2 3\n"), "4: scaling (w) by zero: expected 'v x y z'"),
        (format!("{triangle}v 1 2 nan\nf 1 2 4\n"), "4: 'v 1 2 nan': expected 'v x y z'"),
        (format!("{triangle}v 1 -1e999 0\nf 1 2 4\n"), "4: 'v 1 -1e999 0': expected"),
        (format!("{triangle}v 1 1e300 0 1e-300\nf 1 2 4\n"), "a coordinate that overflows"),
    ];
    for (text, expected) in cases {
        let found = message(".obj", text.as_bytes());
        assert!(found.starts_with(expected), "{text:?}: {found}");
    }
}

#[test]
fn files_that_are_none_are_named() {
    let absent = read(Path::new("no/such/file.stl")).unwrap_err().to_string();
    assert!(
        absent.starts_with("no/such/file.stl: cannot be read (") && absent.ends_with("a readable file"),
        "{absent}"
    );
    assert!(read(Path::new(env!("CARGO_MANIFEST_DIR"))).is_err());
    let ply = read(Path::new("mesh.off")).unwrap_err().to_string();
    assert_eq!(ply, "mesh.off: extension 'off': expected .stl, .obj or .ply");
    let mistyped = read(Path::new("no-mesh")).unwrap_err().to_string();
    assert_eq!(mistyped, "no-mesh: not found: expected a file that ends in .stl, .obj or .ply");
}

/// Random bytes, and valid files with a few bytes changed or the end cut off, must never panic; what is accepted is
/// valid.
#[test]
fn damaged_files_never_panic() {
    let mut rng = ChaCha8Rng::seed_from_u64(1);
    let seeds: [Vec<u8>; 7] = [
        binary(b"solid", 2, &[[1.; 9], [2.; 9]]),
        format!("solid a\n{FACET}endsolid a\nsolid b\n{FACET}endsolid b").into_bytes(),
        b"v 0 0 0\nv 1 0 0 2\nv 0 1 0 1 1 1\nf 1 2/3/4 -1\no x\nf 1//-7 2 3 1\nusemtl\nvt 1\n".to_vec(),
        (0..300).map(|_| rng.random()).collect(),
        PLY.as_bytes().to_vec(),
        binary_ply(false),
        binary_ply(true),
    ];
    for round in 0..8000 {
        let mut bytes = seeds[round % seeds.len()].clone();
        for _ in 0..rng.random_range(0..6) {
            let at = rng.random_range(0..bytes.len());
            bytes[at] = if rng.random() { rng.random() } else { *b"-/1 9\n.#e"[..].get(at % 9).unwrap() };
        }
        bytes.truncate(rng.random_range(0..=2 * bytes.len()));
        for parse in [stl::parse, obj::parse, ply::parse] {
            if let Ok(Parsed { mesh, faults }) = parse(&bytes) {
                assert!(mesh.vertices.iter().all(|v| v.iter().all(|x| x.is_finite())));
                assert!(!mesh.faces.is_empty() || !faults.is_empty());
                assert!(mesh.faces.iter().flatten().all(|&v| (v as usize) < mesh.vertices.len()));
            }
        }
    }
}

#[test]
fn the_shared_meshes_are_read() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/meshes");
    for (file, faces) in [("tray_bottom.obj", 4520), ("gearwheel.stl", 2444), ("headlight_cluster.obj", 5891)] {
        let path = folder.join(file);
        if path.exists() {
            assert_eq!(read(&path).unwrap().faces.len(), faces);
        }
    }
}
