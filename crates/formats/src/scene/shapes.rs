//! The shapes of a scene file: the words for their parameters, and what they are made into.

use ombra_geometry::shape::{
    Cone, ConvexPolyhedron, Cuboid, Cylinder, Disk, Ends, Frustum, FrustumView, HalfSpace,
    OrientedBox, Plane, Rectangle, Shape, ShapeError, Sphere, Torus, Triangle,
};
use ombra_geometry::{Angle, Normal3, Point3, Vector3};
use serde::Deserialize;

use super::build::wrong;
use crate::error::FormatError;

/// The shapes, by the names and parameters of `ombra_geometry::shape`.
#[derive(Debug, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(super) enum ShapeSpec {
    Sphere(SphereSpec),
    Triangle(TriangleSpec),
    Plane(PlaneSpec),
    Disk(DiskSpec),
    Rectangle(RectangleSpec),
    Cylinder(CylinderSpec),
    Cone(ConeSpec),
    Box(BoxSpec),
    OrientedBox(OrientedBoxSpec),
    Frustum(FrustumSpec),
    Polyhedron(PolyhedronSpec),
    Torus(TorusSpec),
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct SphereSpec {
    centre: [f32; 3],
    radius: f32,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct TriangleSpec {
    corners: [[f32; 3]; 3],
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct PlaneSpec {
    point: [f32; 3],
    normal: [f32; 3],
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct DiskSpec {
    centre: [f32; 3],
    normal: [f32; 3],
    radius: f32,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RectangleSpec {
    corner: [f32; 3],
    edge_u: [f32; 3],
    edge_v: [f32; 3],
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct CylinderSpec {
    from: [f32; 3],
    to: [f32; 3],
    radius: f32,
    #[serde(default)]
    open: bool,
}

/// With `top_radius` the tip is cut off at `to`.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct ConeSpec {
    from: [f32; 3],
    to: [f32; 3],
    radius: f32,
    #[serde(default)]
    top_radius: f32,
    #[serde(default)]
    open: bool,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct BoxSpec {
    min: [f32; 3],
    max: [f32; 3],
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct OrientedBoxSpec {
    centre: [f32; 3],
    x_axis: [f32; 3],
    y_axis: [f32; 3],
    size: [f32; 3],
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct FrustumSpec {
    eye: [f32; 3],
    direction: [f32; 3],
    up: [f32; 3],
    /// Degrees.
    fov: f32,
    aspect: f32,
    near: f32,
    far: f32,
}

/// The planes of its faces, normals outward.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct PolyhedronSpec {
    faces: Vec<PlaneSpec>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct TorusSpec {
    centre: [f32; 3],
    axis: [f32; 3],
    major_radius: f32,
    minor_radius: f32,
}

impl ShapeSpec {
    pub(super) fn build(&self) -> Result<Shape, FormatError> {
        self.shape()
            .map_err(|error| wrong(format!("{}: {error}", self.name())))
    }

    const fn name(&self) -> &'static str {
        match self {
            Self::Sphere(_) => "sphere",
            Self::Triangle(_) => "triangle",
            Self::Plane(_) => "plane",
            Self::Disk(_) => "disk",
            Self::Rectangle(_) => "rectangle",
            Self::Cylinder(_) => "cylinder",
            Self::Cone(_) => "cone",
            Self::Box(_) => "box",
            Self::OrientedBox(_) => "oriented-box",
            Self::Frustum(_) => "frustum",
            Self::Polyhedron(_) => "polyhedron",
            Self::Torus(_) => "torus",
        }
    }

    fn shape(&self) -> Result<Shape, ShapeError> {
        Ok(match self {
            Self::Sphere(s) => {
                let sphere = Sphere::new(s.centre.into(), s.radius);
                sphere.validate()?;
                sphere.into()
            }
            Self::Triangle(s) => {
                let [a, b, c] = s.corners.map(Point3::from);
                let triangle = Triangle::new(a, b, c);
                triangle.validate()?;
                triangle.into()
            }
            Self::Plane(s) => Plane::new(s.point.into(), s.normal.into())?.into(),
            Self::Disk(s) => Disk::new(s.centre.into(), s.normal.into(), s.radius)?.into(),
            Self::Rectangle(s) => {
                Rectangle::new(s.corner.into(), s.edge_u.into(), s.edge_v.into())?.into()
            }
            Self::Cylinder(s) => {
                Cylinder::new(s.from.into(), s.to.into(), s.radius, ends(s.open))?.into()
            }
            Self::Cone(s) => {
                let radii = [s.radius, s.top_radius];
                Cone::truncated(s.from.into(), s.to.into(), radii, ends(s.open))?.into()
            }
            Self::Box(s) => Cuboid::new(s.min.into(), s.max.into())?.into(),
            Self::OrientedBox(s) => {
                let [x_axis, y_axis, size] = [s.x_axis, s.y_axis, s.size].map(Vector3::from);
                OrientedBox::new(s.centre.into(), x_axis, y_axis, size)?.into()
            }
            Self::Frustum(s) => Frustum::new(&s.view())?.into(),
            Self::Polyhedron(s) => {
                let faces: Vec<_> = s.faces.iter().map(PlaneSpec::half_space).collect();
                ConvexPolyhedron::from_half_spaces(&faces)?.into()
            }
            Self::Torus(s) => {
                let axis = Normal3::from(s.axis);
                Torus::new(s.centre.into(), axis, s.major_radius, s.minor_radius)?.into()
            }
        })
    }
}

impl FrustumSpec {
    fn view(&self) -> FrustumView {
        FrustumView {
            eye: self.eye.into(),
            direction: self.direction.into(),
            up: self.up.into(),
            vertical_fov: Angle::from_degrees(self.fov),
            aspect: self.aspect,
            near: self.near,
            far: self.far,
        }
    }
}

impl PlaneSpec {
    fn half_space(&self) -> HalfSpace {
        HalfSpace {
            point: self.point.into(),
            normal: self.normal.into(),
        }
    }
}

const fn ends(open: bool) -> Ends {
    if open { Ends::Open } else { Ends::Capped }
}
