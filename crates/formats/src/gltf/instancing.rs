//! `EXT_mesh_gpu_instancing`: one mesh in many places of one node.

use super::accessor::{Accessor, Wanted};
use super::buffer::Buffers;
use super::document::{Document, InstancingSpec};
use super::node::{Matrix, of_parts};
use super::wrong;
use crate::error::FormatError;

/// The placements, in the space of the node; at most `most`.
pub(super) fn placements(
    document: &Document,
    buffers: &Buffers<'_>,
    spec: &InstancingSpec,
    most: u64,
    place: &str,
) -> Result<Vec<Matrix>, FormatError> {
    let place = format!("{place}.extensions.EXT_mesh_gpu_instancing.attributes");
    let open = |index: Option<usize>, kind: &str, name: &str| {
        let wanted = Wanted {
            kinds: &[kind],
            indices: false,
        };
        let user = format!("{place}.{name}");
        index
            .map(|index| Accessor::of(document, buffers, index, wanted, &user))
            .transpose()
    };
    let attributes = &spec.attributes;
    let translations = open(attributes.translation, "VEC3", "TRANSLATION")?;
    let rotations = open(attributes.rotation, "VEC4", "ROTATION")?;
    let scales = open(attributes.scale, "VEC3", "SCALE")?;
    let mut counts = [&translations, &rotations, &scales]
        .into_iter()
        .flatten()
        .map(|accessor| accessor.count);
    let Some(count) = counts.next() else {
        return Err(wrong(
            place,
            "has no TRANSLATION, ROTATION or SCALE; one of them is right",
        ));
    };
    if let Some(other) = counts.find(|&other| other != count) {
        let message = format!("{count} of one and {other} of another; as many of each are right");
        return Err(wrong(place, message));
    }
    if count > most {
        let message =
            format!("{count} placements are more than a file of this size is trusted with");
        return Err(wrong(place, message));
    }
    (0..count)
        .map(|i| {
            let vector = |accessor: &Option<Accessor<'_>>, default: f32| {
                let numbers = accessor.as_ref().map(|a| a.numbers::<3>(i));
                numbers.unwrap_or([default; 3]).map(f64::from)
            };
            let rotation = rotations.as_ref().map(|r| r.numbers::<4>(i).map(f64::from));
            let matrix = of_parts(
                vector(&translations, 0.0),
                rotation.unwrap_or([0.0, 0.0, 0.0, 1.0]),
                vector(&scales, 1.0),
            );
            matrix.ok_or_else(|| {
                let message = format!("element {i} is no rotation; a unit quaternion is right");
                wrong(format!("{place}.ROTATION"), message)
            })
        })
        .collect()
}
