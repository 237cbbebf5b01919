//! Progress on a terminal: a bar with rays a second and the time left, and the picture above it.

use std::io::{self, IsTerminal as _, Write as _};
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use ombra::render::{Film, Progress};

use crate::preview::half_blocks;

/// What a person sees while a picture is rendered. Nothing, where nobody looks.
pub(crate) struct Display {
    bar: ProgressBar,
    begun: Instant,
    rays: AtomicU64,
    preview: bool,
}

impl Display {
    pub(crate) fn unless(quiet: bool) -> Self {
        let shown = is_looked_at(quiet);
        let bar = bar(shown);
        let preview =
            shown && !bar.is_hidden() && console::colors_enabled_stderr() && true_colour();
        Self {
            bar,
            begun: Instant::now(),
            rays: AtomicU64::new(0),
            preview,
        }
    }

    /// Shows how far the picture is. Called from any thread.
    pub(crate) fn update(&self, progress: Progress) {
        self.bar.set_length(progress.total);
        self.bar.set_position(progress.done);
        // Several threads report; the counts may come out of order.
        let rays = self
            .rays
            .fetch_max(progress.rays, Ordering::Relaxed)
            .max(progress.rays);
        self.bar.set_message(rate(rays, self.begun.elapsed()));
    }

    /// Shows the picture itself, after a pass over it.
    pub(crate) fn show(&self, film: &Film) {
        if self.preview {
            let (rows, columns) = console::Term::stderr().size();
            self.bar
                .set_prefix(half_blocks(film, columns.into(), rows.into()));
        }
    }

    /// Takes the bar away; leaves the picture, if it was shown.
    pub(crate) fn finish(&self) {
        let picture = self.bar.prefix();
        self.bar.finish_and_clear();
        if self.preview {
            // Nobody is left to tell if this fails.
            let _ = write!(io::stderr(), "{picture}");
        }
    }
}

/// What a person sees of many jobs. Nothing, where nobody looks.
pub(crate) struct Jobs {
    bar: ProgressBar,
}

impl Jobs {
    pub(crate) fn unless(quiet: bool) -> Self {
        Self {
            bar: bar(is_looked_at(quiet)),
        }
    }

    /// Shows how many jobs are done and what comes next.
    pub(crate) fn update(&self, done: u64, total: u64, doing: &str) {
        self.bar.set_length(total);
        self.bar.set_position(done);
        self.bar.set_message(doing.to_owned());
    }

    /// Takes the bar away.
    pub(crate) fn finish(&self) {
        self.bar.finish_and_clear();
    }
}

/// Only a terminal shows progress.
fn is_looked_at(quiet: bool) -> bool {
    !quiet && io::stderr().is_terminal()
}

fn bar(shown: bool) -> ProgressBar {
    let target = if shown {
        ProgressDrawTarget::stderr_with_hz(10)
    } else {
        ProgressDrawTarget::hidden()
    };
    let bar = ProgressBar::with_draw_target(Some(0), target);
    let style = ProgressStyle::with_template(
        "{prefix}{wide_bar:.cyan/blue} {percent:>3} %  {msg}  {eta} left",
    );
    if let Ok(style) = style {
        bar.set_style(style);
    }
    bar
}

/// Rays a second, for people.
pub(crate) fn rate(rays: u64, elapsed: Duration) -> String {
    let per_second = rays as f64 / elapsed.as_secs_f64().max(1e-9);
    if per_second >= 1e6 {
        format!("{:.2} Mrays/s", per_second / 1e6)
    } else {
        format!("{:.0} krays/s", per_second / 1e3)
    }
}

/// Whether the terminal says that it shows 24-bit colour.
fn true_colour() -> bool {
    std::env::var("COLORTERM").is_ok_and(|value| value == "truecolor" || value == "24bit")
}
