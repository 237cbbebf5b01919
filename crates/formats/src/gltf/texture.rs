//! Textures, images and samplers: sections 3.8 and 5.29 of the specification.

use std::borrow::Cow;
use std::collections::HashMap;
use std::path::PathBuf;
use std::sync::Arc;

use ombra_scene::{Filter, Image, PictureTexture, Rgb, UvTransform, Wrap};

use super::buffer::{Buffers, no_such};
use super::document::{Document, SamplerSpec};
use super::notes::Notes;
use super::surface::{TextureTransform, TextureUse};
use super::{Folder, uri, wrong};
use crate::error::{Fault, FormatError};
use crate::finding::Finding;
use crate::image::{mean_of_bytes, texture_of_bytes};
use crate::limits::{Limits, take_pixels};

/// What a pixel takes at most in the file of a picture: four channels of 16 bits.
const BYTES_PER_PIXEL: u64 = 8;

/// What the file of a picture may hold besides its pixels, such as previews and profiles: 16 MiB.
const BYTES_BESIDES: u64 = 16 << 20;

/// Loads textures, each image once.
pub(super) struct Textures<'a> {
    document: &'a Document,
    buffers: &'a Buffers<'a>,
    folder: Folder<'a>,
    /// What is left of it for pictures.
    limits: Limits,
    /// By image, and whether with opacity; `None` for what is not there.
    images: HashMap<(usize, bool), Option<Arc<Image>>>,
    means: HashMap<usize, Option<[f32; 3]>>,
    /// The files that were read.
    pub(super) files: Vec<PathBuf>,
    /// What is missing.
    pub(super) findings: Vec<Finding>,
}

impl<'a> Textures<'a> {
    pub(super) fn new(
        document: &'a Document,
        buffers: &'a Buffers<'a>,
        folder: Folder<'a>,
        limits: &Limits,
    ) -> Self {
        Self {
            document,
            buffers,
            folder,
            limits: limits.clone(),
            images: HashMap::new(),
            means: HashMap::new(),
            files: Vec::new(),
            findings: Vec::new(),
        }
    }

    /// The picture of a texture as a material uses it, with its opacity if asked for; `None`, with a
    /// finding, where the image is not there.
    pub(super) fn picture(
        &mut self,
        spec: &TextureUse,
        with_alpha: bool,
        place: &str,
        notes: &mut Notes,
    ) -> Result<Option<PictureTexture>, FormatError> {
        let Some((index, sampler)) = self.source(spec, place, notes)? else {
            return Ok(None);
        };
        let image = match self.images.get(&(index, with_alpha)) {
            Some(known) => known.clone(),
            None => {
                let image = self.load(index, |bytes, limits| {
                    texture_of_bytes(bytes, with_alpha, limits)
                })?;
                if let Some(image) = &image {
                    take_pixels(&mut self.limits, image.width(), image.height())
                        .map_err(|error| in_image(index, &error))?;
                }
                let image = image.map(Arc::new);
                self.images.insert((index, with_alpha), image.clone());
                image
            }
        };
        let Some(image) = image else {
            return Ok(None);
        };
        let (wrap, filter) = sampling(sampler, place)?;
        let transform = spec.extensions.transform.as_ref();
        Ok(Some(PictureTexture {
            image,
            factor: Rgb::WHITE,
            wrap,
            filter,
            placement: transform
                .map(|transform| placement(transform, place))
                .transpose()?,
        }))
    }

    /// The mean of a texture that holds no colours: its numbers as they are, 0 to 1.
    pub(super) fn mean(
        &mut self,
        spec: &TextureUse,
        place: &str,
        notes: &mut Notes,
    ) -> Result<Option<[f32; 3]>, FormatError> {
        let Some((index, _)) = self.source(spec, place, notes)? else {
            return Ok(None);
        };
        if let Some(known) = self.means.get(&index) {
            return Ok(*known);
        }
        let mean = self.load(index, mean_of_bytes)?;
        self.means.insert(index, mean);
        Ok(mean)
    }

    /// The image and the sampler of a texture; `None`, with a note, if it names none.
    fn source(
        &self,
        spec: &TextureUse,
        place: &str,
        notes: &mut Notes,
    ) -> Result<Option<(usize, Option<&'a SamplerSpec>)>, FormatError> {
        let document = self.document;
        let texture = document.textures.get(spec.index).ok_or_else(|| {
            let count = document.textures.len();
            wrong(
                format!("{place}.index"),
                no_such("textures", spec.index, count),
            )
        })?;
        let at = || format!("textures[{}]", spec.index);
        let sampler = match texture.sampler {
            None => None,
            Some(index) => Some(document.samplers.get(index).ok_or_else(|| {
                let count = document.samplers.len();
                wrong(at(), no_such("samplers", index, count))
            })?),
        };
        let Some(source) = texture.source else {
            notes.add(at(), "has no image that can be read: plain colour used");
            return Ok(None);
        };
        if source >= document.images.len() {
            let count = document.images.len();
            return Err(wrong(at(), no_such("images", source, count)));
        }
        Ok(Some((source, sampler)))
    }

    /// Decodes an image; `None`, with a finding, if it is a file that is not there.
    fn load<T>(
        &mut self,
        index: usize,
        decode: impl Fn(&[u8], &Limits) -> Result<T, FormatError>,
    ) -> Result<Option<T>, FormatError> {
        let spec = &self.document.images[index];
        let place = || format!("images[{index}]");
        let bytes: Cow<'_, [u8]> = match (&spec.uri, spec.buffer_view) {
            (_, Some(view)) => {
                let user = format!("{}.bufferView", place());
                self.buffers.view(self.document, view, &user)?.bytes.into()
            }
            (Some(uri), None) => match uri::data(uri) {
                Some(data) => data
                    .map_err(|error| wrong(format!("{}.uri", place()), error))?
                    .into(),
                None => return self.load_file(index, uri, decode),
            },
            (None, None) => {
                let message = "has neither a uri nor a bufferView; one of them is right";
                return Err(wrong(place(), message));
            }
        };
        let decoded = decode(&bytes, &self.limits);
        decoded.map(Some).map_err(|error| in_image(index, &error))
    }

    /// From a file of at most [`BYTES_PER_PIXEL`] for each pixel that is allowed, and
    /// [`BYTES_BESIDES`].
    fn load_file<T>(
        &mut self,
        index: usize,
        uri: &str,
        decode: impl Fn(&[u8], &Limits) -> Result<T, FormatError>,
    ) -> Result<Option<T>, FormatError> {
        const TEXTURE: &str = "texture";
        let found = match self.folder {
            Folder::Open(folder) => uri::file(folder, uri, TEXTURE),
            Folder::None => Err(Finding::MissingFile {
                what: TEXTURE,
                name: uri::file_name(uri),
            }),
        };
        match found {
            Ok(path) => {
                let pixels = self.limits.image_pixels.saturating_mul(BYTES_PER_PIXEL);
                let most = pixels.saturating_add(BYTES_BESIDES);
                let bytes = uri::read(&path, most.saturating_add(1))?;
                if bytes.len() as u64 > most {
                    let name = uri::file_name(uri);
                    let message =
                        format!("\"{name}\" has more than {most} bytes, the most for a picture");
                    return Err(wrong(format!("images[{index}].uri"), message));
                }
                let decoded = decode(&bytes, &self.limits).map_err(|e| e.in_file(&path))?;
                if !self.files.contains(&path) {
                    self.files.push(path);
                }
                Ok(Some(decoded))
            }
            Err(finding) => {
                if !self.findings.contains(&finding) {
                    self.findings.push(finding);
                }
                Ok(None)
            }
        }
    }
}

/// An error of a decoder, at the image that it is about.
fn in_image(index: usize, error: &FormatError) -> FormatError {
    let fault: &Fault = error.fault();
    wrong(format!("images[{index}]"), fault.to_string())
}

fn sampling(
    sampler: Option<&SamplerSpec>,
    place: &str,
) -> Result<([Wrap; 2], Filter), FormatError> {
    let Some(sampler) = sampler else {
        return Ok(([Wrap::Repeat; 2], Filter::Linear));
    };
    let wrap = |code, name| match code {
        None | Some(10497) => Ok(Wrap::Repeat),
        Some(33071) => Ok(Wrap::Clamp),
        Some(33648) => Ok(Wrap::Mirror),
        Some(code) => Err(wrong(
            format!("{place}: {name} of its sampler"),
            format!("is {code}; 10497 (repeat), 33071 (clamp) or 33648 (mirror) is right"),
        )),
    };
    let filter = match sampler.mag_filter {
        None | Some(9729) => Filter::Linear,
        Some(9728) => Filter::Nearest,
        Some(code) => {
            let message = format!("is {code}; 9728 (nearest) or 9729 (linear) is right");
            return Err(wrong(format!("{place}: magFilter of its sampler"), message));
        }
    };
    let wraps = [
        wrap(sampler.wrap_s, "wrapS")?,
        wrap(sampler.wrap_t, "wrapT")?,
    ];
    Ok((wraps, filter))
}

/// `KHR_texture_transform`: first the scale, then the rotation, which takes (1, 0) to
/// (cos, −sin), then the offset, in coordinates whose v runs downward; here it runs upward.
fn placement(transform: &TextureTransform, place: &str) -> Result<UvTransform, FormatError> {
    let ([ox, oy], [sx, sy]) = (transform.offset, transform.scale);
    let (sin, cos) = transform.rotation.sin_cos();
    let rows = [
        [cos * sx, -sin * sy, sin * sy + ox],
        [sin * sx, cos * sy, 1.0 - cos * sy - oy],
    ];
    if rows.iter().flatten().all(|x| x.is_finite()) {
        Ok(UvTransform(rows))
    } else {
        let message = "has a number that is not finite";
        Err(wrong(
            format!("{place}.extensions.KHR_texture_transform"),
            message,
        ))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_texture_is_moved_turned_and_scaled_as_the_extension_says() {
        let transform = |json: &str| {
            let transform = serde_json::from_str(json).unwrap();
            let map = placement(&transform, "").unwrap();
            // There and back: v of the file runs downward.
            move |[u, v]: [f32; 2]| {
                let [u, v] = map.apply([u, 1.0 - v]);
                [u, 1.0 - v]
            }
        };
        let close = |a: [f32; 2], b: [f32; 2]| {
            assert!(
                (a[0] - b[0]).abs() < 1e-6 && (a[1] - b[1]).abs() < 1e-6,
                "{a:?} {b:?}"
            );
        };
        close(transform("{}")([0.3, 0.8]), [0.3, 0.8]);
        close(
            transform(r#"{"offset": [0.5, 0.25]}"#)([0.1, 0.2]),
            [0.6, 0.45],
        );
        close(transform(r#"{"scale": [2, 3]}"#)([0.1, 0.2]), [0.2, 0.6]);
        let quarter = std::f32::consts::FRAC_PI_2;
        let turned = transform(&format!(r#"{{"rotation": {quarter}, "scale": [2, 1]}}"#));
        close(turned([1.0, 0.0]), [0.0, -2.0]);
        close(turned([0.0, 1.0]), [1.0, 0.0]);
    }
}
