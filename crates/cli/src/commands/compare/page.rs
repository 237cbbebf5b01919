//! The page that wipes from one picture to the other: one file that needs nothing else.

use std::fmt::Write as _;

use ombra_study::html::{self, document, escaped};

use super::report::{Report, Row, grouped, percent};

const STYLE: &str = "
:root { --wipe: 50%; }
.parts { display: flex; flex-wrap: wrap; gap: 1.5rem; align-items: flex-start; }
.pictures { flex: 2 1 30rem; min-width: 0; }
.numbers { flex: 1 1 16rem; min-width: 0; }
.wipe { position: relative; line-height: 0; background: #000; }
.wipe img { width: 100%; height: auto; image-rendering: auto; }
.wipe .over { position: absolute; inset: 0; clip-path: inset(0 0 0 var(--wipe)); }
.wipe .bar { position: absolute; top: 0; bottom: 0; left: var(--wipe); width: 2px;
  margin-left: -1px; background: #fff; box-shadow: 0 0 0 1px #000; pointer-events: none; }
.ends { display: flex; justify-content: space-between; gap: 1rem; font-size: .9rem; }
input[type=range] { width: 100%; margin: .5rem 0 0; }
figure img { width: 100%; height: auto; background: #000; }
";

const SCRIPT: &str = "
const slider = document.getElementById('wipe');
const set = () => {
  document.documentElement.style.setProperty('--wipe', slider.value + '%');
  slider.setAttribute('aria-valuetext', slider.value + ' % rasterized');
};
slider.addEventListener('input', set);
set();
";

/// The page. Pictures are given as URLs that hold them.
pub(super) fn html(report: &Report<'_>, raster: &str, whitted: &str, difference: &str) -> String {
    let scene = escaped(report.scene);
    let (width, height) = (report.width, report.height);
    let size = format!("width=\"{width}\" height=\"{height}\"");
    let numbers = numbers(report);
    let resolutions = table("The more pixels", "picture", &report.resolutions);
    let primitives = table("The more triangles", "scene", &report.primitives);
    let content = format!(
        "<h1>{scene}: two loops, one scene</h1>
<div class=\"parts\">
<section class=\"pictures\" aria-label=\"Pictures\">
<div class=\"wipe\">
<img src=\"{raster}\" {size} alt=\"{scene}, rasterized: local shading alone\">
<img class=\"over\" src=\"{whitted}\" {size} alt=\"{scene} by Whitted's ray tracing: with shadows, mirrors and glass\">
<div class=\"bar\"></div>
</div>
<label for=\"wipe\">Wipe from one to the other (arrow keys, Home and End)</label>
<input id=\"wipe\" type=\"range\" min=\"0\" max=\"100\" value=\"50\" step=\"1\">
<div class=\"ends\"><span>left: rasterized</span><span>right: ray traced</span></div>
<figure>
<img src=\"{difference}\" {size} alt=\"Difference of the two pictures\">
<figcaption>What rays add: the difference of the two, channel by channel.</figcaption>
</figure>
</section>
<section class=\"numbers\" aria-label=\"Numbers\">
<h2>Agreement</h2>
<dl>
{numbers}</dl>
</section>
</div>
<section aria-label=\"Operations\">
<h2>What each loop costs</h2>
<p>Tests at one sample a pixel. Without help either loop tests every primitive with every pixel; that
only the pixels between its edges are looked at helps the rasterizer, the structure ({accel}) helps the rays.</p>
{resolutions}{primitives}</section>
",
        accel = report.accel,
    );
    let title = format!("{}: raster and rays", report.scene);
    document(&title, STYLE, &content, Some(SCRIPT))
}

fn numbers(report: &Report<'_>) -> String {
    let seen = &report.visibility;
    let seconds = &report.seconds;
    let entries = [
        (
            "The same primitive is seen in",
            format!("{} of pixels", percent(seen.same_primitive, seen.pixels)),
        ),
        (
            "The same object in",
            format!("{} of pixels", percent(seen.same_object, seen.pixels)),
        ),
        (
            "Another primitive in",
            format!(
                "{} pixels: {} on edges, {} elsewhere",
                grouped(seen.pixels - seen.same_primitive),
                grouped(seen.differing_on_edges),
                grouped(seen.differing_elsewhere)
            ),
        ),
        ("Raster against rays, local shading", report.shading.words()),
        (
            "Raster against all of Whitted's method",
            report.rays_add.words(),
        ),
        (
            "Time",
            format!(
                "raster {:.2} s, rays with local shading {:.2} s, Whitted {:.2} s ({} rays)",
                seconds.raster,
                seconds.local,
                seconds.whitted,
                grouped(report.whitted_rays)
            ),
        ),
        (
            "Picture",
            format!(
                "{} x {}, {} samples a pixel, seed {}",
                report.width, report.height, report.spp, report.seed
            ),
        ),
    ];
    let mut text = String::new();
    for (what, said) in entries {
        let _ = writeln!(
            text,
            "<dt>{}</dt><dd>{}</dd>",
            escaped(what),
            escaped(&said)
        );
    }
    text
}

fn table(caption: &str, first: &str, rows: &[Row]) -> String {
    let columns = rows.first().map(Row::columns);
    let titles = columns.iter().flatten().map(|(title, _)| *title);
    let heads: Vec<_> = std::iter::once(first).chain(titles).collect();
    let cells = |row: &Row| {
        let numbers = row.columns().map(|(_, number)| grouped(number));
        std::iter::once(row.what.clone()).chain(numbers).collect()
    };
    let rows: Vec<Vec<String>> = rows.iter().map(cells).collect();
    format!(
        "<h2>{caption}</h2>\n{}",
        html::table(caption, &heads, &rows)
    )
}
