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
    let cases: [(Vec<u8>, &str); 22] = [
        (vec![], "1: '' for 'ply': expected a PLY header"),
        (huge("ply\n", "plu\n"), "1: 'plu' for 'ply': expected"),
        (huge("element vertex 4", "element vertex"), "4: 'element vertex': expected"),
        (huge("end_header\n0", "0"), "13: '0 0 0 9': expected a PLY header"),
        (huge("format ascii 1.0\n", ""), "12: no line 'format': expected"),
        (huge("property float y", "property half y"), "6: 'property half y': expected"),
        (huge("property float y", "property float x"), "6: a second 'property float x': expected"),
        (huge("element edge", "element vertex"), "9: a second 'element vertex 1': expected"),
        (huge("property float z", "property float w"), "no number z of a vertex: expected a PLY header with"),
        (huge("element face", "element fase"), "no element face: expected"),
        (huge("int vertex_indices", "float vertex_indices"), "no list of vertex indices of a face: expected"),
        (huge("element face 2", "element face 0"), "no face: expected"),
        (
            huge("element face 2", "element face 4000000000"),
            "20: face 2, vertex_indices: the file ends before it: expected a list",
        ),
        (huge("0 1 0.5 9", "0 one 0.5 9"), "16: vertex 2, y: 'one' is no number: expected a vertex as"),
        (
            huge("3 0 1 2", "4000000000000 0 1 2"),
            "19: face 0, vertex_indices: a list of 4000000000000 numbers, which the file does not have",
        ),
        (huge("3 0 1 2", "3 0 1 9"), "19: face 0 has vertex 9 in a file of 4: expected three or more"),
        (huge("3 0 1 2", "2 0 1"), "19: face 0 has 2 vertices: expected"),
        (huge("-1e99", "nan"), "17: vertex 3 has the coordinate NaN: expected a finite number"),
        (huge("0 1 0.5 9", "0 1 0.5 9 9"), "16: vertex 2: '9' behind it on its line: expected a vertex"),
        (
            huge("0 1 0.5 9", "0 1,0 0.5 9"),
            "16: vertex 2, y: '1,0': a decimal comma or a comma between numbers is no number",
        ),
        (huge("0 1 0.5 9", "0 1 0.5"), "17: vertex 2: '0 0 9' behind it on its line: expected"),
        (cut(&binary_ply(false), 1), "vertex 3, z: the file ends within it: expected a vertex"),
    ];
    for (bytes, expected) in cases {
        let found = message(".ply", &bytes);
        assert!(found.starts_with(expected), "{found} instead of {expected}");
    }
    let mut list = binary_ply(true);
    let at = list.windows(4).position(|w| w == [0, 0, 0, 3]).unwrap();
    list[at] = 0xff;
    assert!(
        message(".ply", &list).starts_with("face 0, vertex_index: a list of 4278190083 numbers, which the file does"),
        "a list of 4 G numbers"
    );
}

/// What a survey of `bytes` says.
fn survey_bytes(extension: &str, bytes: &[u8]) -> (Mesh, Findings) {
    let mut file = tempfile::Builder::new().suffix(extension).tempfile().unwrap();
    file.write_all(bytes).unwrap();
    survey(file.path()).unwrap()
}

#[test]
fn broken_faces_are_reported_and_left_out() {
    let obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv nan 0 0\nv 2 0 -0\nf 1 2 3\nf 1 2\nf 1 2 9\nf 1 2 -9\nf 1 2 4\nf 3 2 1\n\
        f 1 2 5\nf 2 2 3\nv 1 1 0\nv 0.5 0.5 2\nf 1 2 3 6\nf 1 2 6 3\nf 1 2 7 3\n";
    let (mesh, findings) = survey_bytes(".obj", obj.as_bytes());
    let split = [[0, 1, 4], [0, 4, 2], [0, 1, 5], [0, 5, 2]];
    assert_eq!(mesh.faces, [&[[0, 1, 2], [2, 1, 0], [0, 1, 3], [1, 1, 2]], &split[..]].concat());
    assert_eq!(mesh.vertices.len(), 6);
    assert_eq!(findings.left_out(), 5);
    let names: Vec<String> = (0..8).map(|triangle| findings.numbers.name(triangle)).collect();
    assert_eq!(names, ["0.0", "5.0", "6.0", "7.0", "9.0", "9.1", "10.0", "10.1"]);
    assert_eq!(
        findings.to_string(),
        "faces left out: 1 with fewer than three corners (first: line 7: a face of 2 vertices), 2 with a vertex out of \
         range (first: line 8: vertex '9' in a file of 7), 1 with a coordinate that is not finite (first: line 4: \
         vertex 4 has the coordinate NaN), 1 with a polygon that is not simple (first: line 16: a face of 4 corners); faces kept: \
         1 not exactly in one plane (first: line 18: a corner is 9.7e-1 off the plane of others), 2 degenerate (first: \
         triangle 6.0), 1 duplicate (first: triangle 5.0)"
    );
    let defects: Vec<Defect> = findings.list.iter().map(|finding| finding.defect).collect();
    assert_eq!(defects, Defect::ALL);

    let stl = binary(b"", 3, &[[0., 0., 0., 1., 0., 0., 0., 1., 0.], [f32::INFINITY; 9], [3.; 9]]);
    let (mesh, findings) = survey_bytes(".stl", &stl);
    assert_eq!(mesh.faces.len(), 2);
    let text = "faces left out: 1 with a coordinate that is not finite (first: triangle 1 has the coordinate inf); \
        faces kept: 1 degenerate (first: triangle 2)";
    assert_eq!(findings.to_string(), text);

    let ply = PLY.replace("3 0 1 2", "3 0 1 -1").replace("-1e99", "inf").replace("face 2", "face 3") + "3 0 1 2\n";
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
    let cases: [(Vec<u8>, &str); 13] = [
        (vec![], "empty file: expected binary STL"),
        (vec![7; 50], "50 bytes, less than the header of a binary STL: expected"),
        (binary(b"", u32::MAX, &[[0.; 9]]), "134 bytes where 4294967295 triangles take 214748364834: expected"),
        (binary(b"solid", 2, &[[0.; 9]]), "134 bytes where 2 triangles take 184: expected"),
        (binary(b"", 0, &[]), "no triangle: expected at least one"),
        (nan, "triangle 1 has the coordinate NaN: expected a finite number"),
        (format!("solid\n{FACET}").replace("endloop", "vertex 1 1 1").into(), "7: 'vertex' for 'endloop': expected"),
        (format!("solid\n{FACET}").replace("endloop", "end").into(), "7: 'end' for 'endloop': expected"),
        (b"v 0 0 0\n".repeat(20), "1: text that begins with 'v': expected binary STL"),
        (b"\xff\xfes\0o\0l\0i\0d\0".to_vec(), "12 bytes, less than"),
        (b"solid empty\nendsolid\n".to_vec(), "no triangle: expected at least one"),
        (format!("solid\n{FACET}").into(), "8: the file ends before 'endsolid': expected 'facet normal'"),
        (format!("solid\n{FACET}endsolid\nliquid").into(), "10: 'liquid': expected 'solid' and a name"),
    ];
    for (bytes, expected) in cases {
        let found = message(".stl", &bytes);
        assert!(found.starts_with(expected), "{found}");
    }
    for (bad, line) in [("vertex 1 0", 6), ("vertex 1 0 1e-400", 5), ("vertex 1 0,0 0", 5), ("vertex a b c", 5)] {
        let found = message(".stl", format!("solid\n{FACET}endsolid").replace("vertex 1 0 0", bad).as_bytes());
        assert!(found.starts_with(&format!("{line}: ")), "{found}");
    }
    let long = message(".stl", format!("solid x\n{}\u{7}", "garbage".repeat(1000)).as_bytes());
    assert!(long.starts_with("2: 'garbagegarbage") && long.len() < 400, "{long}");
}

#[test]
fn every_fault_of_an_obj_file_is_one_clear_line() {
    let triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    let cases = [
        (String::new(), "empty file: expected"),
        (triangle.to_owned(), "no face: expected at least one line 'f'"),
        (format!("{triangle}f 1 2 4\n"), "4: vertex '4' in a file of 3: expected 'f' and three"),
        (format!("{triangle}f 1 2 0\n"), "4: vertex 0 in 'f 1 2 0': expected vertices counted from 1"),
        (format!("{triangle}f 1 2 -4\n"), "4: vertex '-4' in"),
        (format!("{triangle}f 1 2 99999999999999999999\n"), "4: vertex '99999999999999999999' in"),
        (format!("{triangle}f 1 2 x/1\n"), "4: vertex 'x/1' in"),
        (format!("{triangle}f 1 2\n"), "4: a face of 2 vertices: expected"),
        (format!("{triangle}\nv 1 2\nf 1 2 3\n"), "5: 2 numbers in 'v 1 2': expected 'v x y z'"),
        (format!("{triangle}v 1 2 3 4 5\nf 1 2 3\n"), "4: 5 numbers in 'v 1 2 3 4 5': expected"),
        (format!("{triangle}v 1 2 3 0\nf 1 2 3\n"), "4: the weight '0' in 'v 1 2 3 0': expected 'v x y z'"),
        (format!("{triangle}v 1 2 nan\nf 1 2 4\n"), "4: vertex 4 has the coordinate NaN: expected a finite"),
        (format!("{triangle}v 1 -1e999 0\nf 1 2 4\n"), "4: vertex 4 has the coordinate -inf: expected"),
        (
            format!("{triangle}v 1 1e300 0 1e-300\nf 1 2 4\n"),
            "4: 'v 1 1e300 0 1e-300': a coordinate divided by its weight leaves",
        ),
        (
            format!("{triangle}v 1 0, 2\nf 1 2 3\n"),
            "4: '0,': a decimal comma or a comma between numbers in 'v 1 0, 2' is no",
        ),
        (format!("{triangle}v 1 1.#QX 2\nf 1 2 3\n"), "4: '1.#QX' in 'v 1 1.#QX 2' is no number: expected"),
        (format!("{triangle}V 1 0 2\nf 1 2 3\n"), "4: 'V' in 'V 1 0 2': expected 'v' and 'f' in small letters"),
        (format!("{triangle}F 1 2 3\n"), "4: 'F' in 'F 1 2 3': expected 'v' and 'f' in small letters"),
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
    let ply = read(Path::new("mesh.3mf")).unwrap_err().to_string();
    assert_eq!(ply, "mesh.3mf: extension '3mf': expected .stl, .obj, .ply or .off");
    let mistyped = read(Path::new("no-mesh")).unwrap_err().to_string();
    assert_eq!(mistyped, "no-mesh: not found: expected a file that ends in .stl, .obj, .ply or .off");
}

/// A point on no surface has no say in boxes, scales and grids, be it in use by a face that is left out or by none.
#[test]
fn vertices_that_no_face_uses_are_left_out() {
    let text = "v 1e9 0 0\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv nan 0 0\nv 7 7 7\nf 2 3 4\nf 1 2 9\n";
    let mut file = tempfile::Builder::new().suffix(".obj").tempfile().unwrap();
    file.write_all(text.as_bytes()).unwrap();
    let (mesh, findings) = survey(file.path()).unwrap();
    assert_eq!((mesh.vertices.len(), &mesh.faces[..], findings.left_out()), (3, &[[0, 1, 2]][..], 1));
    assert_eq!(mesh.vertices[1], Point3::new(1.0, 0.0, 0.0));
}

/// Random bytes, and valid files with a few bytes changed or the end cut off, must never panic; what is accepted is
/// valid.
#[test]
fn damaged_files_never_panic() {
    let mut rng = ChaCha8Rng::seed_from_u64(1);
    let seeds: [Vec<u8>; 8] = [
        binary(b"solid", 2, &[[1.; 9], [2.; 9]]),
        format!("solid a\n{FACET}endsolid a\nsolid b\n{FACET}endsolid b").into_bytes(),
        b"v 0 0 0\nv 1 0 0 2\nv 0 1 0 1 1 1\nf 1 2/3/4 -1\no x\nf 1//-7 2 3 1\nusemtl\nvt 1\n".to_vec(),
        (0..300).map(|_| rng.random()).collect(),
        PLY.as_bytes().to_vec(),
        binary_ply(false),
        binary_ply(true),
        b"NOFF\n4 2 0 # n\n0 0 0 0 0 1\n1 0 0 0 0 1\n1 1 0 0 0 1\n0 1 0 0 0 1\n4 0 1 2 3 255 0 0\n3 0 1 2\n".to_vec(),
    ];
    for round in 0..8000 {
        let mut bytes = seeds[round % seeds.len()].clone();
        for _ in 0..rng.random_range(0..6) {
            let at = rng.random_range(0..bytes.len());
            bytes[at] = if rng.random() { rng.random() } else { *b"-/1 9\n.#e"[..].get(at % 9).unwrap() };
        }
        bytes.truncate(rng.random_range(0..=2 * bytes.len()));
        for parse in [stl::parse, obj::parse, ply::parse, off::parse] {
            if let Ok(Parsed { mesh, faults, numbers, remarks }) = parse(&bytes) {
                let findings = Findings::of(&mesh, &faults, remarks, numbers);
                assert!(!findings.to_string().contains(char::is_control));
                assert!(mesh.vertices.iter().all(|v| v.iter().all(|x| x.is_finite())));
                assert!(!mesh.faces.is_empty() || !faults.0.is_empty());
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

/// The corners of all triangles.
fn corners(mesh: &Mesh) -> Vec<[[f64; 3]; 3]> {
    (0..mesh.faces.len()).map(|face| mesh.triangle(face).map(<[f64; 3]>::from)).collect()
}

const CROSSING: [[[f64; 3]; 3]; 2] =
    [[[0., 0., 0.], [4., 0., 0.], [0., 4., 0.]], [[1., 1., -1.], [1., 1., 1.], [2., 1.5, 1.]]];

/// The two triangles as text: what stands before and behind them, and how numbers and lines are written.
fn written(before: &str, line: impl Fn(&str) -> String, behind: &str) -> String {
    let points = CROSSING.as_flattened().iter().map(|p| line(&format!("{} {} {}", p[0], p[1], p[2])));
    [before.to_owned(), points.collect(), behind.to_owned()].concat()
}

/// What programs of the trade write, and what stands beside the geometry; all of it is the same two triangles.
#[test]
fn files_of_other_programs_are_read_as_they_are_meant() {
    let plain = |numbers: &str| format!("{numbers}\n");
    let v = |numbers: &str| format!("v {numbers}\n");
    let obj = written("", v, "f 1 2 3\nf 4 5 6\n");
    let ply_header = |vertex: &str, face: &str| {
        format!(
            "ply\nformat ascii 1.0\nobj_info x\nelement vertex 6\nproperty float x\nproperty float y\nproperty float z\n\
             {vertex}element face 2\nproperty list uchar int vertex_indices\n{face}end_header\n"
        )
    };
    let ply = written(&ply_header("", ""), plain, "3 0 1 2\n3 3 4 5\n");
    let off = written("OFF\n6 2 0\n", plain, "3 0 1 2\n3 3 4 5\n");
    let facet = |t: &[[f64; 3]; 3]| {
        let vertex = |p: &[f64; 3]| format!("vertex {} {} {}\n", p[0], p[1], p[2]);
        format!("facet normal 0 0 1\nouter loop\n{}endloop\nendfacet\n", t.iter().map(vertex).collect::<String>())
    };
    let stl = format!("solid part\n{}endsolid part\n", CROSSING.iter().map(facet).collect::<String>());
    let strips = ply_header("", "").replace("element face 2", "element tristrips 1").replace("uchar int", "int int");
    let cases = [
        (".obj", obj.clone()),
        (".obj", obj.replace("f 4 5 6", "f 4/9/9 5//0 -1/1")),
        (".obj", written("f 1 2 3\nf 4 5 6\n", v, "")),
        (".obj", written("", |n| format!("v\t{n}  \\\n\n"), "f 1 2 \\ \n3\nf \\\n4 \\\n5 6")),
        (".obj", written("", |n| format!("  v {n} 0.5 0.5 0.5 # c \\\n"), "g a \\\nf 1 2 3\nf 4 5 6\n")),
        (".obj", written("", |n| format!("v {n} 1\n"), "f 1 2 3\nf 4 5 6\n")),
        (".obj", written("", |n| format!("v {n} 1 0 0 0.5\n"), "f 1 2 3\nf 4 5 6\n")),
        (".obj", written("v nan 1.#QNAN -1.#IND\n", |n| format!("vn nan 0 0\nv {n}\n"), "f 2 3 4\nf 5 6 7\n")),
        (".ply", ply.clone()),
        (".ply", ply.replace("\n0", "\n\n \n0").replace("\n1 1 ", "\n1\n1 ")),
        (".ply", written(&ply_header("property float nx\n", ""), |n| format!("{n} -1.#IND\n"), "3 0 1 2\n3 3 4 5\n")),
        (
            ".ply",
            written(&ply_header("property float nx\n", ""), |n| format!("{n}\n-nan(ind)\n"), "3 0 1\n2\n3 3 4 5\n"),
        ),
        (
            ".ply",
            written(
                &ply_header("", "property list uchar float texcoord\nproperty float quality\n"),
                plain,
                "3 0 1 2 2 0 nan nan\n3 3 4 5\n0 1.#INF\n",
            ),
        ),
        (".ply", written(&strips, plain, "8 0 1 2 -1 3 4\n5 5\n")),
        (".off", off.clone()),
        (".off", off.replace("OFF\n", "OFF ")),
        (".off", off.replace("OFF\n", "OFF")),
        (".off", off.replace("OFF\n", "# a comment\n\nOFF # b\n\n").replace("6 2 0", "6 2")),
        (".off", off.replace("OFF\n", "")),
        (".off", written("COFF\n6 2 0\n", |n| format!("{n} 255 0 0 255\n"), "3 0 1 2 1\n\n3 3 4 5  0.1 0.2 0.3 # red")),
        (".off", written("STNOFF\n6 2 0\n", |n| format!("{n} nan 0 1 0 0\n"), "3 0 1 2\n3 3 4 5\n")),
        (".stl", stl.clone()),
        (".stl", stl.replace("endloop", "end loop").replace("endfacet", "End Facet").replace("endsolid", "end solid")),
        (".stl", stl.replace("normal 0 0 1", "normal nan -nan(ind) 1,0").replace("facet", "FACET")),
        (".stl", stl.replace("normal 0 0 1", "")),
        (".stl", stl.replace('\n', " ")),
        (".stl", stl.replace("endfacet\nfacet", "endfacet\nendsolid part\nsolid solid facet\nfacet")),
        (".stl", stl.replace("endfacet\nfacet", "endfacet\nendsolid part\nsolid other\nfacet").replace('\n', " ")),
    ];
    for (extension, text) in cases {
        for end in ["\n", "\r\n", "\r"] {
            for mark in ["", "\u{feff}"] {
                let text = format!("{mark}{}", text.replace('\n', end));
                let (mesh, findings) = survey_bytes(extension, text.as_bytes());
                assert_eq!(corners(&mesh), CROSSING, "{text:?}");
                assert!(!findings.must_be_said(), "{findings}: {text:?}");
            }
        }
    }
    // What has a right extension only in its content.
    for (extension, text) in [(".stl", &ply), (".obj", &stl), (".ply", &off), (".off", &ply), (".obj", &ply)] {
        let (mesh, findings) = survey_bytes(extension, text.as_bytes());
        assert_eq!(corners(&mesh), CROSSING);
        assert!(findings.to_string().starts_with("read as what its content is ("), "{findings}");
    }
}

#[test]
fn binary_lists_of_64_bits_and_data_that_looks_like_a_line_end_are_read() {
    for end in ["\n", "\r\n", "\r"] {
        let header = "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty uint64 x\nproperty char y\n\
            property double z\nelement face 1\nproperty list uint8 int64 vertex_index\nend_header\n";
        let mut bytes = header.replace('\n', end).into_bytes();
        for (x, y, z) in [(0x0du64, 1i8, f64::NAN), (0x0a, -1, 0.5), (7, 0, 1e300)] {
            bytes.extend(x.to_le_bytes());
            bytes.extend(y.to_le_bytes());
            bytes.extend(z.to_le_bytes());
        }
        bytes.push(3);
        [1i64, 2, 1].iter().for_each(|i| bytes.extend(i.to_le_bytes()));
        let mesh = read_bytes(".ply", &bytes).unwrap();
        assert_eq!(corners(&mesh), [[[10., -1., 0.5], [7., 0., 1e300], [10., -1., 0.5]]], "{end:?}");
        bytes.extend([1, 2, 3]);
        let (_, findings) = survey_bytes(".ply", &bytes);
        assert_eq!(findings.remarks.len(), 1, "{findings}");
    }
}

#[test]
fn what_is_not_read_is_said() {
    let stl = binary(b"", 1, &[[0., 0., 0., 1., 0., 0., 0., 1., 0.]]);
    let said = |extension: &str, bytes: &[u8]| {
        let (mesh, findings) = survey_bytes(extension, bytes);
        assert_eq!(mesh.faces, [[0, 1, 2]]);
        assert!(findings.must_be_said());
        findings.to_string()
    };
    let behind = [&stl[..], &[0; 428]].concat();
    assert_eq!(said(".stl", &behind), "bytes behind the last triangle, not read (428)");
    let mut none = stl.clone();
    none[80] = 0;
    assert_eq!(said(".stl", &none), "the header counts 0 triangles (as many as the size tells are read: 1)");
    let obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nsurf 0 1 0 1\nfoo\n";
    assert_eq!(said(".obj", obj.as_bytes()), "lines not read, 2 times (first: line 5: 'surf 0 1 0 1')");
    let off = "OFF 3 1 0\n0 0 0 5\n1 0 0\n0 1 0\n3 0 1 2 a b c d e\nmore\n";
    assert_eq!(
        said(".off", off.as_bytes()),
        "numbers behind the coordinates of a vertex, not read (line 2: '5'); words behind the corners of a face that are no \
         colour, not read (line 5: 'a b c d e'); text behind the last face, not read (line 6: 'more')"
    );
    let ply = PLY.replace("element face 2", "element face 1");
    assert_eq!(said(".ply", ply.as_bytes()), "what stands behind the last element, not read (line 20: '4')");
}

#[test]
fn every_fault_of_an_off_file_is_one_clear_line() {
    let off = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
    let with = |from: &str, to: &str| off.replace(from, to).into_bytes();
    let cases: [(Vec<u8>, &str); 14] = [
        (vec![], "empty file: expected 'OFF'"),
        (with("OFF", "4OFF"), "1: '4OFF': expected 'OFF'"),
        (with("OFF", "OFF BINARY"), "1: binary OFF: expected OFF as text"),
        (with("OFF", "of"), "1: 'of': expected 'OFF'"),
        (with("3 1 0", "3 x 0"), "2: 'x' for the number of faces: expected 'OFF'"),
        (with("3 1 0", "3 1 0 4"), "2: '0 4' behind the number of faces: expected"),
        (with("3 1 0", "3 0 0"), "no face: expected"),
        (with("3 1 0", "3 2 0"), "6: face 1: the file ends before it, of 2: expected"),
        (
            with("1 0 0", "1 0,5 0"),
            "4: vertex 1: '0,5': a decimal comma or a comma between numbers is no number: expected",
        ),
        (with("1 0 0", "1 0"), "4: vertex 1: a line of 2 numbers: expected"),
        (with("3 0 1 2", "3 0 1"), "6: face 0: the file ends within it: expected"),
        (with("3 0 1 2", "3 0 1 x"), "6: face 0: vertex 'x': expected"),
        (with("3 0 1 2", "3 0 1 3"), "6: face 0 has vertex 3 in a file of 3: expected"),
        (with("3 0 1 2", "2 0 1"), "6: face 0 has 2 vertices: expected"),
    ];
    for (bytes, expected) in cases {
        let found = message(".off", &bytes);
        assert!(found.starts_with(expected), "{found} instead of {expected}");
    }
}

#[test]
fn decimals_of_ascii_stl_stand_for_binary64_numbers() {
    let text = format!("solid\n{FACET}endsolid\n").replace("1 0 0", "580000.12 1e-50 4790000.3549999995");
    assert_eq!(corners(&read_bytes(".stl", text.as_bytes()).unwrap())[0][1], [580000.12, 1e-50, 4790000.3549999995]);
    let inf = format!("solid\n{FACET}{FACET}endsolid\n").replacen("1 0 0", "1 0 inf", 1);
    let (mesh, findings) = survey_bytes(".stl", inf.as_bytes());
    assert_eq!((mesh.faces.len(), findings.left_out(), findings.numbers.of(0)), (1, 1, [1, 0]));
}

/// Megabytes on one line took minutes when each piece of it was looked for from its start.
#[test]
fn long_lines_take_linear_time() {
    let start = std::time::Instant::now();
    let mut text = String::from("solid\n");
    text.push_str(&"n".repeat(20_000_000));
    assert!(message(".stl", text.as_bytes()).starts_with("2: 'nnnn"));
    let solids = format!("solid a {FACET} endsolid a ").replace('\n', " ").repeat(20_000);
    assert_eq!(read_bytes(".stl", solids.as_bytes()).unwrap().faces.len(), 20_000);
    let words = format!("solid {}", "endsolid facet ".repeat(200_000));
    assert!(read_bytes(".stl", words.as_bytes()).is_err());
    assert!(start.elapsed().as_secs() < 30, "{:?}", start.elapsed());
}
