//! One material as its file gives it, and what Whitted's ray tracer makes of it.

use ombra_scene::{Material, Rgb};

use crate::error::{Fault, quoted};
use crate::number::{Words, finite, finite_row, whole};

/// The statements of one material that are used; `None` where it has none.
///
/// `Ka` is read and dropped: in a scene ambient light is scattered by the diffuse colour.
#[derive(Debug, Default)]
pub(super) struct Definition {
    diffuse: Option<Rgb>,
    specular: Option<Rgb>,
    emission: Option<Rgb>,
    shininess: Option<f32>,
    index_of_refraction: Option<f32>,
    /// 1 is opaque.
    opacity: Option<f32>,
    filter: Option<Rgb>,
    model: Option<i64>,
    texture: Option<String>,
    unused_map_options: Vec<String>,
}

impl Definition {
    /// Takes a statement in; false if it is not one of those used.
    pub(super) fn set(&mut self, keyword: &[u8], mut words: Words<'_>) -> Result<bool, Fault> {
        let words = &mut words;
        match keyword {
            b"Ka" => drop(colour(words, "Ka")?),
            b"Kd" => self.diffuse = colour(words, "Kd")?.or(self.diffuse),
            b"Ks" => self.specular = colour(words, "Ks")?.or(self.specular),
            b"Ke" => self.emission = colour(words, "Ke")?.or(self.emission),
            b"Tf" => self.filter = colour(words, "Tf")?.or(self.filter),
            b"Ns" => self.shininess = Some(number(words, "Ns", 0.0)?),
            b"Ni" => self.index_of_refraction = Some(number(words, "Ni", 1e-3)?),
            b"d" => {
                // "-halo" makes the edge more opaque than the middle; the middle is used.
                if words.0.trim_ascii_start().starts_with(b"-halo") {
                    words.next();
                }
                self.opacity = Some(number(words, "d", 0.0)?.min(1.0));
            }
            b"Tr" => self.opacity = Some(1.0 - number(words, "Tr", 0.0)?.min(1.0)),
            b"illum" => self.model = Some(illumination(words)?),
            b"map_Kd" => self.read_map(words),
            _ => return Ok(false),
        }
        Ok(true)
    }

    /// The file that holds the diffuse colour.
    pub(super) fn texture(&self) -> Option<&str> {
        self.texture.as_deref()
    }

    pub(super) fn unused_map_options(&self) -> &[String] {
        &self.unused_map_options
    }

    /// A map is any number of options with their values, and a name that may hold blanks.
    fn read_map(&mut self, words: &mut Words<'_>) {
        loop {
            let rest = words.0.trim_ascii();
            let mut ahead = Words(rest);
            let values = match ahead.next() {
                Some(b"-o" | b"-s" | b"-t") => 1..=3,
                Some(b"-mm") => 2..=2,
                Some(
                    b"-blendu" | b"-blendv" | b"-cc" | b"-clamp" | b"-imfchan" | b"-texres"
                    | b"-bm" | b"-boost" | b"-type",
                ) => 1..=1,
                _ => {
                    if !rest.is_empty() {
                        self.texture = Some(String::from_utf8_lossy(rest).into_owned());
                    }
                    return;
                }
            };
            let option = words.next().unwrap_or_default();
            let option = String::from_utf8_lossy(option).into_owned();
            if !self.unused_map_options.contains(&option) {
                self.unused_map_options.push(option);
            }
            for taken in 0..*values.end() {
                // Values past the least number are there only if they are numbers.
                let next = Words(words.0).next().unwrap_or_default();
                if taken >= *values.start() && finite(next, "").is_err() {
                    break;
                }
                words.next();
            }
        }
    }

    /// The material after `illum`: 0 and 1 are diffuse, 2 adds Phong's highlight, 3 reflects by Ks,
    /// 4 is glass (refraction by Ni, with Fresnel's law), 5 a mirror with Fresnel's law,
    /// 6 refraction by Ni without Fresnel's law (and what Tf leaves of Ks as a mirror) and 7 with it; 8 is as 2, 9 as 4, 10 as 0. Without
    /// `illum` a Ks makes it 2, and nothing makes it 1.
    ///
    /// Where the model is not transparent, `d` below 1 lets light through unbent.
    pub(super) fn material(&self, name: &str) -> Material {
        let highlight = self.specular.unwrap_or(Rgb::BLACK);
        let assumed = if highlight.is_black() { 1 } else { 2 };
        let model = self.model.unwrap_or(assumed);
        let opacity = self.opacity.unwrap_or(1.0);
        let grey = |value| Rgb::grey(value);
        let filter = self.filter.filter(|f| !f.is_black());
        let through = match (filter, self.opacity) {
            (Some(filter), _) => filter,
            (None, Some(opacity)) if opacity < 1.0 => grey(1.0 - opacity),
            _ => Rgb::WHITE,
        };
        let mirrored = self.specular.unwrap_or(Rgb::WHITE);
        let transparent = matches!(model, 4 | 6 | 7 | 9);
        let plain = Material::default();
        let diffuse = self
            .diffuse
            .map_or_else(|| plain.diffuse.clone(), |kd| (kd * opacity).into());
        Material {
            name: name.to_owned(),
            diffuse,
            specular: match model {
                0 | 1 | 10 => Rgb::BLACK,
                _ => highlight,
            },
            // An exponent below 1 would spread the highlight over all that faces the light.
            shininess: self.shininess.map_or(plain.shininess, |ns| ns.max(1.0)),
            reflection: match model {
                3 | 5 => mirrored,
                // A surface cannot send on more light than it gets: through it goes first.
                6 => at_most(highlight, Rgb::WHITE, through),
                // With Fresnel's law what does not go through is the reflection.
                _ => Rgb::BLACK,
            },
            transmission: if transparent {
                through
            } else {
                grey(1.0 - opacity)
            },
            index_of_refraction: if transparent || model == 5 {
                self.index_of_refraction.unwrap_or(1.5)
            } else {
                1.0
            },
            fresnel: matches!(model, 4 | 5 | 7 | 9),
            internal_reflection: plain.internal_reflection,
            emission: self.emission.unwrap_or(Rgb::BLACK),
            ..plain
        }
    }
}

/// A colour, but no more of each component than `whole` leaves beside `taken`.
fn at_most(colour: Rgb, whole: Rgb, taken: Rgb) -> Rgb {
    let [colour, whole, taken] = [colour, whole, taken].map(Rgb::to_array);
    std::array::from_fn(|i| colour[i].min((whole[i] - taken[i]).max(0.0))).into()
}

/// A colour of one or three components; `None` for spectral files and CIE XYZ, which are not used.
fn colour(words: &mut Words<'_>, what: &'static str) -> Result<Option<Rgb>, Fault> {
    let first = Words(words.0).next();
    if matches!(first, Some(b"spectral" | b"xyz")) {
        return Ok(None);
    }
    let [r] = finite_row::<1>(words, what)?;
    let rgb = if Words(words.0).next().is_none_or(|w| w.starts_with(b"#")) {
        [r; 3]
    } else {
        let [g, b] = finite_row::<2>(words, what)?;
        [r, g, b]
    };
    Ok(Some(rgb.map(|x| x.max(0.0)).into()))
}

fn number(words: &mut Words<'_>, what: &'static str, least: f32) -> Result<f32, Fault> {
    let [number] = finite_row::<1>(words, what)?;
    Ok(number.max(least))
}

fn illumination(words: &mut Words<'_>) -> Result<i64, Fault> {
    let word = words.next().unwrap_or_default();
    match whole(word, "illum")? {
        model @ 0..=10 => Ok(model),
        _ => Err(Fault::Unexpected {
            found: quoted(word),
            expected: "an illumination model from 0 to 10",
        }),
    }
}
