//! Surfaces with one side, and with holes.

use std::sync::Arc;

use ombra_accel::{Geometry, Mesh, StructureKind, Traversable as _};
use ombra_geometry::{Point3, Ray, Transform, TriangleMesh, Vector3};
use ombra_scene::{Cutout, Filter, Image, Material, PictureTexture, Rgb, Scene, World};

/// A square in the xy plane from −1 to 1 whose outside is +z, uv from 0 to 1 over it.
fn square() -> Geometry {
    let at = |x, y| Point3::new(x, y, 0.0);
    let corners = vec![at(-1.0, -1.0), at(1.0, -1.0), at(1.0, 1.0), at(-1.0, 1.0)];
    let mesh = TriangleMesh::new(corners, vec![[0, 1, 2], [0, 2, 3]]).unwrap();
    let uvs = vec![[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    Geometry::Mesh(Mesh::new(mesh.with_uvs(uvs).unwrap()))
}

fn world(material: Material, scale: Vector3<f64>, kind: StructureKind) -> World {
    let mut scene = Scene::default();
    scene.add("square", square(), material, Transform::scale(scale));
    World::build(scene, kind).unwrap()
}

fn from_front(x: f32) -> Ray {
    Ray::new(Point3::new(x, 0.1, 5.0), -Vector3::Z)
}

fn from_behind(x: f32) -> Ray {
    Ray::new(Point3::new(x, 0.1, -5.0), Vector3::Z)
}

#[test]
fn a_surface_with_one_side_is_not_met_from_behind() {
    let material = Material {
        one_sided: true,
        ..Material::default()
    };
    for &kind in StructureKind::ALL {
        let world = world(material.clone(), Vector3::new(1.0, 1.0, 1.0), kind);
        assert!(world.intersect(&from_front(0.3)).is_some(), "{kind:?}");
        assert!(world.occluded(&from_front(0.3)), "{kind:?}");
        assert!(world.intersect(&from_behind(0.3)).is_none(), "{kind:?}");
        assert!(!world.occluded(&from_behind(0.3)), "{kind:?}");
    }
}

#[test]
fn a_mirroring_transform_does_not_turn_the_sides() {
    let material = Material {
        one_sided: true,
        ..Material::default()
    };
    let kind = StructureKind::default();
    let mirrored = world(material.clone(), Vector3::new(-2.0, 1.0, 1.0), kind);
    assert!(mirrored.intersect(&from_front(0.3)).is_some());
    assert!(mirrored.intersect(&from_behind(0.3)).is_none());
    let turned = world(material, Vector3::new(1.0, 1.0, -1.0), kind);
    assert!(turned.intersect(&from_front(0.3)).is_none());
    assert!(turned.intersect(&from_behind(0.3)).is_some());
}

#[test]
fn holes_let_rays_through_from_both_sides() {
    let image = Image::new(2, 1, vec![Rgb::WHITE; 2]).unwrap();
    let image = image.with_alpha(vec![1.0, 0.25]).unwrap();
    let picture = PictureTexture {
        filter: Filter::Nearest,
        ..PictureTexture::new(Arc::new(image))
    };
    let with_cutoff = |cutoff| Material {
        cutout: Some(Cutout {
            picture: picture.clone(),
            cutoff,
        }),
        ..Material::default()
    };
    for &kind in StructureKind::ALL {
        let holed = world(with_cutoff(0.5), Vector3::new(1.0, 1.0, 1.0), kind);
        for ray in [from_front, from_behind] {
            assert!(holed.intersect(&ray(-0.5)).is_some(), "{kind:?}");
            assert!(holed.intersect(&ray(0.5)).is_none(), "{kind:?}");
        }
        let whole = world(with_cutoff(0.25), Vector3::new(1.0, 1.0, 1.0), kind);
        assert!(whole.intersect(&from_front(0.5)).is_some(), "{kind:?}");
    }
}
