//! The tree as an indented text.

use std::io::{self, Write};

use super::document::{Crossed, Heading, Lit, Met, Ray, Sample, SurfaceName};
use super::number::{Number, colour, short, triple};

/// The most rays that are printed: what is beyond is only counted.
const MAX_PRINTED: usize = 200;

/// Steps to the right; deeper rays stand below one another.
const MAX_INDENT: usize = 10;

/// Writes samples as they come.
pub(crate) struct Text<W> {
    out: W,
    printed: usize,
    /// Samples of which only the count is known to the reader, and their rays.
    left_out: (usize, usize),
}

impl<W: Write> Text<W> {
    pub(crate) fn begin(mut out: W, heading: &Heading) -> io::Result<Self> {
        let [x, y] = heading.pixel;
        let Heading {
            scene,
            width,
            height,
            spp,
            integrator,
            accel,
            max_depth,
            seed,
            ..
        } = heading;
        let samples = match spp {
            1 => "1 sample, through its middle".to_owned(),
            n => format!("{n} samples"),
        };
        writeln!(out, "{scene}: pixel {x},{y} of {width}x{height}, {samples}")?;
        writeln!(
            out,
            "{integrator}, {accel}, at most {max_depth} bounces, seed {seed}"
        )?;
        writeln!(
            out,
            "Lengths are in units of the scene; colours are linear: red green blue."
        )?;
        Ok(Self {
            out,
            printed: 0,
            left_out: (0, 0),
        })
    }

    pub(crate) fn sample(&mut self, sample: &Sample) -> io::Result<()> {
        let rays = sample.rays.len();
        if self.printed >= MAX_PRINTED {
            self.left_out.0 += 1;
            self.left_out.1 += rays;
            return Ok(());
        }
        let out = &mut self.out;
        writeln!(
            out,
            "\nsample {}: {} brings {}",
            sample.sample,
            counted(rays, "ray"),
            colour(&sample.radiance)
        )?;
        let children = children(sample);
        // A ray is printed when it is taken from the stack, so that a deep tree takes no recursion.
        let mut stack = vec![(0, Guide::default())];
        let mut shown = 0;
        while let Some((index, guide)) = stack.pop() {
            if self.printed >= MAX_PRINTED {
                break;
            }
            let Some(ray) = sample.rays.get(index) else {
                break;
            };
            self.printed += 1;
            shown += 1;
            let below = &children[index];
            writeln!(out, "{guide:#}{}", title(ray))?;
            for line in lines(ray, &sample.rays) {
                let more = if below.is_empty() { "   " } else { "│  " };
                writeln!(out, "{guide}{more}{line}")?;
            }
            for (place, &child) in below.iter().enumerate().rev() {
                stack.push((child, guide.below(place + 1 == below.len())));
            }
        }
        if shown < rays {
            writeln!(
                out,
                "… {} of this sample left out: --json has all",
                counted(rays - shown, "more ray")
            )?;
        }
        Ok(())
    }

    pub(crate) fn end(mut self, pixel: [Number; 3], all: bool) -> io::Result<()> {
        let (samples, rays) = self.left_out;
        if samples > 0 {
            writeln!(
                self.out,
                "\n… {} with {} left out: --sample K shows one, --json has all",
                counted(samples, "more sample"),
                counted(rays, "ray")
            )?;
        }
        let whole = if all { "the pixel" } else { "this sample" };
        writeln!(self.out, "\n{whole} is {}", colour(&pixel))
    }
}

/// The children of each ray, in order.
pub(crate) fn children(sample: &Sample) -> Vec<Vec<usize>> {
    let mut children = vec![Vec::new(); sample.rays.len()];
    for ray in &sample.rays {
        if let Some(below) = ray.parent.and_then(|parent| children.get_mut(parent)) {
            below.push(ray.ray);
        }
    }
    children
}

/// The lines from a ray to its parents, at the left of its text.
#[derive(Clone, Default)]
struct Guide {
    /// Whether each ray from the camera to here was the last child.
    last: Vec<bool>,
}

impl Guide {
    fn below(&self, last: bool) -> Self {
        let mut guide = self.clone();
        guide.last.push(last);
        guide
    }
}

impl std::fmt::Display for Guide {
    /// The alternate form is that of a ray's first line.
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let shown = &self.last[..self.last.len().min(MAX_INDENT)];
        let Some((own, above)) = shown.split_last() else {
            return Ok(());
        };
        for last in above {
            f.write_str(if *last { "   " } else { "│  " })?;
        }
        f.write_str(match (f.alternate(), own) {
            (true, false) => "├─ ",
            (true, true) => "└─ ",
            (false, false) => "│  ",
            (false, true) => "   ",
        })
    }
}

/// A ray in one line.
pub(crate) fn title(ray: &Ray) -> String {
    let kind = match (ray.kind.as_str(), ray.light) {
        ("shadow", Some(light)) => format!("shadow ray to light {light}"),
        ("occlusion", _) => "occlusion ray".to_owned(),
        (kind, _) if ray.step > 0 => format!("{kind} ray, bounce {}", ray.step),
        (kind, _) => format!("{kind} ray"),
    };
    format!("{}  {kind}: {}", ray.ray, outcome(ray))
}

/// What became of a ray.
fn outcome(ray: &Ray) -> String {
    match ray.end.as_str() {
        "background" => "meets nothing, sees the background".to_owned(),
        "maximum depth" => "not sent: light has bounced as often as is allowed".to_owned(),
        "unimportant" => "not sent: less than 1/1000 of its light would count".to_owned(),
        "free" if ray.crossed.is_empty() => "nothing is in the way".to_owned(),
        "free" => format!("dimmed by {}", counted(ray.crossed.len(), "surface")),
        "blocked" => match ray.crossed.iter().find(|one| one.transmission.is_none()) {
            Some(opaque) => format!("blocked by {}", surface(&opaque.surface)),
            None => "blocked".to_owned(),
        },
        end => {
            let what = ray
                .met
                .as_ref()
                .map_or(String::new(), |met| surface(&met.surface));
            let lamp = if end == "light source" {
                ", a light source"
            } else {
                ""
            };
            format!("meets {what}{lamp}")
        }
    }
}

fn surface(surface: &SurfaceName) -> String {
    let SurfaceName {
        object,
        name,
        shape,
        material,
        ..
    } = surface;
    format!("\"{name}\" (object {object}, {shape}, {material})")
}

/// The lines below a ray's title.
fn lines(ray: &Ray, all: &[Ray]) -> Vec<String> {
    let mut lines = Vec::new();
    let mut line = |label: &str, text: String| lines.push(format!("{label:<10}{text}"));
    let end = match ray.t_max.0 {
        t if t.is_finite() => format!(" for t up to {}", short(t)),
        _ => String::new(),
    };
    let (from, along) = (triple(&ray.origin), triple(&ray.direction));
    line("from", format!("{from} along {along}{end}"));
    if let Some(met) = &ray.met {
        place(met, &mut line);
    }
    for crossed in &ray.crossed {
        line("crosses", crossing(crossed));
    }
    let sent = !matches!(ray.end.as_str(), "maximum depth" | "unimportant");
    if sent {
        line(
            "cost",
            format!(
                "{} visited, {} made",
                counted(ray.nodes_visited as usize, "node"),
                counted(ray.tests_made as usize, "test")
            ),
        );
    }
    for (label, part) in [
        ("emission", &ray.emission),
        ("ambient", &ray.ambient),
        ("measured", &ray.measured),
    ] {
        // Of what a surface has not there is nothing to say.
        let black = |part: &&[Number; 3]| **part == [Number(0.0); 3] && label != "measured";
        if let Some(part) = part.as_ref().filter(|part| !black(part)) {
            line(label, colour(part));
        }
    }
    for lit in &ray.lights {
        light(lit, all, &mut line);
    }
    if let Some(split) = &ray.split {
        let mirrored = split.mirrored.0;
        let text = if split.total_internal_reflection {
            "total internal reflection: nothing goes through".to_owned()
        } else {
            format!(
                "{:.1} % is mirrored, {:.1} % goes through",
                mirrored * 100.0,
                (1.0 - mirrored) * 100.0
            )
        };
        line(
            "glass",
            format!("{text} (index ratio {})", short(split.eta.0)),
        );
    }
    if let Some(absorbed) = &ray.absorbed {
        let (way, left) = (short(absorbed.way.0), colour(&absorbed.left));
        line(
            "absorbed",
            format!("over a way of {way}: {left} of the light is left"),
        );
    }
    let brings = match ray.kind.as_str() {
        "shadow" => "lets by",
        _ => "brings",
    };
    line(brings, colour(&ray.radiance));
    if ray.parent.is_some() {
        let ([a, b, c], [x, y, z]) = (ray.weight, ray.radiance);
        let product = [a.0 * x.0, b.0 * y.0, c.0 * z.0].map(Number);
        line(
            "counts",
            format!("{} times that: {}", colour(&ray.weight), colour(&product)),
        );
        if ray.step > 1 || (ray.step == 1 && ray.kind == "shadow") {
            line("in pixel", colour(&ray.weight_in_pixel));
        }
    }
    lines
}

fn place(met: &Met, line: &mut impl FnMut(&str, String)) {
    let [u, v] = met.uv.map(|x| short(x.0));
    line(
        "at",
        format!(
            "{}, t = {}, on its {}, primitive {}, uv {u} {v}",
            triple(&met.point),
            short(met.t.0),
            met.side,
            met.surface.primitive
        ),
    );
    let shading = if met.normal == met.shading_normal {
        String::new()
    } else {
        format!(", to shade with {}", triple(&met.shading_normal))
    };
    line("normal", format!("{}{shading}", triple(&met.normal)));
}

fn crossing(crossed: &Crossed) -> String {
    let SurfaceName { name, object, .. } = &crossed.surface;
    let what = format!("\"{name}\" (object {object})");
    let t = short(crossed.t.0);
    match &crossed.transmission {
        None => format!("{what} at t = {t}, opaque"),
        Some(through) => format!("{what} at t = {t}, lets {} by", colour(through)),
    }
}

fn light(lit: &Lit, all: &[Ray], line: &mut impl FnMut(&str, String)) {
    let label = format!("light {}", lit.light);
    let kind = &lit.kind;
    let Some(ray) = lit.ray else {
        line(&label, format!("{kind}: {}", lit.way));
        return;
    };
    let seen = match all.get(ray).map(|shadow| shadow.end.as_str()) {
        Some("blocked") => "in its shade",
        _ => "lit",
    };
    line(&label, format!("{kind}: {seen}, ray {ray}"));
    line(" diffuse", colour(&lit.diffuse));
    if lit.specular != [Number(0.0); 3] {
        line(" specular", colour(&lit.specular));
    }
}

/// A number and what it counts.
pub(crate) fn counted(count: usize, word: &str) -> String {
    let ending = if count == 1 { "" } else { "s" };
    format!("{count} {word}{ending}")
}
