//! From what a film holds to what is shown or written.

mod colour_map;
mod digits;
mod legend;
mod response;

use ombra_scene::Rgb;

use crate::film::{Film, Pixel};

pub use colour_map::heat;
use legend::Scale;
pub use response::{Response, Transfer};

/// What the pixels of a film mean, and so how they are shown (`display`) and written into files of
/// floating-point numbers (`raw`).
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Quantity {
    /// Linear light: shown and written as the film answers to it.
    Light(Response),
    /// Unit normals n as (n + 1) / 2, black where nothing was hit: written as they are, and shown so
    /// that an eight-bit file holds these numbers and not their sRGB encoding.
    Normal,
    /// Distances along camera rays in units of the scene. The film holds in red the mean over all
    /// samples, 0 where one hit nothing, and in green the share of samples that hit.
    ///
    /// Written as the mean distance of those that hit, in all three components, infinite where none
    /// did. Shown as a grey that falls evenly to the eye from white at `near` to dark at `far`, and
    /// black where nothing was hit.
    Distance {
        /// The nearest point of the scene's finite bounds.
        near: f32,
        /// The farthest.
        far: f32,
    },
    /// Traversal steps of camera rays: nodes visited in red, tests made in green, their sum in blue.
    /// Written as they are; shown as a heat map of the sum ([`heat`]), with a legend if there is
    /// room for one.
    Steps,
}

/// How bright the far end of distances is, as encoded for a screen: still not black.
const FAR_GREY: f32 = 0.1;

/// The share of pixels that the scale of steps is to cover: what a few grazing rays cost must not
/// make the rest of the picture one colour.
const COVERED: f64 = 0.998;

pub(crate) fn to_raw(film: &Film) -> Vec<Rgb> {
    match film.quantity() {
        Quantity::Light(response) => developed(film, |light| response.exposed(light)),
        Quantity::Normal | Quantity::Steps => film.to_pixels(),
        Quantity::Distance { .. } => {
            let pixels = film.pixels().iter();
            pixels
                .map(|pixel| Rgb::grey(distance(pixel).unwrap_or(f32::INFINITY)))
                .collect()
        }
    }
}

pub(crate) fn to_display(film: &Film) -> Vec<Rgb> {
    match film.quantity() {
        Quantity::Light(response) => developed(film, |light| response.shown(light)),
        Quantity::Normal => film
            .to_pixels()
            .into_iter()
            .map(|n| Rgb::from_srgb(n.to_array()))
            .collect(),
        Quantity::Distance { near, far } => film
            .pixels()
            .iter()
            .map(|pixel| distance(pixel).map_or(Rgb::BLACK, |d| distance_grey(d, near, far)))
            .collect(),
        Quantity::Steps => steps(film),
    }
}

/// What becomes of the light in each pixel; black where there are no samples yet.
fn developed(film: &Film, of: impl Fn(Rgb) -> Rgb) -> Vec<Rgb> {
    let pixels = film.pixels().iter();
    pixels
        .map(|pixel| pixel.average().map_or(Rgb::BLACK, &of))
        .collect()
}

/// The mean distance of the samples that hit something; `None` if none did.
fn distance(pixel: &Pixel) -> Option<f32> {
    let mean = pixel.average()?;
    (mean.g > 0.0).then(|| mean.r / mean.g)
}

fn distance_grey(distance: f32, near: f32, far: f32) -> Rgb {
    let way = (distance - near) / (far - near);
    // Where near and far are the same everything is at hand.
    let way = if way.is_nan() {
        0.0
    } else {
        way.clamp(0.0, 1.0)
    };
    Rgb::from_srgb([1.0 - (1.0 - FAR_GREY) * way; 3])
}

fn steps(film: &Film) -> Vec<Rgb> {
    let counts: Vec<f32> = film.to_pixels().iter().map(|mean| mean.b).collect();
    let scale = Scale::covering(&counts, COVERED);
    let mut pixels: Vec<Rgb> = film
        .pixels()
        .iter()
        .zip(&counts)
        .map(|(pixel, &count)| {
            if pixel.samples() == 0 {
                Rgb::BLACK
            } else {
                heat(count / scale.top)
            }
        })
        .collect();
    legend::draw(&mut pixels, film.width(), film.height(), &scale);
    pixels
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::film::Crop;

    fn film(quantity: Quantity, samples: &[Rgb]) -> Film {
        let mut film = Film::new([1, 1], Crop::all(1, 1), samples.len() as u32, quantity).unwrap();
        samples.iter().for_each(|&s| film.pixels_mut()[0].add(s));
        film
    }

    const RANGE: Quantity = Quantity::Distance {
        near: 1.0,
        far: 5.0,
    };

    #[test]
    fn a_distance_is_the_mean_over_the_samples_that_hit() {
        let hit = |d| Rgb::new(d, 1.0, 0.0);
        let film = film(RANGE, &[hit(2.0), Rgb::BLACK, hit(4.0), Rgb::BLACK]);
        assert_eq!(film.raw(), [Rgb::grey(3.0)]);
        let [shown] = film.display()[..] else {
            panic!("one pixel")
        };
        assert!(
            (shown.to_srgb()[0] - 0.55).abs() < 1e-6,
            "half way from 1 to 0.1"
        );
    }

    #[test]
    fn where_nothing_was_hit_the_distance_is_infinite_and_black() {
        let film = film(RANGE, &[Rgb::BLACK]);
        assert_eq!(film.raw(), [Rgb::grey(f32::INFINITY)]);
        assert_eq!(film.display(), [Rgb::BLACK]);
    }

    #[test]
    fn distances_without_a_range_can_be_shown() {
        let flat = Quantity::Distance {
            near: 2.0,
            far: 2.0,
        };
        let film = film(flat, &[Rgb::new(2.0, 1.0, 0.0)]);
        assert_eq!(film.display(), [Rgb::WHITE]);
    }

    #[test]
    fn eight_bit_normals_are_what_other_programs_expect() {
        let film = film(Quantity::Normal, &[Rgb::new(0.5, 0.5, 1.0)]);
        let shown = film.display()[0].to_srgb();
        assert!((shown[0] - 0.5).abs() < 1e-6 && (shown[2] - 1.0).abs() < 1e-6);
    }
}
