//! Build once, load in no time.
//!
//! A structure is built from triangles, and that takes longer than anything else before the first
//! ray. What comes of it depends on the triangles alone; so it can be saved and loaded, by another
//! program too. The file holds the triangles as well, as the structure traces them: no mesh is
//! needed to find hits. What a program makes of a hit (normals, colours) it keeps beside it, by the
//! numbers of the triangles.

use std::path::Path;
use std::time::Instant;

use ombra_accel::{Accel, Mesh, StructureKind, Traversable, TriangleTree};
use ombra_geometry::{Hit, MeshError, Point3, Ray, TriangleMesh, Vector3};

/// Hills: two triangles for each of `cells` · `cells` squares.
fn hills(cells: u32) -> Result<TriangleMesh, MeshError> {
    let side = cells + 1;
    let position = |i: u32| {
        let [x, z] = [i % side, i / side].map(|k| k as f32 / cells as f32);
        Point3::new(x, 0.05 * ((20.0 * x).sin() + (23.0 * z).cos()), z)
    };
    let squares = (0..cells * cells).map(|i| i / cells * side + i % cells);
    let halves = |a: u32| [[a, a + side, a + 1], [a + 1, a + side, a + side + 1]];
    let positions = (0..side * side).map(position).collect();
    TriangleMesh::new(positions, squares.flat_map(halves).collect())
}

/// What rays from above hit.
fn hits(world: &impl Traversable) -> Vec<Option<Hit>> {
    let eye = Point3::new(0.5, 1.0, 0.5);
    let toward = |k: u32| Vector3::new((k % 32) as f32 - 15.5, -20.0, (k / 32) as f32 - 15.5);
    let rays: Vec<_> = (0..1024).map(|k| Ray::new(eye, toward(k))).collect();
    let mut hits = vec![None; rays.len()];
    world.intersect_many(&rays, &mut hits);
    hits
}

/// What came of one structure, before and after.
struct RoundTrip {
    built: Vec<Option<Hit>>,
    loaded: Vec<Option<Hit>>,
    /// In milliseconds.
    build: f64,
    load: f64,
}

fn round_trip(cells: u32, path: &Path) -> anyhow::Result<RoundTrip> {
    let milliseconds = |from: Instant| 1e3 * from.elapsed().as_secs_f64();
    let mesh = Mesh::new(hills(cells)?);
    let start = Instant::now();
    let built = Accel::build(mesh, StructureKind::Bvh8);
    let build = milliseconds(start);
    built.save(path)?;

    let start = Instant::now();
    let loaded = TriangleTree::load(path)?;
    let load = milliseconds(start);
    Ok(RoundTrip {
        built: hits(&built),
        loaded: hits(&loaded),
        build,
        load,
    })
}

fn main() -> anyhow::Result<()> {
    let path = Path::new("out/hills.ombra");
    std::fs::create_dir_all("out")?;
    let RoundTrip {
        built,
        loaded,
        build,
        load,
    } = round_trip(700, path)?;
    let bytes = std::fs::metadata(path)?.len();
    println!(
        "built in {build:.0} ms, loaded in {load:.0} ms from {bytes} bytes in {}",
        path.display()
    );
    let same = if built == loaded { "the same" } else { "OTHER" };
    println!("{same} answers to {} rays", built.len());
    Ok(())
}

#[test]
fn what_is_loaded_gives_the_answers_of_what_was_saved() -> anyhow::Result<()> {
    let folder = tempfile::tempdir()?;
    let RoundTrip { built, loaded, .. } = round_trip(40, &folder.path().join("hills.ombra"))?;
    assert!(built.iter().flatten().count() > 300);
    assert_eq!(built, loaded);
    Ok(())
}
