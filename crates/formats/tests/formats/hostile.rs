//! Readers never panic, whatever the bytes.

use ombra_formats::{ImageBuffer, Limits, Metadata, inspect, read_image, read_model, write_image};
use ombra_scene::Rgb;
use proptest::prelude::*;

use super::Folder;

const OBJ: &[u8] =
    b"mtllib m.mtl\nv 0 0 0\nv 1 0 0 0.5 0.5 0.5\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 1\n\
    vn 0 0 1\ns 1\nusemtl a\nf 1/1/1 2//1 3/2 -1\ns off\nf 1 \\\n2 4\n";
const MTL: &[u8] = b"newmtl a\nKd 0.5 0.5 0.5\nKs 1\nNs 10\nd 0.5\nillum 4\nmap_Kd -o 1 2 x.png\n";
const PLY: &[u8] = b"ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n\
    property float z\nproperty list uchar int w\nelement face 1\nproperty list uchar int vertex_index\n\
    end_header\n0 0 0 0\n1 0 0 1 5\n0 1 0 0\n3 0 1 2\n";
const BINARY_PLY: &[u8] =
    b"ply\nformat binary_big_endian 1.0\nelement vertex 3\nproperty uchar x\n\
    property uchar y\nproperty uchar z\nelement face 1\nproperty list uchar char vertex_index\n\
    element tristrips 1\nproperty list int short vertex_indices\nend_header\n\
    \x00\x00\x00\x01\x00\x00\x00\x01\x00\x03\x00\x01\x02\x00\x00\x00\x03\x00\x00\x00\x01\x00\x02";

/// The bytes with some of them changed, and cut.
fn mangled(bytes: &[u8], changes: &[(usize, u8)], cut: usize) -> Vec<u8> {
    let mut bytes = bytes.to_vec();
    for (at, byte) in changes {
        let at = at % bytes.len();
        bytes[at] = *byte;
    }
    if cut < 2 * bytes.len() {
        bytes.truncate(cut);
    }
    bytes
}

/// Half of the changes are to bytes that mean something in these formats.
fn change() -> impl Strategy<Value = (usize, u8)> {
    let telling = prop::sample::select(&b"0123456789-+.eEnv/ \\\n\rf#\x00\xff"[..]);
    (any::<usize>(), prop_oneof![telling, any::<u8>()])
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 400, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn models_that_are_changed_and_cut(
        changes in prop::collection::vec(change(), 0..6),
        cut in 0..1000_usize,
    ) {
        let folder = Folder::with(&[
            ("a.obj", &mangled(OBJ, &changes, cut)),
            ("b.obj", OBJ),
            ("m.mtl", &mangled(MTL, &changes, cut)),
            ("a.ply", &mangled(PLY, &changes, cut)),
            ("b.ply", &mangled(BINARY_PLY, &changes, cut)),
            ("c.ply.gz", &mangled(&super::gzip(PLY), &changes, cut)),
        ]);
        for name in ["a.obj", "b.obj", "a.ply", "b.ply", "c.ply.gz"] {
            match read_model(folder.path(name), &Limits::default()) {
                Ok(model) => {
                    let bounds = model.bounds();
                    prop_assert!(bounds.is_empty() || bounds.is_finite());
                }
                Err(error) => prop_assert!(!error.to_string().contains('\n')),
            }
        }
    }

    #[test]
    fn bytes_without_meaning(bytes in prop::collection::vec(any::<u8>(), 0..200)) {
        let mut ply = b"ply\n".to_vec();
        ply.extend(&bytes);
        let folder = Folder::with(&[("a.obj", &bytes), ("a.ply", &ply), ("a.png", &bytes)]);
        for name in ["a.obj", "a.ply", "a.png"] {
            if let Err(error) = inspect(folder.path(name)) {
                prop_assert!(!error.to_string().contains('\n'));
            }
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 100, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn pictures_that_are_changed_and_cut(
        changes in prop::collection::vec(change(), 0..4),
        cut in 0..4000_usize,
    ) {
        let folder = Folder::with(&[]);
        let image = ImageBuffer::new(4, 3, vec![Rgb::grey(0.5); 12]).unwrap();
        let limits = Limits { image_pixels: 10_000, ..Limits::default() };
        for name in ["a.png", "a.exr", "a.pfm", "a.ppm"] {
            let path = folder.path(name);
            write_image(&path, &image, &Metadata::default()).unwrap();
            let bytes = mangled(&std::fs::read(&path).unwrap(), &changes, cut);
            std::fs::write(&path, bytes).unwrap();
            let read = read_image(&path, &limits);
            prop_assert!(read.is_err() || read.is_ok_and(|i| i.pixels().len() <= 10_000));
            let _ = inspect(&path);
        }
    }
}
