//! What each fuzz target does with its bytes: reads them as one format, and holds what comes of it
//! against what its reader promises.
//!
//! `fuzz_targets` has a program for each, and `crates/formats/tests` calls the same functions with the
//! committed corpora.

use std::fmt::Display;

use ombra_accel::{Geometry, Level, Primitives as _, Traversable as _, TriangleTree};
use ombra_formats::city::{CityOptions, read_area_bytes, read_city_bytes, read_points_bytes};
use ombra_formats::minray::{parse_contest, read_contest_picture_bytes};
use ombra_formats::scene::parse_scene;
use ombra_formats::{
    Assets, Finding, FormatError, ImageBuffer, Limits, Model, parse_gltf, read_image_bytes,
    read_model_bytes, read_texture_bytes,
};
use ombra_geometry::triangle::TriangleTest;
use ombra_geometry::{Aabb, Point3, Ray, TriangleMesh, Vector3};
use ombra_scene::Scene;

/// A target: its name, which is that of its corpus, and what it does.
pub type Target = (&'static str, fn(&[u8]));

/// All of them.
pub const TARGETS: &[Target] = &[
    ("area", area),
    ("city", city),
    ("contest", contest),
    ("contest_picture", contest_picture),
    ("exr", exr),
    ("glb", glb),
    ("gltf", gltf),
    ("gzip", gzip),
    ("mtl", mtl),
    ("netpbm", netpbm),
    ("obj", obj),
    ("ply", ply),
    ("png", png),
    ("points", points),
    ("scene", scene),
    ("stl", stl),
    ("structure", structure),
    ("texture", texture),
];

/// What a reader may take on here: small, so that a file of a few bytes that asks for much is told
/// from one that is large.
fn limits() -> Limits {
    Limits {
        decompressed_bytes: 1 << 20,
        line_bytes: 1 << 16,
        image_pixels: 1 << 16,
        raster_pixels: 1 << 20,
    }
}

/// Reads a city, of whichever format its content says: GeoJSON, a list of polygons, CityJSON and its
/// sequences, OpenStreetMap as XML and as PBF.
pub fn city(data: &[u8]) {
    let options = CityOptions {
        limits: limits(),
        ..CityOptions::default()
    };
    let city = match read_city_bytes("a", data, &options) {
        Ok(city) => city,
        Err(error) => return check_error(&error),
    };
    city.findings.iter().for_each(|finding| check_line(finding));
    assert!(city.buildings.len() + city.terrain.len() > 0);
    assert!(city.ground.is_finite());
    for building in &city.buildings {
        assert!(!building.parts.is_empty(), "a building has parts");
        let ranges = building.parts.iter().map(|part| part.range());
        ranges.for_each(|[low, high]| assert!(low <= high, "{low} {high}"));
    }
    for facet in city.facets() {
        assert!(facet.corners.iter().all(|p| p.is_finite()), "{facet:?}");
    }
}

/// Reads the polygons of a study area, and asks which places lie in it.
pub fn area(data: &[u8]) {
    let area = match read_area_bytes("a", data, &limits()) {
        Ok(area) => area,
        Err(error) => return check_error(&error),
    };
    area.findings.iter().for_each(|finding| check_line(finding));
    assert!(!area.areas.is_empty());
    let origin = ombra_city::Origin::new(ombra_city::Crs::wgs84(), [4.36, 52.01]);
    let origin = origin.expect("Delft is on the map");
    match ombra_city::StudyArea::new(&origin, &area.crs, &area.polygons()) {
        Ok(study) => {
            let [low, high] = study.bounds();
            assert!((0..2).all(|k| low[k] < high[k]));
            assert!(!study.contains([high[0] + 1.0, high[1]]));
            let _ = study.contains([0, 1].map(|k| 0.5 * (low[k] + high[k])));
        }
        Err(error) => check_line(&error),
    }
}

/// Reads points: GeoJSON or a table.
pub fn points(data: &[u8]) {
    let file = match read_points_bytes("a", data, &limits()) {
        Ok(file) => file,
        Err(error) => return check_error(&error),
    };
    file.findings.iter().for_each(|finding| check_line(finding));
    assert!(!file.points.is_empty());
    for point in &file.points {
        assert!(point.at.iter().all(|x| x.is_finite()), "{point:?}");
        assert!((0.0..=10_000.0).contains(&point.height), "{point:?}");
    }
}

/// Reads OBJ.
pub fn obj(data: &[u8]) {
    // The materials file is not there: that is a finding.
    let model = read_model_bytes("a.obj", data, &Assets::Embedded(&[]), &limits());
    check_model(model);
}

/// Reads MTL, by an OBJ file that names it.
pub fn mtl(data: &[u8]) {
    const MODEL: &[u8] = b"mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\n\
        usemtl a\nf 1/1 2/1 3/1\nusemtl b\nf 3 2 1\nusemtl c\nf 1 3 2\n";
    const PICTURE: &[u8] = b"\x00\x00\x02\0\0\0\0\0\0\0\0\0\x01\0\x01\0\x18\0\x40\x80\xc0";
    let assets = [("a.mtl", data), ("t.tga", PICTURE)];
    let model = read_model_bytes("a.obj", MODEL, &Assets::Embedded(&assets), &limits());
    if let Some(model) = check_model(model) {
        assert_eq!(model.parts.len(), 3, "one a material");
        assert!(model.files.len() >= 2, "the materials file was read");
    }
}

/// Reads PLY, as text and binary.
pub fn ply(data: &[u8]) {
    let model = read_model_bytes("a.ply", data, &Assets::Embedded(&[]), &limits());
    check_model(model);
}

/// Reads STL, as text and binary.
pub fn stl(data: &[u8]) {
    let model = read_model_bytes("a.stl", data, &Assets::Embedded(&[]), &limits());
    check_model(model);
}

/// Reads a model in gzip. The first byte says whether the rest is the file as it is or is to be
/// packed first: then what is read must be what is read without.
pub fn gzip(data: &[u8]) {
    let Some((&kind, rest)) = data.split_first() else {
        return;
    };
    let assets = Assets::Embedded(&[]);
    let read = |name: &str, bytes: &[u8]| read_model_bytes(name, bytes, &assets, &limits());
    // A file that is in gzip already is unpacked once.
    if kind & 1 == 0 || rest.starts_with(b"\x1f\x8b") {
        check_model(read("a.obj.gz", rest));
        return;
    }
    let mut packed = Vec::new();
    // In two members, as two files put one after the other make.
    let (first, second) = rest.split_at(rest.len().min(usize::from(kind)));
    for member in [first, second] {
        let mut encoder = flate2::write::GzEncoder::new(packed, flate2::Compression::fast());
        std::io::Write::write_all(&mut encoder, member).expect("memory can be written");
        packed = encoder.finish().expect("memory can be written");
    }
    let plain = check_model(read("a.obj", rest));
    let packed = check_model(read("a.obj.gz", &packed));
    assert_eq!(
        plain.as_ref().map(Model::triangles),
        packed.as_ref().map(Model::triangles)
    );
    assert_eq!(
        plain.as_ref().map(Model::bounds),
        packed.as_ref().map(Model::bounds)
    );
}

/// Reads glTF: JSON, its buffers and pictures in data URIs.
pub fn gltf(data: &[u8]) {
    let file = match parse_gltf(data, TriangleTest::default(), &limits()) {
        Ok(file) => file,
        Err(error) => return check_error(&error),
    };
    check_findings(&file.findings);
    check_scene(&file.scene);
    assert!(file.files.is_empty(), "no file is opened");
}

/// Reads GLB, packed from its two chunks: the length of the first in two bytes, the first, the
/// second. So changes reach what is in the chunks; the first byte says whether the bytes are GLB as
/// they are instead.
pub fn glb(data: &[u8]) {
    let [kind, low, high, rest @ ..] = data else {
        return;
    };
    if kind & 1 == 0 {
        return gltf(&data[1..]);
    }
    let length = usize::from(u16::from_le_bytes([*low, *high]));
    let (json, binary) = rest.split_at(length.min(rest.len()));
    let mut file = b"glTF\x02\0\0\0\0\0\0\0".to_vec();
    for (kind, fill, chunk) in [(b"JSON", b' ', json), (b"BIN\0", 0, binary)] {
        let padded = chunk.len().next_multiple_of(4);
        file.extend((padded as u32).to_le_bytes());
        file.extend(kind);
        file.extend(chunk);
        file.resize(file.len() + padded - chunk.len(), fill);
    }
    let whole = (file.len() as u32).to_le_bytes();
    file[8..12].copy_from_slice(&whole);
    gltf(&file);
}

/// Reads a scene file, with two models and a picture for it to name.
pub fn scene(data: &[u8]) {
    const MODEL: &[u8] = b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    const PICTURE: &[u8] = b"\x00\x00\x02\0\0\0\0\0\0\0\0\0\x01\0\x01\0\x18\0\x40\x80\xc0";
    let Ok(text) = str::from_utf8(data) else {
        return;
    };
    let assets = [("a.obj", MODEL), ("teapot.obj", MODEL), ("t.tga", PICTURE)];
    let assets = Assets::Embedded(&assets);
    let file = match parse_scene(text, &assets, TriangleTest::default(), &limits()) {
        Ok(file) => file,
        Err(error) => return check_error(&error),
    };
    assert_eq!(file.hash.len(), 64);
    check_findings(&file.findings);
    check_scene(&file.scene);
}

/// Reads a scene of the minimal ray tracing contest.
pub fn contest(data: &[u8]) {
    match parse_contest(data) {
        Ok(contest) => {
            let scene = contest.scene();
            check_scene(&scene);
            assert_eq!(scene.objects.len(), contest.spheres.len());
        }
        Err(error) => check_error(&error),
    }
}

/// Reads a picture of the contest, writes it and reads it again.
pub fn contest_picture(data: &[u8]) {
    let read = |data: &[u8]| read_contest_picture_bytes("a.ap", data, &limits());
    match read(data) {
        Ok(picture) => {
            let pixels = u64::from(picture.width()) * u64::from(picture.height());
            assert!((1..=limits().image_pixels).contains(&pixels), "{pixels}");
            assert_eq!(picture.pixels().len() as u64, pixels);
            let again = read(picture.to_string().as_bytes());
            assert_eq!(again.ok(), Some(picture));
        }
        Err(error) => check_error(&error),
    }
}

/// Reads PNG, as a picture and as a texture.
pub fn png(data: &[u8]) {
    let image = image("a.png", data);
    let texture = read_as_texture("a.png", data);
    assert_eq!(image.is_some(), texture.is_some(), "two ways to one reader");
}

/// Reads JPEG, BMP and TGA, as textures. What begins like none of them is TGA by its name.
pub fn texture(data: &[u8]) {
    read_as_texture("a.tga", data);
}

/// Reads OpenEXR.
pub fn exr(data: &[u8]) {
    image("a.exr", data);
}

/// Reads PPM and PFM, whichever the first bytes say.
pub fn netpbm(data: &[u8]) {
    if data.starts_with(b"P6") {
        let image = image("a.ppm", data);
        assert_eq!(image.map_or(0, |image| image.non_finite()), 0);
    } else {
        image("a.pfm", data);
    }
}

/// Loads a structure. The first byte says whether the checksums are made right first: then changes
/// reach what is behind them. Rays go through whatever is loaded, near and far, at every level.
pub fn structure(data: &[u8]) {
    let Some((&kind, rest)) = data.split_first() else {
        return;
    };
    let mut file = rest.to_vec();
    if kind & 1 == 1 {
        make_sums_right(&mut file);
    }
    let tree = match TriangleTree::read_bytes("a.ombra", &file) {
        Ok(tree) => tree,
        Err(error) => return check_line(&error),
    };
    let bounds = tree.bounds();
    let (centre, extent) = if bounds.is_empty() {
        (Point3::ORIGIN, 1.0)
    } else {
        (bounds.centre(), bounds.extent().max_norm())
    };
    let mut rays = Vec::new();
    for octant in 0..8 {
        let side = |bit: u32| if octant >> bit & 1 == 0 { 0.9 } else { -1.0 };
        let toward = Point3::new(side(0), side(1), side(2)) - Point3::ORIGIN;
        for away in [0.0, 1.0, 1e4] {
            rays.push(Ray::new(centre - toward * (away * extent), toward));
        }
    }
    // Enough that go together for a packet.
    for k in 0..64 {
        let aside = Vector3::new((k % 8) as f32, (k / 8) as f32, 8.0) * (extent / 16.0);
        let from = centre + Vector3::new(1.0, 0.8, 0.9) * extent;
        rays.push(Ray::new(from, centre + aside - from));
    }
    for level in Level::available() {
        let tree = tree.clone().at_level(level);
        let mut hits = vec![None; rays.len()];
        tree.intersect_many(&rays, &mut hits);
        for (ray, many) in rays.iter().zip(hits) {
            let one = tree.intersect(ray);
            assert_eq!(one, many, "{ray:?}");
            let mut all = Vec::new();
            tree.all_hits(ray, &mut all);
            for hit in all.iter().chain(&one) {
                assert!((hit.primitive.0 as usize) < tree.triangles(), "{hit:?}");
            }
        }
    }
}

/// Writes the checksums of what is there into the header of a structure.
fn make_sums_right(file: &mut [u8]) {
    let Some(&[a, b, c, d]) = file.get(16..20) else {
        return;
    };
    let nodes = u32::from_le_bytes([a, b, c, d]) as usize;
    let quads = nodes.saturating_mul(256).saturating_add(128);
    if quads <= file.len() {
        let sums = [&file[128..quads], &file[quads..]].map(crc32fast::hash);
        file[36..40].copy_from_slice(&sums[0].to_le_bytes());
        file[40..44].copy_from_slice(&sums[1].to_le_bytes());
    }
    if file.len() >= 128 {
        let sum = crc32fast::hash(&file[..124]);
        file[124..128].copy_from_slice(&sum.to_le_bytes());
    }
}

fn check_scene(scene: &Scene) {
    assert_eq!(scene.validate(), Ok(()));
    for geometry in &scene.geometries {
        if let Geometry::Mesh(mesh) = geometry {
            check_mesh(mesh.mesh());
        }
        for primitive in 0..geometry.len() as u32 {
            let bounds = geometry.bounds(primitive);
            assert!(!bounds.is_empty(), "{bounds:?}");
        }
    }
    for object in &scene.objects {
        let to = object.world_from_object.rows();
        assert!(to.iter().flatten().all(|x| x.is_finite()), "{to:?}");
    }
}

fn image(name: &str, data: &[u8]) -> Option<ImageBuffer> {
    let image = read_image_bytes(name, data, &limits());
    let image = image.map_err(|error| check_error(&error)).ok()?;
    let pixels = u64::from(image.width()) * u64::from(image.height());
    assert!((1..=limits().image_pixels).contains(&pixels), "{pixels}");
    assert_eq!(image.pixels().len() as u64, pixels);
    for channel in image.channels() {
        assert_eq!(channel.values.len() as u64, pixels, "{}", channel.name);
    }
    Some(image)
}

fn read_as_texture(name: &str, data: &[u8]) -> Option<()> {
    let image = read_texture_bytes(name, data, &limits());
    let image = image.map_err(|error| check_error(&error)).ok()?;
    let pixels = u64::from(image.width()) * u64::from(image.height());
    assert!((1..=limits().image_pixels).contains(&pixels), "{pixels}");
    assert_eq!(image.pixels().len() as u64, pixels);
    let in_range = |x: f32| (0.0..=1.0).contains(&x);
    let mut components = image.pixels().iter().flat_map(|pixel| pixel.to_array());
    assert!(components.all(in_range), "sRGB has no other colours");
    Some(())
}

fn check_model(model: Result<Model, FormatError>) -> Option<Model> {
    let model = model.map_err(|error| check_error(&error)).ok()?;
    check_findings(&model.findings);
    for part in &model.parts {
        assert!(part.material < model.materials.len(), "a material is there");
        check_mesh(&part.mesh);
    }
    let bounds = model.bounds();
    assert_eq!(bounds.is_empty(), model.parts.is_empty());
    assert!(bounds.is_empty() || bounds.is_finite(), "{bounds:?}");
    Some(model)
}

fn check_mesh(mesh: &TriangleMesh) {
    let positions = mesh.positions();
    assert!(!mesh.triangles().is_empty(), "a part has triangles");
    let mut used = vec![false; positions.len()];
    let mut bounds = Aabb::EMPTY;
    for &corner in mesh.triangles().iter().flatten() {
        used[corner as usize] = true;
        bounds = bounds.union(Aabb::around([positions[corner as usize]]));
    }
    assert!(used.iter().all(|&used| used), "a vertex has a triangle");
    assert_eq!(bounds, mesh.bounds());
    assert_eq!(mesh.degenerate_triangles(), 0, "those are left out");
    for normal in mesh.normals().unwrap_or_default() {
        assert!((normal.length() - 1.0).abs() < 1e-5, "{normal:?}");
    }
    let finite = |uv: &[f32; 2]| uv.iter().all(|x| x.is_finite());
    assert!(mesh.uvs().unwrap_or_default().iter().all(finite));
}

fn check_findings(findings: &[Finding]) {
    findings.iter().for_each(|finding| check_line(finding));
}

fn check_error(error: &FormatError) {
    check_line(error);
}

/// What a person is told is one line, and not a screenful.
fn check_line(message: &dyn Display) {
    let text = message.to_string();
    assert!(!text.is_empty());
    assert!(!text.contains(['\n', '\r']), "{text:?}");
    assert!(text.len() < 2000, "{} bytes: {text:.200}", text.len());
}
