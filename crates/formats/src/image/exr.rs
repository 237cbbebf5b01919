//! OpenEXR (Academy Software Foundation, "OpenEXR File Layout"): 32-bit floating-point numbers,
//! linear, with all channels, compressed without loss.

use std::io::{Cursor, Write};

use exr::meta::MetaData;
use exr::meta::attribute::{AttributeValue, Text};
use exr::prelude::{
    AnyChannel, AnyChannels, Compression, Encoding, FlatSamples, Layer, LayerAttributes,
    ReadChannels, ReadLayers, SmallVec, WritableImage,
};
use ombra_scene::Rgb;

use super::write::write_error;
use super::{ImageBuffer, Metadata, check_size, image_fault};
use crate::error::{Fault, FormatError};
use crate::input::Input;
use crate::limits::Limits;

const NAME: &str = "EXR";

pub(super) fn write(
    file: &mut impl Write,
    image: &ImageBuffer,
    metadata: &Metadata,
) -> Result<(), FormatError> {
    let component = |pick: fn(&Rgb) -> f32| image.pixels().iter().map(pick).collect();
    let channel = |name: &str, values| AnyChannel::new(text(name), FlatSamples::F32(values));
    let mut channels: SmallVec<[_; 4]> = SmallVec::new();
    channels.push(channel("R", component(|p| p.r)));
    channels.push(channel("G", component(|p| p.g)));
    channels.push(channel("B", component(|p| p.b)));
    for extra in image.channels() {
        channels.push(channel(&extra.name, extra.values.clone()));
    }
    let layer = Layer::new(
        (image.width() as usize, image.height() as usize),
        LayerAttributes::default(),
        Encoding {
            compression: Compression::ZIP16,
            ..Encoding::FAST_LOSSLESS
        },
        AnyChannels::sort(channels),
    );
    let mut picture = exr::image::Image::from_layer(layer);
    for (name, value) in metadata.entries() {
        let value = match (name, metadata.seconds) {
            ("seconds", Some(seconds)) => AttributeValue::F64(seconds),
            _ => AttributeValue::Text(text(&value)),
        };
        // Names without a prefix are the standard's own.
        let name = text(&format!("ombra.{name}"));
        picture.attributes.other.insert(name, value);
    }
    let mut bytes = Vec::new();
    (picture.write().non_parallel())
        .to_buffered(Cursor::new(&mut bytes))
        .map_err(|e| image_fault(NAME, &e))?;
    sort_attributes(&mut bytes);
    file.write_all(&bytes).map_err(write_error)
}

/// The library writes Latin-1 and nothing else: other characters are escaped.
fn text(text: &str) -> Text {
    let latin = |c: char| c != '\0' && u32::from(c) <= 0xff;
    let mut escaped = String::with_capacity(text.len());
    for c in text.chars() {
        if latin(c) {
            escaped.push(c);
        } else {
            escaped.extend(c.escape_unicode());
        }
    }
    Text::new_or_none(&escaped).unwrap_or_default()
}

/// Puts the attributes of the header into the order of their names: the library keeps them in a
/// table of random order, and the same picture should be the same bytes.
fn sort_attributes(bytes: &mut [u8]) {
    const START: usize = 8; // after the magic number and the version
    let mut attributes = Vec::new();
    let mut at = START;
    while let Some(length) = attribute_length(&bytes[at..]) {
        attributes.push(bytes[at..at + length].to_vec());
        at += length;
    }
    attributes.sort_unstable();
    bytes[START..at].copy_from_slice(&attributes.concat());
}

/// The length of the attribute at the start: name, 0, type, 0, size in four bytes, value. `None`
/// at the end of the header, where the name is empty.
fn attribute_length(bytes: &[u8]) -> Option<usize> {
    let text_end = |from: usize| bytes[from..].iter().position(|&b| b == 0).map(|n| from + n);
    let name_end = text_end(0).filter(|&end| end > 0)?;
    let type_end = text_end(name_end + 1)?;
    let size = bytes.get(type_end + 1..)?.first_chunk()?;
    let length = type_end + 5 + u32::from_le_bytes(*size) as usize;
    (length <= bytes.len()).then_some(length)
}

/// The headers, without any pixels.
pub(super) fn headers(input: &Input<'_>) -> Result<MetaData, FormatError> {
    MetaData::read_from_buffered(input.seekable()?, false).map_err(|e| image_fault(NAME, &e))
}

/// Reads the first layer. Without red, green and blue it is grey by its channel "Y", or else black
/// with further channels.
pub(super) fn read(input: &Input<'_>, limits: &Limits) -> Result<ImageBuffer, FormatError> {
    for header in &headers(input)?.headers {
        let (width, height) = (header.layer_size.width(), header.layer_size.height());
        check_size(width as u64, height as u64, limits)?;
        let limit = limits.image_pixels.saturating_mul(32);
        let channels = header.channels.list.len() as u64;
        if (width as u64 * height as u64).saturating_mul(channels * 4) > limit {
            let what = "all channels together";
            return Err(FormatError::file(Fault::TooLarge { what, limit }));
        }
    }
    let picture = exr::prelude::read()
        .no_deep_data()
        .largest_resolution_level()
        .all_channels()
        .first_valid_layer()
        .all_attributes()
        .non_parallel()
        .from_buffered(input.seekable()?)
        .map_err(|e| image_fault(NAME, &e))?;
    let layer = picture.layer_data;
    let (width, height) = (layer.size.width() as u32, layer.size.height() as u32);
    let mut channels: Vec<(String, Vec<f32>)> = (layer.channel_data.list.into_iter())
        .map(|c| (c.name.to_string(), c.sample_data.values_as_f32().collect()))
        .collect();
    let mut take = |name: &str| {
        let found = channels.iter().position(|c| c.0 == name)?;
        Some(channels.remove(found).1)
    };
    let pixels = match (take("R"), take("G"), take("B")) {
        (Some(r), Some(g), Some(b)) => {
            let rgb = r.iter().zip(&g).zip(&b);
            rgb.map(|((&r, &g), &b)| Rgb::new(r, g, b)).collect()
        }
        (r, g, b) => {
            let grey = take("Y").or(r).or(g).or(b).unwrap_or_default();
            let mut pixels: Vec<_> = grey.into_iter().map(Rgb::grey).collect();
            pixels.resize(width as usize * height as usize, Rgb::BLACK);
            pixels
        }
    };
    let image = ImageBuffer::new(width, height, pixels)?;
    channels
        .into_iter()
        .try_fold(image, |image, (name, values)| {
            image.with_channel(name, values)
        })
}
