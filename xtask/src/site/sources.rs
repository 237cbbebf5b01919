//! The files that pages link to: pictures as they are, source files as pages, folders as lists.

use std::fs;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result, bail};

use super::order::Order;
use super::{Content, Files, escaped, place, relative};
use crate::cargo;

/// Adds what the pages link to.
///
/// # Errors
/// When a file cannot be read, or is none that git knows.
pub(super) fn add(
    linked: &[PathBuf],
    tracked: &[PathBuf],
    order: &Order,
    files: &mut Files,
) -> Result<()> {
    for path in linked {
        if cargo::root().join(path).is_dir() {
            add_folder(path, tracked, order, files)?;
        } else if tracked.contains(path) {
            add_file(path, order, files)?;
        } else {
            bail!(
                "{} is not under version control, but a page links to it",
                path.display()
            );
        }
    }
    Ok(())
}

/// Adds a list of the files in a folder, and those that are text.
fn add_folder(folder: &Path, tracked: &[PathBuf], order: &Order, files: &mut Files) -> Result<()> {
    let at = place(folder);
    // Its README stands for it.
    if files.contains_key(&at) {
        return Ok(());
    }
    let mut list = String::new();
    for path in tracked.iter().filter(|path| path.starts_with(folder)) {
        let name = path
            .strip_prefix(folder)
            .unwrap_or(path)
            .display()
            .to_string();
        let name = escaped(&name);
        if add_file(path, order, files)? {
            let href = relative(&at, &place(path));
            list += &format!("<li><a href=\"{href}\">{name}</a></li>\n");
        } else {
            list += &format!("<li>{name}</li>\n");
        }
    }
    let name = folder.display().to_string();
    let content = format!(
        "<h1><code>{}</code></h1>\n<ul>\n{list}</ul>\n",
        escaped(&name)
    );
    files.insert(at, Content::Text(order.frame(folder, &name, &content)));
    Ok(())
}

/// Adds a file, unless it is there. Says whether the site has it: those that are neither text nor a
/// picture are left out.
fn add_file(path: &Path, order: &Order, files: &mut Files) -> Result<bool> {
    let at = place(path);
    if files.contains_key(&at) {
        return Ok(true);
    }
    if at == path {
        files.insert(at, Content::Copy(path.to_owned()));
        return Ok(true);
    }
    let bytes = fs::read(cargo::root().join(path))
        .with_context(|| format!("cannot read {}", path.display()))?;
    let Ok(text) = String::from_utf8(bytes) else {
        return Ok(false);
    };
    let name = path.display().to_string();
    let mut content = format!(
        "<h1><code>{}</code></h1>\n<pre class=\"source\">",
        escaped(&name)
    );
    for (index, line) in text.lines().enumerate() {
        let number = index + 1;
        content += &format!("<span id=\"L{number}\">{}\n</span>", escaped(line));
    }
    content += "</pre>\n";
    files.insert(at, Content::Text(order.frame(path, &name, &content)));
    Ok(true)
}
