//! Shadow rays: how much of a light gets through.

use ombra_geometry::InstanceId;
use ombra_pipeline::RayType;
use ombra_scene::Rgb;
use ombra_scene::light::LightSample;

/// The rays from a place to a light.
pub(super) enum Shadow {}

impl RayType for Shadow {
    type Payload = Shade;
    const NAME: &'static str = "shadow";
}

/// What the surfaces on the way to a light leave of it.
#[derive(Clone, Debug, Default)]
pub(super) struct Shade {
    /// The object that must be met first, if the light is one of an object.
    object: Option<InstanceId>,
    blocked: bool,
    /// One for each transparent surface, in the order of the traversal. That order differs between
    /// structures and a product of rounded factors depends on it, so they are multiplied in the end.
    transmissions: Vec<Rgb>,
}

impl Shade {
    /// Nothing is on the way yet.
    #[inline]
    pub(super) fn of(light: &LightSample) -> Self {
        Self {
            object: light.object,
            ..Self::default()
        }
    }

    /// Whether it matters what is met first, and not what is on the way.
    #[inline]
    pub(super) const fn looks_for_object(&self) -> bool {
        self.object.is_some()
    }

    /// What was met first, or that nothing was.
    #[inline]
    pub(super) fn met(&mut self, first: Option<InstanceId>) {
        if self.object.is_some() && self.object != first {
            self.block();
        }
    }

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
            let mut shade = Shade::default();
            order.for_each(|&surface| shade.dim(surface));
            shade.transmitted()
        };
        let forward = through(&mut surfaces.iter());
        assert_eq!(forward, through(&mut surfaces.iter().rev()));
        let turned = surfaces[4..].iter().chain(&surfaces[..4]);
        assert_eq!(forward, through(&mut { turned }));
    }

    #[test]
    fn all_light_gets_through_nothing_and_none_through_a_wall() {
        assert_eq!(Shade::default().transmitted(), Rgb::WHITE);
        let mut shade = Shade::default();
        shade.dim(Rgb::WHITE);
        shade.block();
        assert_eq!(shade.transmitted(), Rgb::BLACK);
    }

    #[test]
    fn the_light_of_an_object_is_hidden_by_whatever_is_met_before() {
        let toward = |first| {
            let mut shade = Shade {
                object: Some(InstanceId(2)),
                ..Shade::default()
            };
            shade.met(first);
            shade.transmitted()
        };
        assert_eq!(toward(Some(InstanceId(2))), Rgb::WHITE);
        assert_eq!(toward(Some(InstanceId(1))), Rgb::BLACK);
        assert_eq!(toward(None), Rgb::BLACK);
    }
}
