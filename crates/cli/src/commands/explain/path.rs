//! Rays as lines in space: where each begins and where it ends.

use ombra::geometry::{Point3, Vector3};
use ombra::render::explain::{End, RayKind, SampleTree};

/// The most rays that a drawing or a model shows, those that count most.
pub(crate) const MAX_DRAWN: usize = 200;

/// A ray as a line.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Path {
    /// Its number, after that of its sample if there are several.
    pub(crate) name: String,
    pub(crate) kind: RayKind,
    pub(crate) from: Point3<f64>,
    /// Unit length.
    pub(crate) along: Vector3<f64>,
    /// Where it met something or came to the light; none if it goes on for ever.
    pub(crate) to: Option<Point3<f64>>,
    /// Whether it ends at a surface.
    pub(crate) met: bool,
    /// The object of that surface.
    pub(crate) object: Option<usize>,
    /// A shadow ray that something is in the way of.
    pub(crate) blocked: bool,
    /// What share of its light arrives at the pixel, of the colour of which most does.
    pub(crate) weight: f32,
}

/// The rays that were sent, as lines, in order; and how many were left out because there are more
/// than [`MAX_DRAWN`].
pub(crate) fn paths(samples: &[SampleTree]) -> (Vec<Path>, usize) {
    let mut paths = Vec::new();
    for sample in samples {
        for (index, ray) in sample.rays.iter().enumerate() {
            if matches!(ray.end, End::MaxDepth | End::Unimportant) || !ray.ray.is_valid() {
                continue;
            }
            let Some(along) = ray.ray.direction.wide().normalized() else {
                continue;
            };
            let opaque = ray.crossed.iter().find(|one| one.transmission.is_none());
            let t = match (&ray.met, opaque) {
                (Some(place), _) => Some(place.hit.t),
                (None, Some(crossing)) => Some(crossing.hit.t),
                (None, None) => Some(ray.ray.t_max).filter(|t| t.is_finite()),
            };
            let wide: ombra::geometry::Ray<f64> = ray.ray.into();
            let name = if samples.len() > 1 {
                format!("{}.{index}", sample.index)
            } else {
                index.to_string()
            };
            paths.push(Path {
                name,
                kind: ray.kind,
                from: wide.origin,
                along,
                to: t.map(|t| wide.at(f64::from(t))),
                met: ray.met.is_some() || opaque.is_some(),
                object: match (&ray.met, opaque) {
                    (Some(place), _) => Some(place.hit.instance.index()),
                    (None, Some(crossing)) => Some(crossing.hit.instance.index()),
                    (None, None) => None,
                },
                blocked: ray.end == End::Blocked,
                weight: ray.weight_in_pixel.max_component(),
            });
        }
    }
    let left_out = keep_heaviest(&mut paths, MAX_DRAWN, |path| path.weight);
    (paths, left_out)
}

/// Keeps those that weigh most, of equal ones the first, in their order; gives how many were dropped.
fn keep_heaviest<T>(all: &mut Vec<T>, most: usize, weight: impl Fn(&T) -> f32) -> usize {
    let before = all.len();
    if before > most {
        let mut order: Vec<usize> = (0..before).collect();
        order.sort_by(|&a, &b| weight(&all[b]).total_cmp(&weight(&all[a])));
        let mut kept = vec![false; before];
        for &index in &order[..most] {
            kept[index] = true;
        }
        let mut kept = kept.into_iter();
        all.retain(|_| kept.next() == Some(true));
    }
    before - all.len()
}

#[cfg(test)]
mod tests {
    use super::keep_heaviest;

    #[test]
    fn the_heaviest_are_kept_in_their_order_and_equal_ones_too() {
        let kept = |weights: &[f32], most| {
            let mut all: Vec<_> = weights.iter().copied().enumerate().collect();
            let dropped = keep_heaviest(&mut all, most, |one| one.1);
            let indices: Vec<_> = all.into_iter().map(|(index, _)| index).collect();
            (indices, dropped)
        };
        assert_eq!(kept(&[1.0; 5], 2), (vec![0, 1], 3));
        assert_eq!(kept(&[1.0, 3.0, 1.0, 2.0, 1.0], 3), (vec![0, 1, 3], 2));
        assert_eq!(kept(&[1.0, 2.0], 2), (vec![0, 1], 0));
        assert_eq!(kept(&[], 2), (vec![], 0));
    }
}
