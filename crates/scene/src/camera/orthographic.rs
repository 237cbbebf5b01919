//! A camera without perspective.

use ombra_geometry::{Point3, Vector3};

/// Parallel rays: what is far is as large as what is near.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Orthographic {
    /// The height of the part of the scene that is seen, in units of the scene. Above 0.
    pub height: f32,
}

impl Orthographic {
    #[inline]
    pub(super) fn local_ray(&self, aspect: f32, [px, py]: [f32; 2]) -> (Point3, Vector3) {
        let half = self.height * 0.5;
        let x = (2.0 * px - 1.0) * aspect * half;
        let y = (1.0 - 2.0 * py) * half;
        (Point3::new(x, y, 0.0), -Vector3::Z)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rays_are_parallel_and_span_the_height() {
        let camera = Orthographic { height: 4.0 };
        let (top, d0) = camera.local_ray(1.0, [0.5, 0.0]);
        let (bottom, d1) = camera.local_ray(1.0, [0.5, 1.0]);
        assert_eq!((top.y - bottom.y, d0), (4.0, d1));
    }
}
