//! Ctrl-C: the first one asks to stop and keep what is done, the second one means it.
//!
//! One key press may arrive twice, from the terminal and from a program in between that passes it
//! on, so a second one right after the first is taken for the same.

use std::io::Write as _;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use anyhow::Context as _;

/// What a shell expects of a program that was interrupted: 128 + SIGINT.
pub(crate) const EXIT_CODE: u8 = 130;

/// How long after a signal another one counts as the same press of the key.
const SAME_PRESS: Duration = Duration::from_millis(500);

/// Becomes true on Ctrl-C, and says so unless `quiet`.
pub(crate) fn watch(quiet: bool) -> anyhow::Result<Arc<AtomicBool>> {
    let stop = Arc::new(AtomicBool::new(false));
    let flag = Arc::clone(&stop);
    let mut first: Option<Instant> = None;
    ctrlc::set_handler(move || {
        if let Some(first) = first {
            if first.elapsed() > SAME_PRESS {
                std::process::exit(EXIT_CODE.into());
            }
            return;
        }
        first = Some(Instant::now());
        flag.store(true, Ordering::Relaxed);
        if !quiet {
            // Nobody is left to tell if this fails.
            let _ = writeln!(std::io::stderr(), "stopping; Ctrl-C again ends at once");
        }
    })
    .context("cannot watch for Ctrl-C")?;
    Ok(stop)
}
