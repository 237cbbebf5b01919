//! A building made taller or lower.

use crate::building::{Building, Part};

/// No building is taller, in metres.
const TALLEST: f64 = 10_000.0;

/// Stretched upward from its ground, so that its top is so many metres above it. An upright stretch keeps planes planes and closed
/// solids closed. `None` if there is no such height, or the building has none to be stretched.
pub(super) fn to_height(building: &Building, metres: f64) -> Option<Building> {
    let parts = building.parts.iter();
    let top = parts.map(|part| part.range()[1]).reduce(f32::max)?;
    let (ground, old) = (f64::from(building.ground), top - building.ground);
    if !(metres > 0.0 && metres <= TALLEST && old > 0.0) {
        return None;
    }
    let factor = metres / f64::from(old);
    let higher = |z: f32| {
        if z <= building.ground {
            z
        } else if z == top {
            (ground + metres) as f32
        } else {
            (ground + (f64::from(z) - ground) * factor) as f32
        }
    };
    let mut stretched = building.clone();
    for part in &mut stretched.parts {
        match part {
            Part::Prism(prism) => {
                prism.base = higher(prism.base);
                prism.top = higher(prism.top);
                if prism.base >= prism.top {
                    return None;
                }
            }
            Part::Faces(faces) => {
                for p in (faces.faces.iter_mut()).flat_map(|face| face.rings.iter_mut().flatten()) {
                    p.z = higher(p.z);
                }
            }
        }
    }
    Some(stretched)
}
