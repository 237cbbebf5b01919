//! How much memory the wide trees take, and how much their building does.
#![expect(unsafe_code, reason = "an allocator that counts")]

use std::alloc::{GlobalAlloc, Layout, System};
use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};

use ombra_accel::{Accel, Mesh, StructureKind};
use ombra_geometry::{Point3, TriangleMesh};

/// The system's allocator, counting.
struct Counting;

static HELD: AtomicUsize = AtomicUsize::new(0);
static MOST: AtomicUsize = AtomicUsize::new(0);

fn more(bytes: usize) {
    let held = HELD.fetch_add(bytes, Relaxed) + bytes;
    MOST.fetch_max(held, Relaxed);
}

// SAFETY: all is left to the system's allocator.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        more(layout.size());
        // SAFETY: the caller's promise; so below.
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, memory: *mut u8, layout: Layout) {
        HELD.fetch_sub(layout.size(), Relaxed);
        // SAFETY: as above.
        unsafe { System.dealloc(memory, layout) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

/// A hilly ground of so many cells a side, two triangles each.
fn hills(side: u32) -> TriangleMesh {
    let row = side + 1;
    let position = |i: u32| {
        let (x, y) = ((i % row) as f32, (i / row) as f32);
        Point3::new(x, y, 5.0 * (0.1 * x).sin() * (0.13 * y).cos())
    };
    let triangles = (0..side * side).flat_map(|i| {
        let a = i / side * row + i % side;
        [[a, a + 1, a + row], [a + 1, a + row + 1, a + row]]
    });
    let positions = (0..row * row).map(position).collect();
    TriangleMesh::new(positions, triangles.collect()).unwrap()
}

/// Houses in rows and columns, so many a side, every third one at an angle: twelve triangles each.
fn city(side: u32) -> TriangleMesh {
    let (mut positions, mut triangles) = (Vec::new(), Vec::new());
    for house in 0..side * side {
        let (x, y) = ((house % side) as f32 * 10.0, (house / side) as f32 * 10.0);
        let mixed = (house.wrapping_mul(0x9e37_79b9) >> 16) as f32 / 65536.0;
        let angle = if house % 3 == 0 { 1.5 * mixed } else { 0.0 };
        let (sin, cos) = angle.sin_cos();
        let first = positions.len() as u32;
        for corner in 0..8_u32 {
            let half = |bit: u32| {
                if corner >> bit & 1 == 1 {
                    2.0 + 2.0 * mixed
                } else {
                    -3.0
                }
            };
            let (a, b) = (half(0), half(1));
            let up = if corner >> 2 == 1 {
                3.0 + 30.0 * mixed
            } else {
                0.0
            };
            positions.push(Point3::new(
                x + a * cos - b * sin,
                y + a * sin + b * cos,
                up,
            ));
        }
        let faces = [
            [0, 2, 3, 1],
            [4, 5, 7, 6],
            [0, 1, 5, 4],
            [1, 3, 7, 5],
            [3, 2, 6, 7],
            [2, 0, 4, 6],
        ];
        for [a, b, c, d] in faces.map(|face| face.map(|corner| first + corner)) {
            triangles.extend([[a, b, c], [a, c, d]]);
        }
    }
    TriangleMesh::new(positions, triangles).unwrap()
}

/// One test, since two at once would be counted together.
#[test]
fn trees_and_their_building_take_as_much_memory_as_they_say() {
    for (name, mesh) in [("hills", hills(400)), ("city", city(160))] {
        let triangles = mesh.triangles().len() as f64;
        let mesh = Mesh::new(mesh);
        // How many bytes a triangle, and how many times as much while it is built.
        let normal = (if name == "city" { 66.0 } else { 60.0 }, 2.0);
        for (kind, (limit, times)) in [
            (StructureKind::Bvh8, normal),
            (StructureKind::Bvh8Fast, normal),
            (StructureKind::Bvh8High, normal),
            (StructureKind::Bvh8Compact, (32.0, 3.5)),
        ] {
            let before = HELD.load(Relaxed);
            MOST.store(before, Relaxed);
            let accel = Accel::build(mesh.clone(), kind);
            let most = (MOST.load(Relaxed) - before) as f64;
            let held = (HELD.load(Relaxed) - before) as f64;
            let bytes = accel.structure_bytes() as f64;
            assert!(held <= 1.01 * bytes, "{name}, {kind}: {held} of {bytes}");
            assert!(most <= times * bytes, "{name}, {kind}: {most} of {bytes}");
            let each = bytes / triangles;
            assert!(each <= limit, "{name}, {kind}: {each} bytes a triangle");
        }
    }
}
