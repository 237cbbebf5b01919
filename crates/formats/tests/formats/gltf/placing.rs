//! Nodes, instances and cameras.

use ombra_accel::{StructureKind, Traversable as _};
use ombra_formats::scene::{Assets, parse_scene};
use ombra_formats::{FileInfo, Limits, inspect, read_gltf};
use ombra_geometry::triangle::TriangleTest;
use ombra_geometry::{Point3, Ray, Vector3};
use ombra_scene::World;
use ombra_scene::camera::Projection;

use super::{Doc, findings};
use crate::Folder;

/// The triangle of [`Doc::triangle`] placed by these nodes.
fn nodes(nodes: &str) -> Doc {
    let mut doc = Doc::triangle("", "");
    doc.rest = doc.rest.replace(r#"[{"mesh": 0}]"#, &format!("[{nodes}]"));
    doc
}

#[test]
fn a_mesh_that_is_placed_often_is_one_geometry() {
    let file = nodes(
        r#"{"mesh": 0}, {"mesh": 0, "translation": [5, 0, 0]},
           {"name": "arm", "scale": [2, 2, 2], "children": [3]},
           {"name": "hand", "mesh": 0, "translation": [0, 1, 0]}"#,
    )
    .read();
    assert_eq!(
        (file.scene.geometries.len(), file.scene.objects.len()),
        (1, 3)
    );
    let at = |i: usize| {
        file.scene.objects[i]
            .world_from_object
            .point(Point3::<f64>::new(1.0, 0.0, 0.0))
    };
    assert_eq!(at(1).to_array(), [6.0, 0.0, 0.0]);
    assert_eq!(at(2).to_array(), [2.0, 2.0, 0.0]);
    assert_eq!(file.scene.objects[2].name, "hand");
    assert_eq!((file.info.triangles, file.info.placed_triangles), (1, 3));
}

#[test]
fn one_node_may_place_a_mesh_many_times() {
    let mut doc = nodes(
        r#"{"mesh": 0, "scale": [2, 2, 2], "extensions": {"EXT_mesh_gpu_instancing":
           {"attributes": {"TRANSLATION": 2, "SCALE": 3}}}}"#,
    );
    doc.floats(&[0.0, 0.0, 0.0, 7.0, 0.0, 0.0], "VEC3");
    doc.floats(&[1.0, 1.0, 1.0, 3.0, 1.0, 1.0], "VEC3");
    let file = doc.read();
    assert_eq!(
        (file.scene.geometries.len(), file.scene.objects.len()),
        (1, 2)
    );
    let second = &file.scene.objects[1].world_from_object;
    let tip = second.point(Point3::<f64>::new(1.0, 0.0, 0.0));
    assert_eq!(tip.to_array(), [20.0, 0.0, 0.0]);
}

#[test]
fn only_the_scene_that_is_named_is_shown() {
    let mut doc = nodes(r#"{"mesh": 0, "name": "a"}, {"mesh": 0, "name": "b"}"#);
    doc.rest += r#", "scene": 1, "scenes": [{"nodes": [0]}, {"nodes": [1]}]"#;
    let file = doc.read();
    assert_eq!(file.scene.objects.len(), 1);
    assert_eq!(file.scene.objects[0].name, "b");
}

#[test]
fn a_mirrored_mesh_keeps_its_outside() {
    for (node, seen_from) in [
        (r#"{"mesh": 0}"#, 1.0),
        (r#"{"mesh": 0, "scale": [-1, 1, 1]}"#, 1.0),
        (r#"{"mesh": 0, "scale": [1, 1, -1]}"#, -1.0),
        (r#"{"mesh": 0, "rotation": [0, 1, 0, 0]}"#, -1.0),
    ] {
        let scene = nodes(node).read().scene;
        let world = World::build(scene, StructureKind::default()).unwrap();
        let x = if node.contains("-1, 1, 1") || node.contains("rotation") {
            -0.2
        } else {
            0.2
        };
        let from = |z: f32| Ray::new(Point3::new(x, 0.2, z), Vector3::new(0.0, 0.0, -z));
        assert!(world.intersect(&from(seen_from)).is_some(), "{node}");
        assert!(world.intersect(&from(-seen_from)).is_none(), "{node}");
    }
}

#[test]
fn what_a_transform_flattens_is_left_out_and_said() {
    let file = nodes(r#"{"mesh": 0, "scale": [1, 0, 1]}"#).read();
    assert!(file.scene.objects.is_empty());
    assert!(findings(&file)[0].starts_with("nodes[0]: is flattened by its transform"));
    let error =
        nodes(r#"{"mesh": 0, "translation": [1e300, 0, 0], "scale": [1e200, 1e200, 1e200]}, {}"#);
    assert!(error.try_read().is_ok());
    let deep: Vec<_> = (1..5)
        .map(|i| format!(r#"{{"scale": [1e99, 1e99, 1e99], "children": [{i}]}}"#))
        .collect();
    let error = nodes(&(deep.join(",") + r#", {"mesh": 0}"#)).error();
    assert!(
        error.starts_with("nodes[4]: its place in the scene: "),
        "{error}"
    );
}

#[test]
fn the_first_camera_is_that_of_the_picture() {
    let mut doc = nodes(
        r#"{"translation": [1, 2, 3], "children": [1]}, {"camera": 0, "rotation": [0, 1, 0, 1]},
           {"camera": 1, "scale": [3, 3, 3]}"#,
    );
    doc.rest += r#", "cameras": [
        {"type": "perspective", "perspective": {"yfov": 0.5, "aspectRatio": 1.5, "znear": 0.1}},
        {"type": "orthographic", "orthographic": {"xmag": 4, "ymag": 2, "zfar": 9, "znear": 0}}]"#;
    let file = doc.read();
    let camera = file.scene.camera.unwrap();
    assert_eq!(camera.pose.position(), Point3::new(1.0, 2.0, 3.0));
    let toward = camera.pose.direction();
    assert!((toward - -Vector3::X).length() < 1e-6, "{toward:?}");
    match camera.projection {
        Projection::Perspective(p) => assert!((p.fov.radians() - 0.5).abs() < 1e-6),
        other => panic!("{other:?}"),
    }
    assert_eq!(file.picture.size, Some([810, 540]));
    assert!(findings(&file).contains(&"nodes[2]: only the first camera is used".to_owned()));
    doc.rest = doc.rest.replace(r#""camera": 0"#, r#""camera": 1"#);
    match doc.read().scene.camera.unwrap().projection {
        Projection::Orthographic(o) => assert_eq!(o.height, 4.0),
        other => panic!("{other:?}"),
    }
    for (from, to, said) in [
        ("0.5", "0", "cameras[0].perspective.yfov: is 0; radians"),
        ("0.5", "3.2", "cameras[0].perspective.yfov: is 3.2"),
        ("1.5", "-1", "cameras[0].perspective.aspectRatio: is -1"),
        (
            r#""camera": 1"#,
            r#""camera": 7"#,
            "nodes[1].camera: refers to cameras[7]",
        ),
    ] {
        let mut bad = nodes("");
        bad.rest = doc
            .rest
            .replacen(from, to, 1)
            .replace(r#""camera": 1, "rot"#, r#""camera": 0, "rot"#);
        let error = bad.error();
        assert!(error.starts_with(said), "{error}");
    }
}

#[test]
fn a_scene_file_places_glb_files() {
    let doc = nodes(r#"{"mesh": 0, "translation": [1, 0, 0]}, {"mesh": 0}"#);
    let folder = Folder::with(&[("t.glb", &doc.glb())]);
    let text = "[[objects]]\nmesh.file = \"t.glb\"\ntransform = [{ scale = 2 }]\n\
                [[objects]]\nmesh.file = \"t.glb\"\n";
    let assets = Assets::Folder(folder.path(""));
    let file = parse_scene(text, &assets, TriangleTest::default(), &Limits::default()).unwrap();
    assert_eq!(
        (file.scene.geometries.len(), file.scene.objects.len()),
        (1, 4)
    );
    let first = &file.scene.objects[0].world_from_object;
    assert_eq!(
        first.point(Point3::<f64>::new(1.0, 0.0, 0.0)).to_array(),
        [4.0, 0.0, 0.0]
    );
    let path = folder.path("t.glb");
    match inspect(&path).unwrap() {
        FileInfo::Gltf(info) => {
            assert_eq!(
                (info.format, info.nodes, info.placed_triangles),
                ("GLB", 2, 2)
            );
            assert_eq!(info.bounds, Some([[0.0; 3], [2.0, 1.0, 0.0]]));
        }
        other => panic!("{other:?}"),
    }
    let read = read_gltf(&path, TriangleTest::default(), &Limits::default()).unwrap();
    assert_eq!(read.files, [path]);
}
