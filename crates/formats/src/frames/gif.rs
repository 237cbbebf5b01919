//! An animated GIF.

use std::collections::HashMap;
use std::io::BufWriter;
use std::path::{Path, PathBuf};

use gif::{Encoder, EncodingError, Frame, Repeat};
use tempfile::NamedTempFile;

use crate::error::{Fault, FormatError};
use crate::image::{ImageBuffer, file_beside, image_fault, write_error};

/// How long a picture stays, in hundredths of a second.
const DELAY: u16 = 10;

/// How well colours are chosen where there are more than 256: 1 is best, 30 is quickest.
const SPEED: i32 = 10;

pub(super) struct Gif {
    path: PathBuf,
    state: State,
}

enum State {
    /// Its size is that of the first picture.
    Empty(NamedTempFile),
    Open(Encoder<BufWriter<NamedTempFile>>, [u16; 2]),
    /// While it changes, and after a fault.
    Broken,
}

impl Gif {
    pub(super) fn create(path: &Path) -> Result<Self, FormatError> {
        let beside = file_beside(path).map_err(|error| error.in_file(path))?;
        Ok(Self {
            path: path.to_owned(),
            state: State::Empty(beside),
        })
    }

    pub(super) fn path(&self) -> &Path {
        &self.path
    }

    pub(super) fn add(&mut self, frame: &Frame<'_>) -> Result<(), FormatError> {
        self.add_frame(frame)
            .map_err(|error| error.in_file(&self.path))
    }

    fn add_frame(&mut self, frame: &Frame<'_>) -> Result<(), FormatError> {
        let (width, height) = (frame.width, frame.height);
        let (mut encoder, own) = match std::mem::replace(&mut self.state, State::Broken) {
            State::Empty(file) => {
                let file = BufWriter::with_capacity(1 << 20, file);
                let mut encoder = Encoder::new(file, width, height, &[]).map_err(fault)?;
                encoder.set_repeat(Repeat::Infinite).map_err(fault)?;
                (encoder, [width, height])
            }
            State::Open(encoder, own) => (encoder, own),
            State::Broken => return Err(broken()),
        };
        if own != [width, height] {
            let text = format!(
                "a picture of {width}x{height} pixels among those of {}x{}",
                own[0], own[1]
            );
            return Err(FormatError::file(Fault::Description(text)));
        }
        encoder.write_lzw_pre_encoded_frame(frame).map_err(fault)?;
        self.state = State::Open(encoder, own);
        Ok(())
    }

    pub(super) fn finish(self) -> Result<(), FormatError> {
        let Self { path, state } = self;
        let finish = || {
            let State::Open(encoder, _) = state else {
                return Err(broken());
            };
            let file = encoder.into_inner().map_err(fault)?;
            let file = file
                .into_inner()
                .map_err(|error| write_error(error.into_error()))?;
            file.persist(&path)
                .map(drop)
                .map_err(|error| write_error(error.error))
        };
        finish().map_err(|error| error.in_file(&path))
    }
}

impl std::fmt::Debug for Gif {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Gif")
            .field("path", &self.path)
            .finish_non_exhaustive()
    }
}

/// A picture, packed: what takes most of the time, and what many threads may do at once.
pub(super) fn pack(picture: &ImageBuffer) -> Result<Frame<'static>, FormatError> {
    let [width, height] = size(picture)?;
    let bytes = picture.screen_bytes();
    let mut frame = match indexed(&bytes) {
        Some((pixels, palette)) => Frame::from_palette_pixels(width, height, pixels, palette, None),
        None => Frame::from_rgb_speed(width, height, &bytes, SPEED),
    };
    frame.delay = DELAY;
    frame.make_lzw_pre_encoded();
    Ok(frame)
}

/// Which colour each pixel has, and the colours, as they come; none if there are more than 256.
fn indexed(bytes: &[u8]) -> Option<(Vec<u8>, Vec<u8>)> {
    let mut numbers: HashMap<[u8; 3], u8> = HashMap::new();
    let mut palette: Vec<u8> = Vec::new();
    // Maps are of large areas of one colour.
    let mut last = ([0; 3], None);
    let pixels = bytes.as_chunks().0.iter().map(|&colour| {
        if let (own, Some(number)) = last
            && own == colour
        {
            return Some(number);
        }
        let number = match numbers.get(&colour) {
            Some(&number) => number,
            None => {
                let number = u8::try_from(numbers.len()).ok()?;
                numbers.insert(colour, number);
                palette.extend(colour);
                number
            }
        };
        last = (colour, Some(number));
        Some(number)
    });
    let pixels: Option<Vec<u8>> = pixels.collect();
    Some((pixels?, palette))
}

fn size(picture: &ImageBuffer) -> Result<[u16; 2], FormatError> {
    let [width, height] = [picture.width(), picture.height()];
    match (u16::try_from(width), u16::try_from(height)) {
        (Ok(width), Ok(height)) => Ok([width, height]),
        _ => Err(FormatError::file(Fault::ImageTooLarge {
            width: width.into(),
            height: height.into(),
            limit: u64::from(u16::MAX).pow(2),
        })),
    }
}

fn fault(error: EncodingError) -> FormatError {
    match error {
        EncodingError::Io(error) => write_error(error),
        error => image_fault("GIF", &error),
    }
}

fn broken() -> FormatError {
    image_fault("GIF", &"there is no picture in it")
}
