//! The commands, one file each.

pub(crate) mod bench;
pub(crate) mod compare;
pub(crate) mod explain;
pub(crate) mod info;
pub(crate) mod lists;
pub(crate) mod minray;
pub(crate) mod render;
pub(crate) mod shadows;
pub(crate) mod study;

use std::io::{self, Write as _};

use clap::CommandFactory as _;
use clap::error::ErrorKind;

use crate::args::Cli;

/// Says things on standard error, unless asked not to.
struct Talk {
    quiet: bool,
}

impl Talk {
    fn say(&self, text: &str) {
        if !self.quiet {
            // Nobody is left to tell if this fails.
            let _ = writeln!(io::stderr(), "{text}");
        }
    }
}

/// Ends with exit code 2 and the usage of a command, as for any other word that cannot be understood.
fn wrong_usage(command: &str, message: &str) -> ! {
    let mut cli = Cli::command();
    // So that commands know their whole names.
    cli.build();
    let own = cli.find_subcommand(command).cloned();
    own.unwrap_or(cli)
        .error(ErrorKind::ValueValidation, message)
        .exit()
}

/// The command as it was typed, with quotes around words that need them.
fn command() -> String {
    let quoted = |word: String| {
        let plain = |c: char| c.is_alphanumeric() || "-_./,=+:".contains(c);
        if !word.is_empty() && word.chars().all(plain) {
            word
        } else {
            format!("'{}'", word.replace('\'', r"'\''"))
        }
    };
    let words = std::env::args_os().skip(1);
    let words = words.map(|word| quoted(word.to_string_lossy().into_owned()));
    std::iter::once("ombra".to_owned())
        .chain(words)
        .collect::<Vec<_>>()
        .join(" ")
}
