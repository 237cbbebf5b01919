//! `ombra explain --diff A B`: the first ray where two renders part.

use std::fmt::Write as _;
use std::io::{self, Write as _};
use std::process::ExitCode;

use ombra::pipeline::Cpu;
use ombra::render::explain::Explainer;
use ombra::render::{Watch, render};
use serde::Serialize;
use serde_json::Value;

use super::args::ExplainArgs;
use super::document::{Document, Sample};
use super::part::{Parting, parting};
use super::side::{Choice, Side, side};
use super::text::title;
use super::{Stage, usage_or_failure, wrong_usage};

/// Where two renders part: what `--json` prints, all but `a` and `b` empty where they do not.
#[derive(Serialize)]
struct Found<'a> {
    a: &'a str,
    b: &'a str,
    difference: bool,
    pixel: Option<[u32; 2]>,
    sample: Option<u32>,
    path: Vec<Step>,
    values: Vec<Values>,
}

/// One ray of the path, as each side has it.
#[derive(Serialize)]
struct Step {
    a: Option<usize>,
    b: Option<usize>,
    a_is: Option<String>,
    b_is: Option<String>,
}

#[derive(Serialize)]
struct Values {
    field: String,
    a: Value,
    b: Value,
}

/// One side, ready to be asked for a pixel.
enum Ready {
    Render(Box<Stage>),
    File(Box<Document>),
}

pub(crate) fn run(args: &ExplainArgs, sides: &[String]) -> anyhow::Result<ExitCode> {
    let base = Choice::of(args);
    let ready = |text: &String| -> anyhow::Result<Ready> {
        Ok(match side(text, &base)? {
            Err(wrong) => wrong_usage(&format!("--diff: {}", wrong.0)),
            Ok(Side::File(document)) => Ready::File(document),
            Ok(Side::Render(choice)) => Ready::Render(Box::new(Stage::load(args, &choice)?)),
        })
    };
    let [a, b] = sides else {
        wrong_usage("--diff takes two sides")
    };
    let both = [ready(a)?, ready(b)?];
    let found = match pixel(args, &both)? {
        None => Found::nothing(a, b),
        Some(pixel) => {
            let parted = explained(args, &both, pixel)?;
            Found {
                pixel: Some(pixel),
                ..parted.map_or_else(|| Found::nothing(a, b), |it| Found::of(a, b, it))
            }
        }
    };
    let text = if args.json {
        serde_json::to_string_pretty(&found)? + "\n"
    } else {
        found.words()?
    };
    io::stdout().write_all(text.as_bytes())?;
    Ok(if found.difference {
        ExitCode::FAILURE
    } else {
        ExitCode::SUCCESS
    })
}

/// The pixel to look at: the one that is asked for, that of a file, or the first one that differs.
fn pixel(args: &ExplainArgs, both: &[Ready; 2]) -> anyhow::Result<Option<[u32; 2]>> {
    let mut wanted = args.pixel;
    for ready in both {
        if let Ready::File(document) = ready {
            let of_file = document.heading.pixel;
            if wanted.is_some_and(|wanted| wanted != of_file) {
                let [x, y] = of_file;
                wrong_usage(&format!("--diff: the file tells of pixel {x},{y}"));
            }
            wanted = Some(of_file);
        }
    }
    if wanted.is_some() {
        return Ok(wanted);
    }
    let [Ready::Render(a), Ready::Render(b)] = both else {
        return Ok(None);
    };
    let cpu = Cpu::all_threads();
    let film = |stage: &Stage| -> anyhow::Result<_> {
        let watch = Watch::default();
        Ok(render(&stage.world, &stage.camera, &stage.settings, &cpu, watch)?.film)
    };
    let (of_a, of_b) = (film(a)?, film(b)?);
    let places = (0..of_a.height()).flat_map(|y| (0..of_a.width()).map(move |x| [x, y]));
    let bits = |colour: Option<ombra::scene::Rgb>| colour.map(|c| c.to_array().map(f32::to_bits));
    let mut differing =
        places.filter(|&[x, y]| bits(of_a.average(x, y)) != bits(of_b.average(x, y)));
    Ok(differing.next())
}

/// Where the trees of a pixel part: at which sample, and with the samples themselves.
type Parted = (u32, [Option<Sample>; 2], Parting);

fn explained(
    args: &ExplainArgs,
    both: &[Ready; 2],
    pixel: [u32; 2],
) -> anyhow::Result<Option<Parted>> {
    let cpu = Cpu::all_threads();
    let mut asked = Vec::new();
    for ready in both {
        asked.push(match ready {
            Ready::File(document) => Asked::File(document),
            Ready::Render(stage) => {
                let Stage {
                    world,
                    camera,
                    settings,
                    ..
                } = &**stage;
                let explainer = Explainer::new(world, camera, settings, pixel);
                Asked::Render(stage, Box::new(usage_or_failure(explainer)?))
            }
        });
    }
    let [a, b] = &mut asked[..] else {
        return Ok(None);
    };
    let mut index = args.sample.unwrap_or(0);
    loop {
        let samples = [a.sample(index, &cpu)?, b.sample(index, &cpu)?];
        let parted = match &samples {
            [None, None] => return Ok(None),
            [Some(one), Some(other)] => parting(one, other)?,
            // One of them has more samples.
            _ => Some(Parting {
                path: vec![[
                    samples[0].as_ref().map(|_| 0),
                    samples[1].as_ref().map(|_| 0),
                ]],
                values: Vec::new(),
            }),
        };
        if let Some(parting) = parted {
            return Ok(Some((index, samples, parting)));
        }
        if args.sample.is_some() {
            return Ok(None);
        }
        index += 1;
    }
}

/// What gives samples.
enum Asked<'a> {
    Render(&'a Stage, Box<Explainer<'a>>),
    File(&'a Document),
}

impl Asked<'_> {
    fn sample(&mut self, index: u32, cpu: &Cpu) -> anyhow::Result<Option<Sample>> {
        match self {
            Self::File(document) => {
                let mut samples = document.samples.iter();
                Ok(samples.find(|sample| sample.sample == index).cloned())
            }
            Self::Render(stage, _) if index >= stage.settings.spp => Ok(None),
            Self::Render(stage, explainer) => {
                let tree = explainer.sample(index, cpu)?;
                Ok(Some(Sample::of(&tree, stage.scene())))
            }
        }
    }
}

impl<'a> Found<'a> {
    const fn nothing(a: &'a str, b: &'a str) -> Self {
        Self {
            a,
            b,
            difference: false,
            pixel: None,
            sample: None,
            path: Vec::new(),
            values: Vec::new(),
        }
    }

    fn of(a: &'a str, b: &'a str, (sample, samples, parting): Parted) -> Self {
        let named = |side: usize, ray: Option<usize>| {
            let rays = &samples[side].as_ref()?.rays;
            Some(title(rays.get(ray?)?))
        };
        let steps = parting.path.iter().map(|&[in_a, in_b]| Step {
            a: in_a,
            b: in_b,
            a_is: named(0, in_a),
            b_is: named(1, in_b),
        });
        Self {
            difference: true,
            sample: Some(sample),
            path: steps.collect(),
            values: parting
                .values
                .into_iter()
                .map(|one| Values {
                    field: one.field,
                    a: one.a,
                    b: one.b,
                })
                .collect(),
            ..Self::nothing(a, b)
        }
    }

    fn words(&self) -> anyhow::Result<String> {
        let mut text = String::new();
        let place = match self.pixel {
            Some([x, y]) => format!("pixel {x},{y}"),
            None => "the pictures".to_owned(),
        };
        let Some(sample) = self.sample else {
            writeln!(
                text,
                "no difference in {place} between {} and {}",
                self.a, self.b
            )?;
            return Ok(text);
        };
        writeln!(
            text,
            "{place}, sample {sample}: A is {}, B is {}",
            self.a, self.b
        )?;
        let Some((last, before)) = self.path.split_last() else {
            return Ok(text);
        };
        let mut indent = String::new();
        for step in before {
            writeln!(text, "{indent}{}", step.a_is.as_deref().unwrap_or(""))?;
            indent.push_str("   ");
        }
        writeln!(text, "{indent}here they part:")?;
        for (side, title) in [("A", &last.a_is), ("B", &last.b_is)] {
            let title = title.as_deref().unwrap_or("has no such ray");
            writeln!(text, "{indent}{side}  {title}")?;
        }
        for Values { field, a, b } in &self.values {
            writeln!(text, "{indent}   {field}")?;
            writeln!(text, "{indent}      A  {}", short(a))?;
            writeln!(text, "{indent}      B  {}", short(b))?;
        }
        Ok(text)
    }
}

/// A value in a line: what is long is cut.
fn short(value: &Value) -> String {
    const LONGEST: usize = 90;
    let text = value.to_string();
    if text.chars().count() <= LONGEST {
        return text;
    }
    text.chars().take(LONGEST).chain(" …".chars()).collect()
}
