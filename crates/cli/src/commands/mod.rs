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
use serde::Serialize;

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

/// Numbers, on standard output.
fn print_json(numbers: &impl Serialize) -> anyhow::Result<()> {
    let json = serde_json::to_string_pretty(numbers)?;
    Ok(writeln!(io::stdout(), "{json}")?)
}

/// Ends with exit code 2 and the usage of a command (`shadows query`), as for any other word that cannot be understood.
fn wrong_usage(command: &str, message: &str) -> ! {
    let mut cli = Cli::command();
    // So that commands know their whole names.
    cli.build();
    let mut own = &cli;
    for word in command.split(' ') {
        own = own.find_subcommand(word).unwrap_or(own);
    }
    own.clone()
        .error(ErrorKind::ValueValidation, message)
        .exit()
}

/// The command that gives the same files again: as it was typed, with quotes around words that need them, and
/// without what changes nothing in them.
fn command() -> String {
    rerun(
        std::env::args_os()
            .skip(1)
            .map(|word| word.to_string_lossy().into_owned()),
    )
}

fn rerun(words: impl Iterator<Item = String>) -> String {
    let quoted = |word: String| {
        let plain = |c: char| c.is_alphanumeric() || "-_./,=+:".contains(c);
        if !word.is_empty() && word.chars().all(plain) {
            word
        } else {
            format!("'{}'", word.replace('\'', r"'\''"))
        }
    };
    let mut all = vec!["ombra".to_owned()];
    let mut is_number_of_threads = false;
    for word in words {
        let is_left_out = is_number_of_threads
            || ["--resume", "--quiet", "--json", "--threads"].contains(&&*word)
            || word.starts_with("--threads=");
        is_number_of_threads = word == "--threads";
        if !is_left_out {
            all.push(quoted(word));
        }
    }
    all.join(" ")
}

#[cfg(test)]
mod tests {
    #[test]
    fn what_changes_no_byte_is_not_told() {
        let of = |text: &str| super::rerun(text.split('|').map(str::to_owned));
        assert_eq!(
            of("shadows|my city.json|--threads|3|-o|a.tif|--resume|--threads=2|--cell|2"),
            "ombra shadows 'my city.json' -o a.tif --cell 2"
        );
        assert_eq!(of("shadows|it's|--threads"), r"ombra shadows 'it'\''s'");
    }
}
