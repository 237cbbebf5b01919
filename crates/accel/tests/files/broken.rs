//! Files that are wrong: each is refused with its place and reason, or does no harm.

use ombra_accel::{
    Accel, Level, Mesh, StructureFault as Fault, StructureFileError, StructurePart as Part,
    Traversable as _, TriangleTree,
};
use ombra_geometry::{Point3, Ray, Vector3};

use crate::{KINDS, answers, built, bytes, dish, rays, read, straw};

const HEADER: usize = 128;
const NODE: usize = 256;
const QUAD: usize = 160;

fn file() -> Vec<u8> {
    bytes(|path| built(dish(8)).save(path))
}

fn word(file: &[u8], at: usize) -> u32 {
    u32::from_le_bytes(file[at..at + 4].try_into().unwrap())
}

fn put(file: &mut [u8], at: usize, word: u32) {
    file[at..at + 4].copy_from_slice(&word.to_le_bytes());
}

/// Makes all checksums those of what is there, as one who means harm would.
fn summed(mut file: Vec<u8>) -> Vec<u8> {
    let quads = HEADER + NODE * word(&file, 16) as usize;
    if let (Some(nodes), Some(rest)) = (file.get(HEADER..quads), file.get(quads..)) {
        let (nodes, quads) = (crc32fast::hash(nodes), crc32fast::hash(rest));
        put(&mut file, 36, nodes);
        put(&mut file, 40, quads);
    }
    let header = crc32fast::hash(&file[..124]);
    put(&mut file, 124, header);
    file
}

/// Changes the file, makes the checksums right, and tells what is found.
fn fault(change: impl FnOnce(&mut Vec<u8>)) -> (u64, Fault) {
    let mut file = file();
    change(&mut file);
    found(&summed(file))
}

fn found(file: &[u8]) -> (u64, Fault) {
    match read(file).unwrap_err() {
        error @ StructureFileError::Content { at, fault, .. } => {
            let text = error.to_string();
            assert!(text.starts_with(&format!("a.ombra: byte {at}: ")), "{text}");
            assert!(!text.contains('\n') && text.len() < 300, "{text}");
            (at, fault)
        }
        other => panic!("{other}"),
    }
}

#[test]
fn a_file_that_is_cut_anywhere_or_goes_on_is_refused() {
    let file = file();
    for length in 0..file.len() {
        if length < 600 || length % 7 == 0 {
            found(&file[..length]);
            if length >= HEADER {
                let (at, fault) = found(&summed(file[..length].to_vec()));
                assert_eq!(at, 16);
                assert!(matches!(fault, Fault::Length { .. }), "{fault}");
            }
        }
    }
    assert_eq!(found(b""), (0, Fault::Magic));
    assert_eq!(found(&file[..60]), (60, Fault::Short));
    let mut longer = file;
    longer.push(0);
    assert!(matches!(found(&longer), (16, Fault::Length { .. })));
}

#[test]
fn a_byte_that_is_changed_is_found_by_its_checksum() {
    let file = file();
    for at in 0..file.len() {
        for bits in [1, 0x80, 0xff] {
            let mut file = file.clone();
            file[at] ^= bits;
            let (place, fault) = found(&file);
            match at {
                0..8 => assert_eq!((place, fault), (0, Fault::Magic)),
                8..12 => assert!(matches!(fault, Fault::Version(_))),
                12..16 => assert!(matches!(fault, Fault::Structure(_))),
                _ => assert!(matches!(fault, Fault::Checksum { .. }), "{at}: {fault}"),
            }
        }
    }
}

#[test]
fn a_byte_that_is_changed_with_its_checksums_is_refused_or_does_no_harm() {
    for kind in KINDS {
        let accel = Accel::build(Mesh::new(straw(30)), kind);
        changed_bytes_do_no_harm(&bytes(|path| accel.save(path)));
    }
    changed_bytes_do_no_harm(&file());
}

/// Sends rays through a tree, near and far, together and alone, at every level.
fn traced(tree: &TriangleTree) {
    let mut rays: Vec<_> = rays().into_iter().step_by(8).collect();
    // Enough that go together for a packet.
    let from = Point3::new(0.2, 2.0, 0.1);
    rays.extend((0..32).map(|k| Ray::new(from, Vector3::new(0.02 * k as f32 - 0.3, -2.0, 0.1))));
    let triangles = tree.triangles() as u32;
    let mut hits = vec![None; rays.len()];
    for level in Level::available() {
        let tree = tree.clone().at_level(level);
        tree.intersect_many(&rays, &mut hits);
        assert!(hits.iter().flatten().all(|hit| hit.primitive.0 < triangles));
        for (ray, hit) in rays.iter().zip(&hits) {
            assert_eq!(tree.intersect(ray), *hit);
        }
    }
}

fn changed_bytes_do_no_harm(file: &[u8]) {
    let (mut loaded, mut refused) = (0, 0);
    for at in 0..file.len() {
        // All of the header and the first nodes; of the rest each byte once.
        let all: &[u8] = &[1, 2, 4, 8, 16, 32, 64, 128, 255];
        let one = [1 << (at % 8)];
        for &bits in if at < HEADER + 2 * NODE { all } else { &one } {
            let mut file = file.to_vec();
            file[at] ^= bits;
            match read(&summed(file)) {
                Ok(tree) => {
                    traced(&tree);
                    loaded += 1;
                }
                Err(_) => refused += 1,
            }
        }
    }
    assert!(loaded > 100 && refused > 1000, "{loaded} {refused}");
}

#[test]
fn other_files_are_told_from_structures() {
    assert_eq!(found(b"solid a\nendsolid a\n"), (0, Fault::Magic));
    assert_eq!(found(&[0; 4096]), (0, Fault::Magic));
    let version = fault(|file| put(file, 8, 2));
    assert_eq!(version, (8, Fault::Version(2)));
    let other = fault(|file| file[12..16].copy_from_slice(b"kd\n\xff"));
    assert_eq!(other, (12, Fault::Structure(*b"kd\n\xff")));
    let repeats = fault(|file| file[68] = 2);
    assert_eq!(repeats, (68, Fault::Repeats(2)));
    let reserved = fault(|file| file[100] = 3);
    assert_eq!(reserved, (100, Fault::Reserved(3)));
}

#[test]
fn counts_that_the_file_does_not_have_ask_for_no_memory() {
    let (part, found, most) = (Part::Nodes, u32::MAX, 1 << 27);
    let nodes = fault(|file| put(file, 16, u32::MAX));
    assert_eq!(nodes, (16, Fault::TooMany { part, found, most }));
    let quads = fault(|file| put(file, 20, u32::MAX));
    assert!(matches!(quads, (20, Fault::TooMany { .. })));
    let nodes = fault(|file| put(file, 16, 1 << 27));
    assert!(matches!(nodes, (16, Fault::Length { .. })));
    let none = fault(|file| {
        put(file, 16, 0);
        put(file, 20, 0);
        file.truncate(HEADER);
    });
    assert!(matches!(
        none,
        (
            32,
            Fault::Missing {
                part: Part::Nodes,
                ..
            }
        )
    ));
}

/// Where child k of a node is.
fn child(node: usize, k: usize) -> usize {
    HEADER + NODE * node + 192 + 4 * k
}

/// A child of the root that is a node, and one that is a leaf, or that of another node.
fn children(file: &[u8]) -> (usize, usize) {
    let nodes = word(file, 16) as usize;
    let all = (0..nodes).flat_map(|node| (0..8).map(move |k| child(node, k)));
    let is = |at: &usize, leaf: bool| word(file, *at) >> 31 == u32::from(leaf);
    let node = (0..8)
        .map(|k| child(0, k))
        .find(|at| is(at, false))
        .unwrap();
    (node, all.into_iter().find(|at| is(at, true)).unwrap())
}

#[test]
fn a_cycle_a_second_parent_and_a_lost_part_are_refused() {
    let (node, leaf) = children(&file());
    let cycle = fault(|file| put(file, node, 0));
    assert_eq!(cycle, (128, Fault::Before(0)));
    let far = fault(|file| put(file, node, 8 * 100_000));
    assert!(matches!(
        far,
        (
            128,
            Fault::Missing {
                part: Part::Nodes,
                ..
            }
        )
    ));
    let was = word(&file(), node);
    let odd = fault(|file| put(file, node, was | 1));
    assert!(matches!(odd, (128, Fault::Child(_))));
    let was = word(&file(), leaf);
    let odd = fault(|file| put(file, leaf, was + 1));
    assert!(matches!(odd.1, Fault::Child(_)));
    let far = fault(|file| put(file, leaf, (1 << 31) | (5 * 100_000)));
    assert!(matches!(
        far.1,
        Fault::Missing {
            part: Part::Quads,
            ..
        }
    ));
    // The first child that is a node comes again in a larger box: the last one is lost by it.
    let twice = fault(|file| {
        let (first, second) = (child(0, 0), child(0, 1));
        for row in 0..6 {
            let bound = if row < 3 { f32::MIN } else { f32::MAX };
            put(file, 44 + 4 * row, bound.to_bits());
            put(file, HEADER + 32 * row + 4, bound.to_bits());
        }
        let twin = word(file, first);
        put(file, second, twin);
    });
    assert!(matches!(twice, (128, Fault::Twice { .. })), "{twice:?}");
    let lost = fault(|file| {
        for row in 0..6 {
            let bound = if row < 3 {
                f32::INFINITY
            } else {
                f32::NEG_INFINITY
            };
            put(file, HEADER + 32 * row + 4, bound.to_bits());
        }
        put(file, child(0, 1), 0);
    });
    assert!(matches!(lost.1, Fault::Unnamed { .. }), "{lost:?}");
}

#[test]
fn a_depth_that_is_not_the_tree_s_is_refused() {
    let stated = word(&file(), 28) + 1;
    let deeper = fault(|file| put(file, 28, stated));
    assert!(matches!(deeper, (28, Fault::Depth { .. })));
    let shallow = fault(|file| put(file, 28, 0));
    assert!(matches!(shallow, (28, Fault::Depth { stated: 0, .. })));
    assert_eq!(fault(|file| put(file, 28, 65)), (28, Fault::Deep(65)));
}

/// A chain of nodes, each the only child of the one before it, and a leaf at the end.
fn chain(nodes: usize) -> Vec<u8> {
    let mut file = bytes(|path| built(dish(1)).save(path));
    let quads = file.split_off(HEADER);
    let mut node = vec![0; NODE];
    for row in 0..6 {
        for k in 0..8 {
            let side = if row < 3 { 1.0 } else { -1.0 };
            let bound = if k == 0 { -side } else { side * f32::INFINITY };
            put(&mut node, 32 * row + 4 * k, bound.to_bits());
            put(&mut node, 224 + 4 * k, 0o7654_3210);
        }
        let bound = if row < 3 { -1.0_f32 } else { 1.0 };
        put(&mut file, 44 + 4 * row, bound.to_bits());
    }
    for k in 1..=nodes {
        let leaf = if k == nodes {
            word(&file, 32)
        } else {
            8 * k as u32
        };
        put(&mut node, 192, leaf);
        file.extend(&node);
    }
    assert_eq!(quads.len(), QUAD);
    file.extend(quads);
    put(&mut file, 16, nodes as u32);
    put(&mut file, 28, nodes as u32);
    put(&mut file, 32, 0);
    summed(file)
}

#[test]
fn as_many_levels_as_a_walk_has_room_for_are_read_and_no_more() {
    let expected = answers(&built(dish(1)));
    let tree = read(&chain(64)).unwrap();
    assert_eq!(answers(&tree).1, expected.1);
    let mut deep = chain(65);
    put(&mut deep, 28, 64);
    let last = (HEADER + 63 * NODE) as u64;
    assert_eq!(found(&summed(deep)), (last, Fault::Deep(65)));
}

#[test]
fn boxes_orders_and_triangles_are_looked_at() {
    let at = HEADER;
    for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
        let bounds = fault(|file| put(file, 44, bad.to_bits()));
        assert!(matches!(bounds, (44, Fault::Box | Fault::Outside(_))));
        let (at, fault) = fault(|file| put(file, at, bad.to_bits()));
        assert!(
            matches!(fault, Fault::Box | Fault::Outside(_)),
            "{at} {fault}"
        );
    }
    let swapped = fault(|file| put(file, at, 1e9_f32.to_bits()));
    assert!(matches!(swapped, (128, Fault::Box)), "{swapped:?}");
    let order = fault(|file| put(file, at + 224 + 8, 0));
    assert_eq!(order, (128, Fault::Order(2)));
    let was = word(&file(), at + 224);
    let order = fault(|file| put(file, at + 224, was | 1 << 30));
    assert_eq!(order, (128, Fault::Order(0)));
    let quads = HEADER + NODE * word(&file(), 16) as usize;
    let corner = fault(|file| put(file, quads, f32::NAN.to_bits()));
    assert!(matches!(corner.1, Fault::Triangle(0)), "{corner:?}");
    let fewer = fault(|file| put(file, 24, 5));
    assert!(matches!(fewer.1, Fault::Triangle(_)), "{fewer:?}");
}

#[test]
fn a_place_without_a_triangle_before_one_with_is_refused() {
    let quads = HEADER + NODE * word(&file(), 16) as usize;
    let places = if word(&file(), children(&file()).1) >> 30 & 1 == 1 {
        8
    } else {
        4
    };
    let gap = fault(|file| {
        for component in 0..9 {
            put(file, quads + 4 * places * component, f32::NAN.to_bits());
        }
        put(file, quads + 36 * places, u32::MAX);
    });
    assert_eq!(gap.1, Fault::Triangle(1));
}
