//! Shadow rays: how much of a light gets through.

use ombra_pipeline::RayType;
use ombra_scene::Rgb;

/// The rays from a place to a light.
pub(super) enum Shadow {}

impl RayType for Shadow {
    type Payload = Filter;
    const NAME: &'static str = "shadow";
}

/// What the surfaces on the way to a light leave of it.
#[derive(Clone, Debug, Default)]
pub(super) struct Filter {
    blocked: bool,
    /// One for each transparent surface, in the order of the traversal. That order differs between
    /// structures and a product of rounded factors depends on it, so they are multiplied in the end.
    transmissions: Vec<Rgb>,
}

impl Filter {
    /// Nothing gets through.
    #[inline]
    pub(super) const fn block(&mut self) {
        self.blocked = true;
    }

    /// Whether nothing gets through.
    #[inline]
    pub(super) const fn is_blocked(&self) -> bool {
        self.blocked
    }

    /// Only a part gets through.
    #[inline]
    pub(super) fn dim(&mut self, transmission: Rgb) {
        self.transmissions.push(transmission);
    }

    /// How much gets through; the same whatever the order of the surfaces.
    #[inline]
    pub(super) fn transmitted(mut self) -> Rgb {
        if self.blocked {
            return Rgb::BLACK;
        }
        if self.transmissions.len() > 2 {
            self.transmissions.sort_unstable_by(|a, b| {
                let pairs = a.to_array().into_iter().zip(b.to_array());
                pairs.fold(std::cmp::Ordering::Equal, |order, (a, b)| {
                    order.then(a.total_cmp(&b))
                })
            });
        }
        self.transmissions
            .into_iter()
            .fold(Rgb::WHITE, |light, transmission| light * transmission)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_order_of_surfaces_does_not_matter_to_the_last_bit() {
        let surfaces: Vec<Rgb> = (0..9)
            .map(|i| {
                Rgb::new(
                    0.9 - 0.01 * i as f32,
                    0.7 + 0.013 * i as f32,
                    1.0 / (i + 1) as f32,
                )
            })
            .collect();
        let through = |order: &mut dyn Iterator<Item = &Rgb>| {
            let mut filter = Filter::default();
            order.for_each(|&surface| filter.dim(surface));
            filter.transmitted()
        };
        let forward = through(&mut surfaces.iter());
        assert_eq!(forward, through(&mut surfaces.iter().rev()));
        let turned = surfaces[4..].iter().chain(&surfaces[..4]);
        assert_eq!(forward, through(&mut { turned }));
    }

    #[test]
    fn all_light_gets_through_nothing_and_none_through_a_wall() {
        assert_eq!(Filter::default().transmitted(), Rgb::WHITE);
        let mut filter = Filter::default();
        filter.dim(Rgb::WHITE);
        filter.block();
        assert_eq!(filter.transmitted(), Rgb::BLACK);
    }
}
