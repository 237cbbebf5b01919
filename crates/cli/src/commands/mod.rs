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
