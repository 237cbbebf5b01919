//! What is said of broken files.

use super::{findings, gzip, outside_data, read, try_read};
use ombra_formats::{Limits, read_model, read_texture};

#[test]
fn every_index_beyond_the_vertices_is_named_with_its_line() {
    let text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 2 99\nf 0 1 2\nf -1 -2 -50\n";
    assert_eq!(
        try_read("a.obj", text).unwrap_err(),
        "a.obj:5: face uses vertex 99, but only 3 are defined (1 to 3); \
         line 6: face uses vertex 0, but only 3 are defined (1 to 3); \
         line 7: face uses vertex -50, but only 3 are defined up to here (-3 to -1)"
    );
}

#[test]
fn a_name_without_end_is_told_by_its_beginning() {
    // A control character takes five to spell out.
    let name = "x\u{1}".repeat(4000);
    let text =
        format!("mtllib {name}\n{name} 1\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl {name}\nf 1 2 3\n");
    let findings = findings(&read("a.obj", text));
    assert_eq!(findings.len(), 3, "{findings:?}");
    for finding in findings {
        assert!(finding.contains('x'), "{finding}");
        assert!(finding.len() < 500, "{} bytes", finding.len());
    }
}

#[test]
fn every_coordinate_that_is_no_number_is_named_with_its_line() {
    let text = "v 0 0 0\nv nan 0 0\nv 0 inf 0\nv 1e39 0 0\nv 1 1 0\nf 1 2 3\nf 1 4 5\n";
    let needed = "a finite number is needed (of size up to 3.4e38)";
    assert_eq!(
        try_read("a.obj", text).unwrap_err(),
        format!(
            "a.obj:2: vertex coordinate is \"nan\"; {needed}; line 3: vertex coordinate is \
             \"inf\"; {needed}; line 4: vertex coordinate is \"1e39\"; {needed}"
        )
    );
}

#[test]
fn a_file_of_nothing_but_faults_shows_the_first_few() {
    let error = try_read("a.obj", "v x y z\n".repeat(1000)).unwrap_err();
    assert!(
        error.starts_with("a.obj:1: ") && error.ends_with("; and more"),
        "{error}"
    );
    assert!(error.len() < 400);
}

#[test]
fn triangles_without_area_are_left_out_and_counted() {
    let text = "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 0 1 0\nf 1 1 2\nf 1 2 3\nf 2 2 2\nf 1 2 4\n";
    let model = read("a.obj", text);
    assert_eq!(model.triangles(), 1);
    assert_eq!(
        findings(&model),
        ["3 degenerate triangles (area zero) ignored"]
    );
}

const XYZ: &str = "property float x\nproperty float y\nproperty float z\n";
const FACES: &str = "property list uchar int vertex_indices\nend_header\n";

#[test]
fn rows_that_do_not_fit_the_header_are_named() {
    let header = format!("ply\nformat ascii 1.0\nelement vertex 8\n{XYZ}element face 12\n{FACES}");
    let error = |body: &str| try_read("a.ply", format!("{header}{body}")).unwrap_err();
    assert_eq!(
        error("0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"),
        "a.ply:13: element vertex, row 4 of 8 has 4 numbers, but 3 are expected"
    );
    assert_eq!(
        error("0 0 0\n1 0 0\n0 1\n"),
        "a.ply:12: element vertex, row 3 of 8 has 2 numbers, but 3 are expected"
    );
    assert_eq!(
        error("0 0 0\n1 0 0\n"),
        "a.ply:11: unexpected end of file in element vertex: row 3 of 8 is missing or cut"
    );
    let vertices = "0 0 0\n".repeat(8);
    assert_eq!(
        error(&format!("{vertices}3 0 1 8\n")),
        "a.ply:18: face uses vertex 8, but only 8 are defined (0 to 7)"
    );
    assert_eq!(
        error(&format!("{vertices}4 0 1 2\n")),
        "a.ply:18: element face, row 1 of 12 has 4 numbers, but 5 are expected"
    );
    assert_eq!(
        error(&format!("{vertices}-1\n")),
        "a.ply:18: -1 found where the length of a list, 0 or more, is expected"
    );
}

#[test]
fn counts_that_a_file_cannot_hold_are_refused_before_anything_is_allocated() {
    let header = format!(
        "ply\nformat binary_little_endian 1.0\nelement vertex 4000000000\n{XYZ}\
         element face 4000000000\n{FACES}"
    );
    assert_eq!(
        try_read("a.ply", &header).unwrap_err(),
        "a.ply: file too short: 4000000000 rows of element vertex are declared, which need at \
         least 48000000000 bytes, but only 0 follow"
    );
    let packed = try_read("a.ply.gz", gzip(header.as_bytes())).unwrap_err();
    assert!(packed.contains("at most"), "{packed}");
    let text = format!("ply\nformat ascii 1.0\nelement vertex 100000000\n{XYZ}end_header\n0 0 0\n");
    let packed = try_read("a.ply.gz", gzip(text.as_bytes())).unwrap_err();
    assert!(packed.contains("need at least 600000000 bytes"), "{packed}");
    let plain = try_read("a.ply", text).unwrap_err();
    assert!(plain.contains("row 2 of 100000000 is missing"), "{plain}");
    let overflow = header.replace("4000000000", "999999999999999999");
    assert!(
        try_read("a.ply", overflow)
            .unwrap_err()
            .contains("file too short")
    );
}

#[test]
fn broken_headers_are_named() {
    for (text, expected) in [
        (
            "plyx\n",
            "a.ply:1: \"plyx\" found where \"ply\" in the first line of a PLY file is expected",
        ),
        (
            "ply\n",
            "a.ply:1: the end of the file found where end_header is expected",
        ),
        (
            "ply\nend_header\n",
            "a.ply:2: \"end_header\" found where a format line before it is expected",
        ),
        (
            "ply\nformat binary 1.0\n",
            "a.ply:2: \"binary\" found where ascii, binary_little_endian",
        ),
        (
            "ply\nproperty float x\n",
            "a.ply:2: \"property\" found where an element before",
        ),
        (
            "ply\nelement vertex\n",
            "a.ply:2: the end of the line found where the number of rows",
        ),
        (
            "ply\nelement vertex -1\n",
            "a.ply:2: \"-1\" found where a number of rows of 0 or more",
        ),
        (
            "ply\nelement v 1\nproperty real x\n",
            "a.ply:3: \"real\" found where a type:",
        ),
        (
            "ply\nelement v 1\nproperty list float int x\n",
            "a.ply:3: \"float\" found where a whole",
        ),
        (
            "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nend_header\n0\n",
            "a.ply: an element vertex without x, y and z found where one with them is expected",
        ),
    ] {
        let error = try_read("a.ply", text).unwrap_err();
        assert!(error.starts_with(expected), "{error}");
    }
}

#[test]
fn binary_faults_are_named_with_their_byte_and_row() {
    let header =
        format!("ply\nformat binary_little_endian 1.0\nelement vertex 2\n{XYZ}end_header\n");
    let mut bytes = header.clone().into_bytes();
    for x in [0.0, 0.0, 0.0, 1.0, f32::INFINITY, 0.0] {
        bytes.extend(f32::to_le_bytes(x));
    }
    let place = header.len() + 12;
    assert_eq!(
        try_read("a.ply", bytes).unwrap_err(),
        format!(
            "a.ply: byte {place}: element vertex, row 2: vertex coordinate is inf; a finite \
             number is needed (of size up to 3.4e38)"
        )
    );
}

#[test]
fn a_gzip_file_that_is_cut_or_corrupt_is_an_error() {
    let text = format!("ply\nformat ascii 1.0\nelement vertex 50\n{XYZ}end_header\n");
    let body: String = (0..50)
        .map(|i| format!("{i} {} {}\n", i * 7, i * 13))
        .collect();
    let whole = gzip(format!("{text}{body}").as_bytes());
    assert!(try_read("a.ply.gz", &whole).is_ok());
    assert!(try_read("a.ply.gz", &whole[..whole.len() - 20]).is_err());
    let mut corrupt = whole.clone();
    corrupt[whole.len() / 2] ^= 0xff;
    assert!(try_read("a.ply.gz", corrupt).is_err());
}

#[test]
fn missing_files_and_folders_are_named() {
    let folder = tempfile::tempdir().unwrap();
    let missing = folder.path().join("not there.obj");
    let error = read_model(&missing, &Limits::default())
        .unwrap_err()
        .to_string();
    assert!(
        error.contains("not there.obj: cannot be opened: No such file"),
        "{error}"
    );
    let error = read_model(folder.path(), &Limits::default())
        .unwrap_err()
        .to_string();
    assert!(error.contains("cannot be read: "), "{error}");
}

#[test]
fn the_broken_files_from_outside_are_refused_or_reported() {
    for (name, expected) in [
        ("index_beyond.obj", "; line 7: face uses vertex -50"),
        (
            "nan_vertices.obj",
            "; line 4: vertex coordinate is \"1e39\"",
        ),
        (
            "wrong_counts.ply",
            "row 4 of 8 has 4 numbers, but 3 are expected",
        ),
        (
            "huge_counts.ply",
            "file too short: 4000000000 rows of element vertex",
        ),
        (
            "bomb.ply.gz",
            "file too short: 100000000 rows of element vertex",
        ),
    ] {
        let Some(path) = outside_data(&format!("bad/{name}")) else {
            continue;
        };
        let error = read_model(path, &Limits::default())
            .unwrap_err()
            .to_string();
        assert!(error.contains(expected) && error.contains(name), "{error}");
    }
    if let Some(path) = outside_data("bad/zero_area.obj") {
        let model = read_model(path, &Limits::default()).unwrap();
        assert_eq!(
            findings(&model),
            ["3 degenerate triangles (area zero) ignored"]
        );
    }
    if let Some(path) = outside_data("bad/texture_bomb.png") {
        let error = read_texture(path, &Limits::default())
            .unwrap_err()
            .to_string();
        assert!(
            error.contains("image is 40000x40000 pixels, over the limit"),
            "{error}"
        );
    }
}
