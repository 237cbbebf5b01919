//! The numbers of a raster.

use std::io::Cursor;

use tiff::decoder::{ChunkType, Decoder, DecodingResult};
use tiff::tags::{CompressionMethod, Tag};

use super::{broken, wrong};
use crate::error::{Fault, FormatError, shown};
use crate::limits::Limits;

/// A strip or tile may unpack to so many bytes.
pub(super) const LARGEST_CHUNK: u64 = 2 << 30;

/// How the numbers of a raster lie in its file.
#[derive(Clone, Debug)]
pub(super) struct Pixels {
    /// Columns and rows.
    pub(super) size: [u32; 2],
    /// Of a strip or tile: columns and rows.
    chunk: [u32; 2],
    pub(super) kind: ChunkType,
    /// "32-bit floating-point numbers".
    pub(super) sample: String,
    pub(super) compression: String,
    /// The number that stands for none.
    pub(super) no_data: Option<f64>,
    /// How many bytes each strip or tile takes.
    lengths: Vec<u64>,
}

impl Pixels {
    /// As the first image of a file has them; nothing is unpacked yet.
    pub(super) fn of(
        decoder: &mut Decoder<Cursor<&[u8]>>,
        file: u64,
        limits: &Limits,
    ) -> Result<Self, FormatError> {
        let (width, height) = decoder.dimensions().map_err(broken)?;
        let limit = limits.raster_pixels;
        let [wide, high] = [width, height].map(u64::from);
        if wide * high > limit {
            return Err(FormatError::file(Fault::ImageTooLarge {
                width: wide,
                height: high,
                limit,
            }));
        }
        let mut number = |tag, otherwise: u64| {
            let found = decoder.find_tag_unsigned::<u64>(tag).map_err(broken)?;
            Ok::<u64, FormatError>(found.unwrap_or(otherwise))
        };
        let bands = number(Tag::SamplesPerPixel, 1)?;
        if bands != 1 {
            return Err(wrong(format!(
                "has {bands} bands; a surface or terrain model has one, its heights"
            )));
        }
        let packing = number(Tag::Compression, 1)?;
        let bits = number(Tag::BitsPerSample, 1)?;
        let sample = match number(Tag::SampleFormat, 1)? {
            1 => format!("{bits}-bit unsigned integers"),
            2 => format!("{bits}-bit integers"),
            3 => format!("{bits}-bit floating-point numbers"),
            other => return Err(wrong(format!("sample format {other} is no kind of number"))),
        };
        let (compression, most) = compression(packing)?;
        let kind = decoder.get_chunk_type();
        let [offsets, lengths] = match kind {
            ChunkType::Strip => [Tag::StripOffsets, Tag::StripByteCounts],
            ChunkType::Tile => [Tag::TileOffsets, Tag::TileByteCounts],
        }
        .map(|tag| decoder.get_tag_u64_vec(tag).map_err(broken));
        let (offsets, lengths) = (offsets?, lengths?);
        let (across, down) = decoder.chunk_dimensions();
        let pixels = Self {
            size: [width, height],
            chunk: [across, down],
            kind,
            sample,
            compression: compression.to_owned(),
            no_data: no_data(decoder),
            lengths,
        };
        pixels.check(&offsets, file, most, bits)?;
        Ok(pixels)
    }

    /// That all strips or tiles are there, lie in the file and can hold what they are to hold, if one unpacks to
    /// `most` times its size.
    fn check(&self, offsets: &[u64], file: u64, most: u64, bits: u64) -> Result<(), FormatError> {
        let name = self.name();
        let [across, down] = self.chunks();
        let count = across * down;
        if (offsets.len() as u64, self.lengths.len() as u64) != (count, count) {
            return Err(wrong(format!(
                "{count} {name}s are needed, but {} places and {} lengths are given",
                offsets.len(),
                self.lengths.len()
            )));
        }
        for (index, (&offset, &length)) in offsets.iter().zip(&self.lengths).enumerate() {
            let end = offset.saturating_add(length);
            if length > 0 && end > file {
                return Err(wrong(format!(
                    "the file is cut off: {name} {index} of {count} would end at byte {end}, and the file has \
                     {file} bytes"
                )));
            }
            let [width, height] = self.data_of(index as u64).map(u64::from);
            let needed = width * height * bits.div_ceil(8);
            if needed > LARGEST_CHUNK {
                return Err(wrong(format!(
                    "{name} {index} would take {needed} bytes, over the limit of {LARGEST_CHUNK}"
                )));
            }
            if length > 0 && needed > length.saturating_mul(most) {
                return Err(wrong(format!(
                    "{name} {index} has {length} bytes, which cannot hold its {needed}"
                )));
            }
        }
        Ok(())
    }

    /// How many strips or tiles lie beside and below one another.
    fn chunks(&self) -> [u64; 2] {
        [0, 1].map(|k| u64::from(self.size[k].div_ceil(self.chunk[k].max(1))))
    }

    /// Columns and rows of a strip or tile that lie in the image.
    fn data_of(&self, index: u64) -> [u32; 2] {
        let [across, _] = self.chunks();
        let at = [index % across, index / across];
        [0, 1].map(|k| {
            let before = at[k] as u32 * self.chunk[k];
            self.chunk[k].min(self.size[k].saturating_sub(before))
        })
    }

    pub(super) const fn name(&self) -> &'static str {
        match self.kind {
            ChunkType::Strip => "strip",
            ChunkType::Tile => "tile",
        }
    }

    /// All numbers, row by row; NaN where there is none. Memory grows with what has been unpacked.
    pub(super) fn decode(
        &self,
        decoder: &mut Decoder<Cursor<&[u8]>>,
    ) -> Result<Vec<f32>, FormatError> {
        let mut unpacked = Vec::new();
        let width = self.size[0] as usize;
        let [across, down] = self.chunks();
        for row in 0..down {
            let [_, height] = self.data_of(row * across);
            let start = unpacked.len();
            unpacked.resize(start + width * height as usize, f32::NAN);
            for column in 0..across {
                let index = row * across + column;
                // A writer leaves out what has no data.
                if self.lengths[index as usize] == 0 {
                    continue;
                }
                let [own_width, own_height] = self.data_of(index).map(|n| n as usize);
                let chunk = decoder.read_chunk(index as u32).map_err(|error| {
                    let name = self.name();
                    wrong(format!("{name} {index}: {}", shown(&error.to_string())))
                })?;
                let numbers = self.numbers(chunk)?;
                let left = column as usize * self.chunk[0] as usize;
                let rows = numbers.chunks_exact(own_width).take(own_height);
                if rows.len() < own_height {
                    let name = self.name();
                    return Err(wrong(format!("{name} {index} has too few numbers")));
                }
                for (k, numbers) in rows.enumerate() {
                    let at = start + k * width + left;
                    unpacked[at..at + own_width].copy_from_slice(numbers);
                }
            }
        }
        Ok(unpacked)
    }

    fn numbers(&self, chunk: DecodingResult) -> Result<Vec<f32>, FormatError> {
        macro_rules! widened {
            ($numbers:expr) => {
                ($numbers.into_iter())
                    .map(|z| self.number(z as f64))
                    .collect()
            };
        }
        Ok(match chunk {
            DecodingResult::F32(numbers) => (numbers.into_iter())
                .map(|z| {
                    // In the precision in which it is written: the tag has it in decimals.
                    let is_none = self.no_data.is_some_and(|none| z == none as f32);
                    if is_none {
                        f32::NAN
                    } else {
                        self.number(z.into())
                    }
                })
                .collect(),
            DecodingResult::F64(numbers) => widened!(numbers),
            DecodingResult::U8(numbers) => widened!(numbers),
            DecodingResult::U16(numbers) => widened!(numbers),
            DecodingResult::U32(numbers) => widened!(numbers),
            DecodingResult::U64(numbers) => widened!(numbers),
            DecodingResult::I8(numbers) => widened!(numbers),
            DecodingResult::I16(numbers) => widened!(numbers),
            DecodingResult::I32(numbers) => widened!(numbers),
            DecodingResult::I64(numbers) => widened!(numbers),
            DecodingResult::F16(numbers) => (numbers.into_iter())
                .map(|z| self.number(z.to_f64()))
                .collect(),
        })
    }

    /// What is infinite is no height either.
    fn number(&self, z: f64) -> f32 {
        let is_none = self.no_data == Some(z);
        let z = z as f32;
        if is_none || z.is_infinite() {
            f32::NAN
        } else {
            z
        }
    }
}

/// The name of a compression, and how many times its size a strip or tile can unpack to at most.
fn compression(code: u64) -> Result<(&'static str, u64), FormatError> {
    let known = u16::try_from(code).map(CompressionMethod::from_u16_exhaustive);
    Ok(match known {
        Ok(CompressionMethod::None) => ("none", 1),
        // The 3837 strings of a full table, one byte longer each, in codes of 9 to 12 bits: 1363 times.
        Ok(CompressionMethod::LZW) => ("LZW", 1400),
        // 258 bytes from two codes of one bit each (RFC 1951).
        Ok(CompressionMethod::Deflate | CompressionMethod::OldDeflate) => ("Deflate", 1032),
        // 128 bytes from two.
        Ok(CompressionMethod::PackBits) => ("PackBits", 64),
        _ => {
            return Err(wrong(format!(
                "compression {code} is not read; Deflate, LZW, PackBits and none are"
            )));
        }
    })
}

/// GDAL's tag: a number as text.
fn no_data(decoder: &mut Decoder<Cursor<&[u8]>>) -> Option<f64> {
    let text = decoder.get_tag_ascii_string(Tag::GdalNodata).ok()?;
    text.trim_end_matches('\0').trim().parse().ok()
}
