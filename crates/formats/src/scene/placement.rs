//! Where an object stands: the steps of its transform as one.

use ombra_geometry::{Object, Transform, Vector3, World};

use super::build::wrong;
use super::description::{RotateSpec, ScaleSpec, TransformSpec};
use crate::error::FormatError;

/// Steps taken in the order in which they are written.
pub(super) fn placement(steps: &[TransformSpec]) -> Result<Transform<Object, World>, FormatError> {
    let mut all = Transform::<Object, Object>::identity();
    for step in steps {
        let next = match step {
            TransformSpec::Translate(offset) => Transform::translation((*offset).into()),
            TransformSpec::Rotate(spec) => rotation(spec)?,
            TransformSpec::Scale(spec) => scale(*spec)?,
        };
        all = all.then::<Object>(&next);
    }
    let placed: Transform<Object, World> = all.then(&Transform::identity());
    // Numbers such as 1e300 may have overflowed on the way.
    Transform::from_rows(*placed.rows()).map_err(|e| wrong(format!("transform: {e}")))
}

fn rotation(spec: &RotateSpec) -> Result<Transform<Object, Object>, FormatError> {
    let (axis, degrees) = (Vector3::from(spec.axis), spec.degrees);
    if axis.normalized().is_none() {
        return Err(wrong(format!(
            "rotate: axis is {:?}; three finite numbers, not all 0, are needed",
            spec.axis
        )));
    }
    if !degrees.is_finite() {
        return Err(wrong(format!(
            "rotate: degrees is {degrees}; a finite number is needed"
        )));
    }
    Ok(Transform::rotation(axis, degrees.to_radians()))
}

fn scale(spec: ScaleSpec) -> Result<Transform<Object, Object>, FormatError> {
    let factors = match spec {
        ScaleSpec::Uniform(factor) => [factor; 3],
        ScaleSpec::Axes(factors) => factors,
    };
    if !factors.iter().all(|f| f.is_finite() && *f != 0.0) {
        return Err(wrong(format!(
            "scale is {factors:?}; finite factors other than 0 are needed"
        )));
    }
    Ok(Transform::scale(factors.into()))
}
