//! Ctrl-C: the first one asks to stop and keep what is done, the second one means it.

use std::io::Write as _;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use anyhow::Context as _;

/// What a shell expects of a program that was interrupted: 128 + SIGINT.
pub(crate) const EXIT_CODE: u8 = 130;

/// Becomes true on Ctrl-C, and says so unless `quiet`.
pub(crate) fn watch(quiet: bool) -> anyhow::Result<Arc<AtomicBool>> {
    let stop = Arc::new(AtomicBool::new(false));
    let flag = Arc::clone(&stop);
    ctrlc::set_handler(move || {
        if flag.swap(true, Ordering::Relaxed) {
            std::process::exit(EXIT_CODE.into());
        }
        if !quiet {
            // Nobody is left to tell if this fails.
            let _ = writeln!(std::io::stderr(), "stopping; Ctrl-C again ends at once");
        }
    })
    .context("cannot watch for Ctrl-C")?;
    Ok(stop)
}
