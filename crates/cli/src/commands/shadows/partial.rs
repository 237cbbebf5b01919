//! What is measured, kept beside the output until that is whole, so that `--resume` can go on from it.

use std::fs::File;
use std::io::{self, Read as _};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use anyhow::{Context as _, bail};
use ombra::accrual::Tiles;
use ombra::city::Facet;
use ombra::formats::sha256::{self, Content};
use ombra::formats::write_whole;
use serde::{Deserialize, Serialize};

use super::args::ShadowsArgs;
use super::when::When;
use crate::commands::command;

/// How a file begins that is one of ours.
const MAGIC: &[u8] = b"ombra shadows, partial 1\n";

/// No head is longer, in bytes.
const LONGEST_HEAD: u64 = 1 << 16;

/// How often it is written at most, and which share of the time that may take: one in so many.
const EVERY: Duration = Duration::from_secs(10);
const SHARE: u32 = 20;

/// All that minutes depend on, hashed where it is long.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
struct Job {
    version: String,
    city: String,
    places: String,
    when: String,
    method: String,
}

#[derive(Serialize, Deserialize)]
struct Head {
    job: Job,
    /// As it was typed, for people.
    command: String,
    done: usize,
    /// Of the numbers that follow.
    sha256: String,
}

/// The file beside an output.
pub(super) struct Partial {
    path: PathBuf,
    job: Job,
    next: Instant,
    fault: Option<String>,
}

impl Partial {
    /// For the first output of a run; `None` if there is none. What was done before, if it is to be `resumed`: minutes
    /// of the first places, in whole tiles.
    pub(super) fn open(
        args: &ShadowsArgs,
        facets: &[Facet],
        tiles: &Tiles,
        when: &When,
    ) -> anyhow::Result<Option<(Self, Vec<f32>)>> {
        let Some(output) = args.files().next() else {
            return Ok(None);
        };
        let mut name = output.as_os_str().to_owned();
        name.push(".partial");
        let partial = Self {
            path: name.into(),
            job: Job::new(args, facets, tiles, when),
            next: Instant::now() + EVERY,
            fault: None,
        };
        let in_file = || partial.path.display().to_string();
        let content = read(&partial.path, tiles.places().len()).with_context(in_file)?;
        let Some(content) = content.filter(|_| args.resume) else {
            return Ok(Some((partial, Vec::new())));
        };
        let Some((head, numbers)) = parsed(&content) else {
            bail!(
                "{}: broken: what it keeps cannot be used; remove it",
                in_file()
            );
        };
        partial.check(&head)?;
        let minutes = minutes(&head, numbers, tiles);
        let minutes = minutes.with_context(|| {
            format!(
                "{}: broken: its numbers are not whole; remove it",
                in_file()
            )
        })?;
        Ok(Some((partial, minutes)))
    }

    fn check(&self, head: &Head) -> anyhow::Result<()> {
        let (was, is) = (&head.job, &self.job);
        let differs = [
            ("version of ombra", was.version != is.version),
            ("city", was.city != is.city),
            ("list of places", was.places != is.places),
            ("time", was.when != is.when),
            ("method", was.method != is.method),
        ];
        let differs = differs.iter().filter(|(_, differs)| *differs);
        let differs: Vec<&str> = differs.map(|(name, _)| *name).collect();
        if !differs.is_empty() {
            bail!(
                "{}: of another job, with another {} (begun as: {}); ask for the same, or leave out --resume to begin \
                 anew",
                self.path.display(),
                differs.join(" and "),
                head.command
            );
        }
        Ok(())
    }

    /// Keeps what is done, if it is time to.
    pub(super) fn keep_sometimes(&mut self, minutes: &[f32]) {
        if self.fault.is_none() && Instant::now() >= self.next {
            let begun = Instant::now();
            self.fault = self.keep(minutes).err().map(|error| error.to_string());
            self.next = Instant::now() + EVERY.max(begun.elapsed() * SHARE);
        }
    }

    /// Keeps what is done.
    pub(super) fn keep(&self, minutes: &[f32]) -> anyhow::Result<()> {
        let numbers: Vec<u8> = minutes
            .iter()
            .flat_map(|minutes| minutes.to_le_bytes())
            .collect();
        let head = Head {
            job: self.job.clone(),
            command: command(),
            done: minutes.len(),
            sha256: sha256::of_bytes(&numbers),
        };
        let mut content = MAGIC.to_vec();
        serde_json::to_writer(&mut content, &head)?;
        content.push(b'\n');
        content.extend(numbers);
        Ok(write_whole(&self.path, &content)?)
    }

    /// Takes the file away: the output is whole.
    pub(super) fn remove(&self) -> anyhow::Result<()> {
        match std::fs::remove_file(&self.path) {
            Err(error) if error.kind() != io::ErrorKind::NotFound => {
                Err(error).with_context(|| format!("{}: cannot be removed", self.path.display()))
            }
            _ => Ok(()),
        }
    }
}

impl Job {
    fn new(args: &ShadowsArgs, facets: &[Facet], tiles: &Tiles, when: &When) -> Self {
        let mut city = Content::default();
        for facet in facets {
            hash(&mut city, facet.corners.iter().flat_map(|p| p.to_array()));
            city.take(&[u8::from(facet.is_two_sided)]);
        }
        let mut places = Content::default();
        for tile in 0..tiles.len() {
            let tile = &tiles.places()[tiles.range(tile..tile + 1)];
            places.take(&[tile.len() as u8]);
            hash(&mut places, tile.iter().flat_map(|p| p.to_array()));
        }
        let mut hours = Content::default();
        for span in &when.spans {
            for instant in [span.start, span.end] {
                hours.take(&instant.seconds().to_le_bytes());
                for number in when.suns.iter().flat_map(|sun| sun.direction(instant)) {
                    hours.take(&number.to_le_bytes());
                }
            }
        }
        Self {
            version: env!("CARGO_PKG_VERSION").to_owned(),
            city: city.hexadecimal(),
            places: places.hexadecimal(),
            when: hours.hexadecimal(),
            method: args.method_text(),
        }
    }
}

fn hash(content: &mut Content, numbers: impl Iterator<Item = f32>) {
    for number in numbers {
        content.take(&number.to_le_bytes());
    }
}

/// What follows the first line of a file, if there is one, and no more of it than could be right.
fn read(path: &Path, places: usize) -> anyhow::Result<Option<Vec<u8>>> {
    let file = match File::open(path) {
        Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(None),
        file => file.context("cannot be opened")?,
    };
    let most = MAGIC.len() as u64 + LONGEST_HEAD + 4 * places as u64;
    let mut content = Vec::new();
    file.take(most)
        .read_to_end(&mut content)
        .context("cannot be read")?;
    match content.strip_prefix(MAGIC) {
        Some(rest) => Ok(Some(rest.to_vec())),
        None => bail!(
            "is in the way and none of ombra's files: what is done would be kept there; move it"
        ),
    }
}

fn parsed(content: &[u8]) -> Option<(Head, &[u8])> {
    let end = content.iter().position(|&b| b == b'\n')?;
    let head = serde_json::from_slice(&content[..end]).ok()?;
    Some((head, &content[end + 1..]))
}

/// `None` if they are not as they were written.
fn minutes(head: &Head, bytes: &[u8], tiles: &Tiles) -> Option<Vec<f32>> {
    let (numbers, left) = bytes.as_chunks::<4>();
    let ends_with_a_tile = || tiles.range(0..tiles.before(head.done)).end == head.done;
    let is_whole = left.is_empty()
        && numbers.len() == head.done
        && sha256::of_bytes(bytes) == head.sha256
        && ends_with_a_tile();
    is_whole.then(|| {
        numbers
            .iter()
            .map(|&bytes| f32::from_le_bytes(bytes))
            .collect()
    })
}
