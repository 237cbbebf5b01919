//! What well-formed models come out as.

use ombra_formats::{ModelFormat, inspect};
use ombra_geometry::{Normal3, Point3};

use super::{Folder, findings, gzip, read, try_read};

const SQUARE: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

fn obj(rest: &str) -> ombra_formats::Model {
    read("model.obj", format!("{SQUARE}{rest}"))
}

#[test]
fn obj_indices_count_from_either_end_and_ahead() {
    let forward = obj("f 1 2 3 4\n");
    let backward = obj("f -4 -3 -2 -1\n");
    let ahead = read("model.obj", format!("f 1 2 3 4\n{SQUARE}"));
    assert_eq!(forward.parts[0].mesh.triangles(), [[0, 1, 2], [0, 2, 3]]);
    assert_eq!(forward.parts[0].mesh, backward.parts[0].mesh);
    assert_eq!(forward.parts[0].mesh, ahead.parts[0].mesh);
}

#[test]
fn obj_corners_are_split_only_where_their_attributes_differ() {
    let model =
        obj("vt 0 0\nvt 1 1\nvn 0 0 2\nf 1/1/1 2/1/1 3/1/1\nf 1/1/1 3/1/1 4/2/1\nf 1/2 2/2 3/2\n");
    let mesh = &model.parts[0].mesh;
    assert_eq!(mesh.triangles().len(), 3);
    assert_eq!(mesh.positions().len(), 7);
    assert_eq!(mesh.normals().unwrap()[0], Normal3::new(0.0, 0.0, 1.0));
    assert_eq!(mesh.uvs().unwrap()[3], [1.0, 1.0]);
    assert_eq!(
        findings(&model),
        ["1 triangle without normals among others that have them: shown flat"]
    );
}

#[test]
fn obj_reads_colours_continuations_comments_and_counts_the_rest() {
    let text = "# made by hand \\\nmtllib\no thing\ng a b\nv 0 0 0 1 0 0\r\nv 1 0 0 0 1 0\n\
        v 0 1 \\\n0 1 1 1\nf 1 2 3 # a comment\nl 1 2\nl 2 3\nvp 0.5\n";
    let model = read("model.obj", text);
    assert_eq!(model.triangles(), 1);
    let found = findings(&model);
    assert!(
        found.contains(&"line 10: keyword \"l\" not used (2 times)".to_owned()),
        "{found:?}"
    );
    assert!(
        found.contains(&"line 12: keyword \"vp\" not used".to_owned()),
        "{found:?}"
    );
}

#[test]
fn obj_smoothing_groups_share_normals_within_and_split_between() {
    // Two triangles that meet at a right angle.
    let corner = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 1 1 1\n";
    let normals = |smoothing: [&str; 2]| {
        let [a, b] = smoothing;
        let text = format!("{corner}s {a}\nf 1 2 3\ns {b}\nf 2 3 4\n");
        let model = read("model.obj", text);
        let mesh = model.parts[0].mesh.clone();
        assert!(model.findings.is_empty());
        (mesh.positions().len(), mesh.normals().unwrap().to_vec())
    };
    let (count, smooth) = normals(["1", "1"]);
    assert_eq!(count, 4);
    let half = f32::sqrt(0.5);
    assert!((smooth[1].x - half).abs() < 1e-6 && (smooth[1].z - half).abs() < 1e-6);
    for apart in [["1", "2"], ["off", "off"], ["0", "1"]] {
        let (count, flat) = normals(apart);
        assert_eq!(count, 6);
        assert_eq!(flat[0], Normal3::new(0.0, 0.0, 1.0));
    }
    // A file that says nothing leaves the choice to its reader.
    let silent = read("model.obj", format!("{corner}f 1 2 3\nf 2 3 4\n"));
    assert_eq!(silent.parts[0].mesh.normals(), None);
}

#[test]
fn obj_concave_polygons_are_cut_inside() {
    let model = read(
        "model.obj",
        "v 0 0 0\nv 2 1 0\nv 4 0 0\nv 2 4 0\nf 1 2 3 4\nf 1 2\n",
    );
    let mesh = &model.parts[0].mesh;
    let area: f32 = (0..mesh.triangles().len())
        .map(|i| {
            let [a, b, c] = mesh.corners(i);
            (b - a).cross(c - a).z / 2.0
        })
        .sum();
    assert_eq!(area, 6.0);
    assert_eq!(
        findings(&model),
        ["1 face with fewer than 3 corners ignored"]
    );
}

const PLY_HEADER: &str = "element vertex 4\nproperty double y\nproperty uchar red\nproperty float x\n\
    property short z\nproperty float s\nproperty float t\nelement camera 1\nproperty float k\n\
    property list uchar float p\nelement face 2\nproperty uchar flags\n\
    property list uint8 int32 vertex_index\nend_header\n";

fn ply_text() -> String {
    format!(
        "ply\nformat ascii 1.0\ncomment all sorts\n{PLY_HEADER}\
         0 9 0 0 0 0\n0 9 1 0 1 0\n\n1 9 1 0 1 1\n1 9 0 0 0 1\n2 3 1 2 3\n7 3 0 1 2\n7 4 0 2 3 1\n"
    )
}

fn ply_binary(big: bool) -> Vec<u8> {
    let order = if big { "big" } else { "little" };
    let mut bytes = format!("ply\nformat binary_{order}_endian 1.0\n{PLY_HEADER}").into_bytes();
    let mut push = |native: &[u8]| {
        let mut native = native.to_vec();
        if big {
            native.reverse();
        }
        bytes.extend(native);
    };
    for [x, y] in [[0.0_f32, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]] {
        push(&f64::from(y).to_le_bytes());
        push(&[9]);
        push(&x.to_le_bytes());
        push(&0_i16.to_le_bytes());
        push(&x.to_le_bytes());
        push(&y.to_le_bytes());
    }
    push(&2_f32.to_le_bytes());
    push(&[3]);
    (0..3).for_each(|_| push(&1_f32.to_le_bytes()));
    for face in [&[0_i32, 1, 2][..], &[0, 2, 3, 1]] {
        push(&[7]);
        push(&[face.len() as u8]);
        face.iter().for_each(|i| push(&i.to_le_bytes()));
    }
    bytes
}

#[test]
fn ply_is_the_same_in_all_encodings_packed_or_not() {
    let text = read("model.ply", ply_text());
    assert_eq!(text.format, ModelFormat::PlyAscii);
    let mesh = &text.parts[0].mesh;
    assert_eq!(mesh.positions()[2], Point3::new(1.0, 1.0, 0.0));
    assert_eq!(mesh.uvs().unwrap()[3], [0.0, 1.0]);
    assert_eq!(mesh.triangles().len(), 3);
    for (bytes, format) in [
        (ply_binary(false), ModelFormat::PlyLittleEndian),
        (ply_binary(true), ModelFormat::PlyBigEndian),
    ] {
        // The ending does not matter where the content says what it is.
        for (name, bytes) in [("model.ply.gz", gzip(&bytes)), ("model", bytes)] {
            let model = read(name, bytes);
            assert_eq!(model.format, format);
            assert_eq!(&model.parts[0].mesh, mesh);
            assert_eq!(findings(&model), findings(&text));
        }
    }
    assert_eq!(
        findings(&text),
        [
            "property \"red\" not used",
            "element \"camera\" not used",
            "property \"flags\" not used"
        ]
    );
}

#[test]
fn ply_strips_turn_every_other_triangle() {
    let text = "ply\nformat ascii 1.0\nelement tristrips 1\nproperty list int int vertex_indices\n\
        element vertex 4\nproperty float x\nproperty float y\nproperty float z\nproperty float nx\n\
        property float ny\nproperty float nz\nend_header\n8 0 1 2 3 -1 1 2 3\n\
        0 0 0 0 0 2\n1 0 0 0 0 2\n0 1 0 0 0 0\n1 1 0 0 0 1\n";
    let model = read("model.ply", text);
    let mesh = &model.parts[0].mesh;
    assert_eq!(mesh.triangles(), [[0, 1, 2], [2, 1, 3], [1, 2, 3]]);
    assert!(
        mesh.normals()
            .unwrap()
            .iter()
            .all(|n| *n == Normal3::new(0.0, 0.0, 1.0))
    );
    assert_eq!(
        findings(&model),
        ["1 normal of length zero replaced by that of a face"]
    );
}

#[test]
fn points_without_triangles_are_a_model_that_says_so() {
    let obj = read("points.obj", SQUARE);
    assert_eq!((obj.vertices, obj.triangles()), (4, 0));
    assert_eq!(findings(&obj), ["no triangle; nothing of it can be seen"]);
    let ply = "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\n\
        property float z\nend_header\n1 2 3\nmore\n";
    let ply = read("points.ply", ply);
    assert_eq!(ply.vertices, 1);
    assert_eq!(
        findings(&ply),
        [
            "data after the end of the declared content ignored",
            "no triangle; nothing of it can be seen"
        ]
    );
}

#[test]
fn a_file_of_unknown_kind_is_refused_with_what_is_known() {
    assert_eq!(
        try_read("model.xyz", "1 2 3").unwrap_err(),
        "model.xyz: unknown kind of file; models with the ending obj, ply, stl, gltf or glb (each also with \
         .gz) can be read"
    );
    assert_eq!(
        try_read("model.obj", "hello\nworld\n").unwrap_err(),
        "model.obj: no vertex (v x y z) found where a model in OBJ is expected"
    );
    assert_eq!(
        try_read("model.stl", "").unwrap_err(),
        "model.stl: file is empty (0 bytes)"
    );
}

#[test]
fn inspecting_a_model_tells_what_is_in_it() {
    let folder = Folder::with(&[(
        "two.obj",
        format!("{SQUARE}f 1 2 3 4\nf 1 1 2\n").as_bytes(),
    )]);
    let info = inspect(folder.path("two.obj")).unwrap();
    assert_eq!(
        serde_json::to_value(&info).unwrap(),
        serde_json::json!({
            "kind": "model", "format": "obj", "vertices": 4, "triangles": 2,
            "degenerate_triangles": 1, "normals": false, "uvs": false,
            "bounds": [[0.0, 0.0, 0.0], [1.0, 1.0, 0.0]],
            "materials": [{ "name": "default", "kind": "diffuse", "triangles": 2 }],
            "findings": [{ "finding": "degenerate-triangles", "count": 1 }],
        })
    );
}
