//! Cameras: section 3.10 of the specification.

use ombra_geometry::{Angle, Point3, Vector3};
use ombra_scene::Camera;
use ombra_scene::camera::{Orthographic, Perspective, Pose, Projection};

use super::document::CameraSpec;
use super::node::Matrix;
use super::wrong;
use crate::error::FormatError;

/// A camera at its node: it looks along −z of the node with y up. Its planes in front and behind are
/// not used: rays see everything. Besides, the width of its picture over the height, if it says.
pub(super) fn camera(
    spec: &CameraSpec,
    matrix: &Matrix,
    place: &str,
) -> Result<(Camera, Option<f32>), FormatError> {
    let column = |i: usize| Vector3::new(matrix[0][i], matrix[1][i], matrix[2][i]);
    // The sum of squares of a far scaled node could overflow in single precision.
    let unit = |v: Vector3<f64>| v.normalized().unwrap_or_default().cast::<f32>();
    let position = Point3::ORIGIN + column(3).cast::<f32>();
    let pose = Pose::new(position, -unit(column(2)), unit(column(1)))
        .map_err(|error| wrong(place, error.to_string()))?;
    let above_zero = |number: f32, name: &str| {
        if number > 0.0 && number.is_finite() {
            Ok(number)
        } else {
            let message = format!("is {number}; a finite number above 0 is right");
            Err(wrong(format!("{place}.{name}"), message))
        }
    };
    let (projection, aspect) = match (&spec.perspective, &spec.orthographic) {
        (Some(perspective), _) => {
            let yfov = perspective.yfov;
            if !(yfov > 0.0 && yfov < std::f32::consts::PI) {
                let message = format!("is {yfov}; radians above 0 and below 3.14159 are right");
                return Err(wrong(format!("{place}.perspective.yfov"), message));
            }
            let aspect = perspective
                .aspect_ratio
                .map(|aspect| above_zero(aspect, "perspective.aspectRatio"))
                .transpose()?;
            let fov = Angle::from_radians(yfov);
            (Projection::Perspective(Perspective::new(fov)), aspect)
        }
        (None, Some(orthographic)) => {
            // A negative one mirrors nothing by the specification; its size counts.
            let ymag = above_zero(orthographic.ymag.abs(), "orthographic.ymag")?;
            let xmag = above_zero(orthographic.xmag.abs(), "orthographic.xmag")?;
            let height = 2.0 * ymag;
            let projection = Projection::Orthographic(Orthographic { height });
            (projection, Some(xmag / ymag))
        }
        (None, None) => {
            let message = "has neither perspective nor orthographic; one of them is right";
            return Err(wrong(place, message));
        }
    };
    Ok((Camera { pose, projection }, aspect))
}
