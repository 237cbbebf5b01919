//! Well-known models from outside the project.

use std::time::Instant;

use ombra_formats::{FileInfo, Limits, inspect, read_image, read_model};
use ombra_geometry::Angle;
use ombra_geometry::mesh::smooth_normals;

use super::outside_data;

#[test]
fn well_known_models_have_their_numbers_of_vertices_and_triangles() {
    for (name, vertices, triangles) in [
        ("render/mesh/stanford-bunny.obj", 34_834, 69_451),
        ("render/mesh/teapot.obj", 3_644, 6_320),
        ("render/mesh/dragon_vrip.ply.gz", 437_645, 871_414),
        ("render/pbrt/coffee/models/Mesh013.ply", 0, 0),
    ] {
        let Some(path) = outside_data(name) else {
            continue;
        };
        let start = Instant::now();
        let model = read_model(path, &Limits::default()).unwrap();
        let seconds = start.elapsed().as_secs_f64();
        eprintln!("{name}: {seconds:.2} s, {:?}", model.findings);
        if vertices > 0 {
            let all = model.triangles() as u64 + model.degenerate_triangles;
            let used = model.parts[0].mesh.positions().len();
            assert_eq!((used, all), (vertices, triangles), "{name}");
        }
        assert!(model.bounds().is_finite());
        let mesh = &model.parts[0].mesh;
        let smooth = smooth_normals(mesh, Angle::from_degrees(60.0)).unwrap();
        assert_eq!(smooth.triangles().len(), mesh.triangles().len());
        assert!(
            smooth
                .normals()
                .unwrap()
                .iter()
                .all(|n| (n.length() - 1.0).abs() < 1e-5)
        );
    }
}

#[test]
fn pictures_of_others_are_read() {
    let name = "render/pbrt/cornell-box/TungstenRender";
    if let Some(path) = outside_data(&format!("{name}.exr")) {
        let image = read_image(&path, &Limits::default()).unwrap();
        assert_eq!((image.width(), image.height()), (1024, 1024));
        assert!(matches!(inspect(path), Ok(FileInfo::Image(info)) if info.width == 1024));
    }
    if let Some(path) = outside_data(&format!("{name}.png")) {
        let image = read_image(path, &Limits::default()).unwrap();
        assert_eq!((image.width(), image.height()), (1024, 1024));
    }
    // DWAB, which few programs read.
    if let Some(path) = outside_data("render/env/blender_studio.exr") {
        let image = read_image(path, &Limits::default()).unwrap();
        assert_eq!((image.width(), image.height()), (1024, 512));
        assert_eq!(image.non_finite(), 0);
    }
}
