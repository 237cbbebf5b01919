//! From where rays start, and where the light is.

use ombra_geometry::{Aabb, Point3, Vector3};

/// A camera and a light.
#[derive(Clone, Copy, Debug)]
pub struct View {
    /// Where primary rays start.
    pub eye: Point3,
    /// What is in the middle of the picture.
    pub target: Point3,
    /// The tangent of half the angle from the picture's lower to its upper edge.
    pub tangent: f32,
    /// Where shadow rays go.
    pub light: Light,
}

/// Where shadow rays go.
#[derive(Clone, Copy, Debug)]
pub enum Light {
    /// To a parallelogram.
    Area {
        /// One corner.
        corner: Point3,
        /// The sides from there.
        sides: [Vector3; 2],
    },
    /// Away for ever.
    Sun {
        /// Where it stands.
        towards: Vector3,
        /// How far it reaches around there, on both axes, one being 45°.
        spread: f32,
    },
}

/// The place at shares of a box along its axes.
fn within(bounds: &Aabb, shares: [f32; 3]) -> Point3 {
    let extent = bounds.extent();
    let [x, y, z] = shares;
    bounds.min + Vector3::new(extent.x * x, extent.y * y, extent.z * z)
}

/// From low in a hall along its length, which is x; a lamp hangs below the roof.
pub(super) fn inside(bounds: &Aabb) -> View {
    let extent = bounds.extent();
    View {
        eye: within(bounds, [0.22, 0.22, 0.47]),
        target: within(bounds, [0.9, 0.38, 0.55]),
        tangent: 0.7,
        light: Light::Area {
            corner: within(bounds, [0.45, 0.7, 0.45]),
            sides: [
                Vector3::X * (0.1 * extent.x),
                Vector3::new(0.0, 0.0, 0.1 * extent.z),
            ],
        },
    }
}

/// From in front and above, so that all of it is in the picture.
pub(super) fn outside(bounds: &Aabb) -> View {
    let away = Vector3::new(0.35, 0.4, 1.0) * bounds.extent().length();
    View {
        eye: bounds.centre() + away,
        target: bounds.centre(),
        tangent: 0.45,
        light: sun([0.4, 0.8, 0.35]),
    }
}

/// At a thing on a floor six times as wide.
pub(super) fn on_a_floor(bounds: &Aabb) -> View {
    View {
        eye: within(bounds, [0.46, 0.9, 0.66]),
        target: within(bounds, [0.5, 0.42, 0.5]),
        tangent: 0.325,
        light: sun([0.4, 0.8, 0.35]),
    }
}

/// From above roofs, down to the streets.
pub(super) fn over_roofs(bounds: &Aabb) -> View {
    let at = |x, z, y| Point3 {
        y,
        ..within(bounds, [x, 0.0, z])
    };
    View {
        eye: at(0.36, 0.34, bounds.extent().x.min(170.0)),
        target: at(0.42, 0.42, 0.0),
        tangent: 0.577,
        light: sun([0.45, 0.6, -0.3]),
    }
}

fn sun([x, y, z]: [f32; 3]) -> Light {
    Light::Sun {
        towards: Vector3::new(x, y, z),
        spread: 0.05,
    }
}
