//! That a tree adds up.

use ombra_scene::Rgb;

use super::tree::{End, LightWay, Part, SampleTree};

impl SampleTree {
    /// What a ray brings according to its parts and its children, in the order in which it was added
    /// up: its emission, plus the ambient part with the light of each light, plus what is seen through
    /// the surface and then in the mirror, and of all that what the way left. To the last bit its `radiance`, unless that was not made of
    /// parts: the background, what is seen beyond the last bounce, and how much of a light gets
    /// through.
    ///
    /// # Panics
    /// When there is no such ray.
    #[must_use]
    pub fn adds_up_to(&self, ray: usize) -> Rgb {
        let record = &self.rays[ray];
        if record.end != End::Surface {
            return record.radiance;
        }
        let mut emission = Rgb::BLACK;
        let mut local = Rgb::BLACK;
        for part in &record.parts {
            match part {
                // Nothing but what was measured.
                Part::Measured(measured) => return *measured,
                Part::Emission(light) => emission = *light,
                Part::Ambient(light) => local = *light,
                Part::Light(light) => {
                    if let LightWay::Ray(shadow) = light.way {
                        local += self.brings(shadow);
                    }
                }
            }
        }
        let mut bounced = Rgb::BLACK;
        for child in self.children(ray) {
            let is_part = record.parts.iter().any(
                |part| matches!(part, Part::Light(light) if light.way == LightWay::Ray(child)),
            );
            if !is_part {
                bounced += self.brings(child);
            }
        }
        let sum = emission + local + bounced;
        match record.absorbed {
            Some(absorbed) => sum * absorbed.left,
            None => sum,
        }
    }

    /// What a ray brings to the one that sent it.
    fn brings(&self, ray: usize) -> Rgb {
        self.rays[ray].weight * self.rays[ray].radiance
    }
}
