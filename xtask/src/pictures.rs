//! The committed pictures of README.md and docs/, made by the commands that stand in the pages.
//!
//! A picture `docs/pictures/NAME` is made by the command of a page that has an option with the file
//! `NAME`, or a folder that it lies in, as in `-o NAME`: what a reader types is what made the picture.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use anyhow::{Context, Result, bail, ensure};
use clap::Args;

use crate::cargo::{self, Executables};
use crate::links;
use crate::markdown::Page;

/// Where they are.
const FOLDER: &str = "docs/pictures";

/// The most bytes of one: everybody who clones the repository gets all of them.
const MOST_BYTES: u64 = 150_000;

/// What a check renders instead of a page's size and samples.
const SMALL: [(&str, &str); 2] = [("--size", "64x48"), ("--spp", "1")];

/// What a check adds besides.
const SMALLER: &str = "--smoke";

/// Options that name a place in the picture.
const PLACES: [&str; 2] = ["--pixel", "--crop"];

/// A picture, and the words after `ombra` that make it.
#[derive(Debug, PartialEq, Eq)]
struct Recipe {
    /// Its path in the folder.
    picture: String,
    words: Vec<String>,
    /// Which of the words names it or its folder.
    output: usize,
    /// The page and the line.
    place: String,
}

/// Which pictures.
#[derive(Debug, Args)]
pub(crate) struct Options {
    /// Only pictures whose path holds this
    #[arg(default_value = "")]
    name: String,
}

/// Makes the committed pictures again, with the release build.
///
/// # Errors
/// When there is no such picture, or one cannot be made.
pub(crate) fn run(options: &Options) -> Result<()> {
    let recipes = recipes()?;
    let chosen = || recipes.iter().filter(|r| r.picture.contains(&options.name));
    ensure!(
        chosen().next().is_some(),
        "no page has a command that makes \"{}\"",
        options.name
    );
    let mut done: Vec<&[String]> = Vec::new();
    for recipe in chosen() {
        println!("{}", recipe.picture);
        // One command may make several.
        if done.contains(&recipe.words.as_slice()) {
            continue;
        }
        done.push(&recipe.words);
        let mut render = cargo::cargo("run --quiet --release --bin ombra --");
        render.args(recipe.words_into(&cargo::root().join(FOLDER)));
        cargo::run(&mut render).with_context(|| recipe.place.clone())?;
    }
    Ok(())
}

/// Runs the command of every picture at a small size.
///
/// # Errors
/// When a picture has no command or is too large, or a command makes no picture.
pub(crate) fn check(executables: &Executables) -> Result<()> {
    let recipes = recipes()?;
    let ombra = executables.binaries.get("ombra");
    let ombra = ombra.context("the workspace builds no binary \"ombra\"")?;
    let folder = cargo::root().join("target/small-pictures");
    if folder.exists() {
        fs::remove_dir_all(&folder)?;
    }
    let mut done: Vec<&[String]> = Vec::new();
    for recipe in &recipes {
        let to = folder.join(&recipe.picture);
        if !done.contains(&recipe.words.as_slice()) {
            done.push(&recipe.words);
            fs::create_dir_all(to.parent().unwrap_or(&folder))?;
            let takes = |flag: &str| takes(ombra, &recipe.words[0], flag);
            let words = small(recipe.words_into(&folder), takes);
            let output = Command::new(ombra)
                .current_dir(cargo::root())
                .args(&words)
                .output()
                .context("cannot start ombra")?;
            if !output.status.success() {
                let said = String::from_utf8_lossy(&output.stderr);
                bail!("{}: `ombra {}`: {said}", recipe.place, words.join(" "));
            }
        }
        let made = fs::metadata(&to).is_ok_and(|file| file.len() > 0);
        ensure!(
            made,
            "{}: the command makes no {}",
            recipe.place,
            recipe.picture
        );
    }
    println!(
        "{} pictures are made by {} commands",
        recipes.len(),
        done.len()
    );
    Ok(())
}

/// A recipe for each committed picture.
fn recipes() -> Result<Vec<Recipe>> {
    let pages = links::pages()?;
    let committed = cargo::tracked(&[".png", ".svg", ".jpg"])?;
    let mut recipes = Vec::new();
    let mut findings = Vec::new();
    for file in committed.iter().filter(|file| file.starts_with(FOLDER)) {
        let bytes = fs::metadata(cargo::root().join(file))?.len();
        if bytes > MOST_BYTES {
            findings.push(format!(
                "{}: {bytes} bytes, over {MOST_BYTES}",
                file.display()
            ));
        }
        let picture = file.strip_prefix(FOLDER)?.display().to_string();
        match recipe(&picture, &pages) {
            Ok(recipe) => recipes.push(recipe),
            Err(error) => findings.push(format!("{}: {error}", file.display())),
        }
    }
    ensure!(findings.is_empty(), "{}", findings.join("\n"));
    Ok(recipes)
}

/// The command that makes a picture.
fn recipe(picture: &str, pages: &BTreeMap<PathBuf, Page>) -> Result<Recipe> {
    let mut found: Option<Recipe> = None;
    for (file, page) in pages {
        for command in &page.commands {
            let Some(words) = words_of(&command.text) else {
                continue;
            };
            // The value of an option, as in `-o NAME`: `ombra info NAME` makes nothing.
            let makes = |pair: &[String]| {
                pair[0].starts_with('-') && Path::new(picture).starts_with(&pair[1])
            };
            let Some(option) = words.windows(2).position(makes) else {
                continue;
            };
            let output = option + 1;
            let place = format!("{}:{}", file.display(), command.line);
            if let Some(other) = &found {
                ensure!(
                    other.words == words,
                    "{place} makes it by other words than {}",
                    other.place
                );
                continue;
            }
            let picture = picture.to_owned();
            found = Some(Recipe {
                picture,
                words,
                output,
                place,
            });
        }
    }
    found.context("no page has a command that makes it")
}

/// The words after `ombra` of a command that calls it.
fn words_of(command: &str) -> Option<Vec<String>> {
    let (_, words) = (command.split_once("cargo run --release -- ")).or_else(|| {
        command
            .split_once("ombra ")
            .filter(|(before, _)| before.is_empty())
    })?;
    Some(words.split_whitespace().map(str::to_owned).collect())
}

impl Recipe {
    /// The words with the output in a folder.
    fn words_into(&self, folder: &Path) -> Vec<String> {
        let mut words = self.words.clone();
        words[self.output] = folder.join(&words[self.output]).display().to_string();
        words
    }
}

/// The words of a command at a small size, for the options that it takes. One that names a place in
/// the picture keeps its size.
fn small(mut words: Vec<String>, takes: impl Fn(&str) -> bool) -> Vec<String> {
    if words.iter().any(|word| PLACES.contains(&word.as_str())) {
        return words;
    }
    for (flag, value) in SMALL.into_iter().filter(|(flag, _)| takes(flag)) {
        match words.iter().position(|word| word == flag) {
            Some(at) if at + 1 < words.len() => words[at + 1] = value.to_owned(),
            _ => words.extend([flag.to_owned(), value.to_owned()]),
        }
    }
    if takes(SMALLER) {
        words.push(SMALLER.to_owned());
    }
    words
}

/// Whether `ombra COMMAND` has an option.
fn takes(ombra: &Path, command: &str, flag: &str) -> bool {
    let help = Command::new(ombra).args([command, "--help"]).output();
    help.is_ok_and(|help| {
        let help = String::from_utf8_lossy(&help.stdout);
        help.split_whitespace().any(|word| word == flag)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn pages(texts: &[&str]) -> BTreeMap<PathBuf, Page> {
        let pages = texts.iter().enumerate();
        pages
            .map(|(i, text)| (format!("{i}.md").into(), Page::parse(text)))
            .collect()
    }

    fn words(text: &str) -> Vec<String> {
        text.split(' ').map(str::to_owned).collect()
    }

    #[test]
    fn a_picture_is_made_by_the_command_that_names_it_or_its_folder() {
        let pages = pages(&[
            "`cargo run --release -- render teapot -o teapot.png`",
            "```sh\nombra compare teapot -o two-loops\n```\n`ombra info teapot.png`",
        ]);
        let found = recipe("two-loops/raster.png", &pages).unwrap();
        assert_eq!(found.words, words("compare teapot -o two-loops"));
        assert_eq!((found.output, found.place.as_str()), (3, "1.md:2"));
        let into = found.words_into(Path::new("there"));
        assert_eq!(into, words("compare teapot -o there/two-loops"));
        let nothing = recipe("shapes.png", &pages).unwrap_err();
        assert_eq!(nothing.to_string(), "no page has a command that makes it");
        assert!(
            recipe("teapot.png", &pages).is_ok(),
            "info makes no picture"
        );
    }

    #[test]
    fn two_commands_for_one_picture_are_refused() {
        let pages = pages(&[
            "`ombra render a -o a.png`",
            "text\n`ombra render b -o a.png`",
        ]);
        let error = recipe("a.png", &pages).unwrap_err().to_string();
        assert_eq!(error, "1.md:2 makes it by other words than 0.md:1");
    }

    #[test]
    fn a_small_picture_has_another_size_and_all_else_as_it_was() {
        let page = words("render whitted --size 640x360 -o a.png");
        let all = small(page.clone(), |_| true);
        assert_eq!(
            all,
            words("render whitted --size 64x48 -o a.png --spp 1 --smoke")
        );
        assert_eq!(small(page.clone(), |_| false), page);
        let pixel = words("explain cornell --pixel 330,440 --svg a.svg");
        assert_eq!(small(pixel.clone(), |_| true), pixel);
    }

    #[test]
    fn every_committed_picture_has_a_command_and_is_not_too_large() {
        assert!(recipes().unwrap().len() >= 4);
    }

    #[test]
    fn a_picture_that_no_page_makes_is_refused() {
        let name = "no such picture".to_owned();
        let message = run(&Options { name }).unwrap_err().to_string();
        assert!(message.contains("\"no such picture\""), "{message}");
    }
}
