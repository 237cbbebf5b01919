//! What a picture is, without decoding it.

use std::collections::BTreeMap;
use std::path::Path;

use exr::meta::attribute::AttributeValue;
use image::ImageDecoder;
use serde::Serialize;

use super::{exr as exr_file, image_fault, netpbm, texture};
use crate::error::{Fault, FormatError, one_line};
use crate::input::Input;
use crate::limits::Limits;

/// What a picture's header says.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ImageInfo {
    /// "PNG", "JPEG", "TGA", "BMP", "EXR", "PFM" or "PPM".
    pub format: &'static str,
    /// Pixels in a row.
    pub width: u64,
    /// Rows.
    pub height: u64,
    /// The names of its channels.
    pub channels: Vec<String>,
    /// What a number in a channel is, such as "8 bit" or "32 bit float".
    pub sample: String,
    /// What is written beside the pixels: attributes of EXR files, texts of PNG files.
    pub attributes: BTreeMap<String, String>,
}

/// Reads the header of a picture of any format that is read here.
pub(crate) fn image_info(path: &Path) -> Result<ImageInfo, FormatError> {
    let ending = path.extension().unwrap_or_default().to_string_lossy();
    let input = Input::on_disk(path);
    match ending.to_ascii_lowercase().as_str() {
        "exr" => exr_info(&input),
        "pfm" | "ppm" => netpbm_info(&input),
        _ => library_info(&input),
    }
}

fn exr_info(input: &Input<'_>) -> Result<ImageInfo, FormatError> {
    let headers = exr_file::headers(input)?.headers;
    let header = headers
        .first()
        .ok_or_else(|| image_fault("EXR", &"no layer"))?;
    let mut samples: Vec<_> = header.channels.list.iter().map(|c| c.sample_type).collect();
    samples.dedup();
    let sample = |s: &_| match s {
        exr::prelude::SampleType::F16 => "16 bit float",
        exr::prelude::SampleType::F32 => "32 bit float",
        exr::prelude::SampleType::U32 => "32 bit whole",
    };
    let attributes = header
        .all_named_attributes()
        .filter_map(|(name, value)| {
            let name = String::from_utf8_lossy(name).into_owned();
            Some((name, one_line(&attribute(&value)?)))
        })
        .collect();
    Ok(ImageInfo {
        format: "EXR",
        width: header.layer_size.width() as u64,
        height: header.layer_size.height() as u64,
        channels: header
            .channels
            .list
            .iter()
            .map(|c| c.name.to_string())
            .collect(),
        sample: samples.iter().map(sample).collect::<Vec<_>>().join(", "),
        attributes,
    })
}

/// An attribute in words; `None` for those about how the file is laid out.
fn attribute(value: &AttributeValue) -> Option<String> {
    Some(match value {
        AttributeValue::Text(text) => text.to_string(),
        AttributeValue::F64(x) => x.to_string(),
        AttributeValue::F32(x) => x.to_string(),
        AttributeValue::I32(x) => x.to_string(),
        AttributeValue::Compression(compression) => compression.to_string(),
        _ => return None,
    })
}

fn netpbm_info(input: &Input<'_>) -> Result<ImageInfo, FormatError> {
    let limits = Limits {
        image_pixels: u64::MAX,
        ..Limits::default()
    };
    let expected = "\"P6\", \"PF\" or \"Pf\" at the beginning of a PPM or PFM file";
    let (_, header) = netpbm::open(input, &limits, expected, &[b"P6", b"PF", b"Pf"])?;
    let names: &[&str] = if header.magic == *b"Pf" {
        &["Y"]
    } else {
        &["R", "G", "B"]
    };
    let (format, sample) = match header.magic {
        [b'P', b'6'] if header.last.len() > 3 => ("PPM", "16 bit"),
        [b'P', b'6'] => ("PPM", "8 bit"),
        _ => ("PFM", "32 bit float"),
    };
    Ok(ImageInfo {
        format,
        width: header.width.into(),
        height: header.height.into(),
        channels: names.iter().map(|&n| n.to_owned()).collect(),
        sample: sample.to_owned(),
        attributes: BTreeMap::new(),
    })
}

fn library_info(input: &Input<'_>) -> Result<ImageInfo, FormatError> {
    let reader = texture::open(input)?;
    let format = texture::name(&reader);
    if reader.format().is_none() {
        return Err(FormatError::file(Fault::UnknownContent {
            known: "models (obj, ply, stl, gltf, glb) and images (png, jpg, tga, bmp, exr, pfm, ppm)",
        }));
    }
    let decoder = reader.into_decoder().map_err(|e| image_fault(format, &e))?;
    let (width, height) = decoder.dimensions();
    let colour = decoder.color_type();
    let names: &[&str] = match colour.channel_count() {
        1 => &["Y"],
        2 => &["Y", "A"],
        3 => &["R", "G", "B"],
        _ => &["R", "G", "B", "A"],
    };
    let bits = u16::from(colour.bytes_per_pixel()) * 8 / u16::from(colour.channel_count());
    Ok(ImageInfo {
        format,
        width: width.into(),
        height: height.into(),
        channels: names.iter().map(|&n| n.to_owned()).collect(),
        sample: format!("{bits} bit"),
        attributes: if format == "PNG" {
            png_texts(input)?
        } else {
            BTreeMap::new()
        },
    })
}

/// The texts in a PNG file before its pixels.
fn png_texts(input: &Input<'_>) -> Result<BTreeMap<String, String>, FormatError> {
    let reader = png::Decoder::new(input.seekable()?)
        .read_info()
        .map_err(|e| image_fault("PNG", &e))?;
    let info = reader.info();
    let plain = (info.uncompressed_latin1_text.iter()).map(|t| (t.keyword.clone(), t.text.clone()));
    let wide = info
        .utf8_text
        .iter()
        .filter_map(|t| Some((t.keyword.clone(), t.get_text().ok()?)));
    Ok(plain
        .chain(wide)
        .map(|(k, v)| (one_line(&k), one_line(&v)))
        .collect())
}
