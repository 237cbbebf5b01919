//! Whether faces enclose a solid.

use std::collections::HashMap;

use ombra_geometry::Point3;

use crate::building::Face;
use crate::city::LOWEST;
use crate::join::key;
use crate::polygon::edges;

/// Whether every edge of every face is run through once each way, as those of a closed surface are,
/// but for those of a flat bottom, which many models leave out. If all faces look inwards, they are
/// turned.
pub(super) fn close(faces: &mut [Face]) -> bool {
    // One way counts up and the other down, so that all balance in the end.
    let mut balance: HashMap<([u32; 3], [u32; 3]), i32> = HashMap::new();
    for ring in faces.iter().flat_map(|face| &face.rings) {
        for (a, b) in edges(ring.iter().copied()) {
            let (a, b) = (key(a), key(b));
            let way = if a < b { 1 } else { -1 };
            *balance.entry((a.min(b), a.max(b))).or_default() += way;
        }
    }
    let corners = faces.iter().flat_map(Face::corners);
    let Some(apex) = corners.min_by(|a, b| a.z.total_cmp(&b.z)) else {
        return false;
    };
    let is_low = |p: [u32; 3]| f32::from_bits(p[2]) <= apex.z + LOWEST;
    if balance
        .iter()
        .any(|(&(a, b), &count)| count != 0 && !(is_low(a) && is_low(b)))
    {
        return false;
    }
    let volume = six_volumes(faces, apex);
    if volume < 0.0 {
        for ring in faces.iter_mut().flat_map(|face| &mut face.rings) {
            ring.reverse();
        }
    }
    volume != 0.0
}

/// Six times the enclosed volume: the sum of the tetrahedra between an apex and fans of the rings
/// (holes run the other way and count against). Of a bottom that is not there the volume is none, as
/// the apex lies in it.
fn six_volumes(faces: &[Face], apex: Point3) -> f64 {
    let mut sum = 0.0;
    for ring in faces.iter().flat_map(|face| &face.rings) {
        let spokes: Vec<_> = ring.iter().map(|p| p.wide() - apex.wide()).collect();
        for pair in spokes.get(1..).unwrap_or_default().windows(2) {
            let cross = pair[0].cross(pair[1]);
            let first = spokes[0];
            sum += first.x * cross.x + first.y * cross.y + first.z * cross.z;
        }
    }
    sum
}
