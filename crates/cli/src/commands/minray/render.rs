//! `ombra minray render`: a picture in the contest's format.

use std::io::{self, Write as _};
use std::process::ExitCode;

use ombra::formats::write_whole;

use super::{contest, picture};
use crate::args::MinrayRenderArgs;
use crate::interrupt;

pub(super) fn run(args: &MinrayRenderArgs) -> anyhow::Result<ExitCode> {
    let Some(picture) = picture(&contest(&args.scene)?)? else {
        return Ok(ExitCode::from(interrupt::EXIT_CODE));
    };
    let text = picture.to_string();
    match &args.output {
        None => io::stdout().lock().write_all(text.as_bytes())?,
        Some(path) => write_whole(path, text.as_bytes())?,
    }
    Ok(ExitCode::SUCCESS)
}
