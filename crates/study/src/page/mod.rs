//! The page: plots, and under each a sentence that is worked out from what it shows.

mod costs;
mod overall;
mod santos;
mod speeds;
mod steps;
mod tables;
mod trade;

use std::fmt::Write as _;

use crate::family::Family;
use crate::html::{document, escaped};
use crate::numbers::{counted, grouped, list};
use crate::{SceneReport, Study, plot};

const STYLE: &str = "
body { background: var(--paper); color: var(--ink); }
main > p, figcaption, section > p { max-width: 46rem; }
.lead { font-size: 1.05rem; } .quietly { color: var(--quiet); font-size: .9rem; }
h2 { font-size: 1.25rem; margin: 2.5rem 0 .25rem; padding-top: 1rem; border-top: 1px solid var(--line); }
h3 { font-size: 1rem; margin: 1.5rem 0 .25rem; }
figure { margin: 2rem 0 0; overflow-x: auto; } .plot[viewBox^='0 0 800'] { min-width: 36rem; } .panels + figure, section > .panels { margin-top: 2rem; } figcaption { margin: .5rem 0 0; }
.panels { display: grid; grid-template-columns: repeat(auto-fit, minmax(min(100%, 27rem), 1fr)); gap: 1.25rem 2rem; }
.panels > figure { margin: 0; } .plot { display: block; width: 100%; height: auto; }
.families { display: flex; flex-wrap: wrap; gap: .25rem 1.25rem; padding: 0; list-style: none; font-size: .9rem; }
.families li::before { content: ''; display: inline-block; width: .75em; height: .75em; border-radius: 50%;
  background: currentColor; margin-right: .45em; } .families span { color: var(--ink); }
nav ul { display: flex; flex-wrap: wrap; gap: .25rem 1.25rem; padding: 0; list-style: none; }
a { color: var(--kd); } summary { cursor: pointer; margin: 1rem 0 .5rem; }
.wide + .wide { margin-top: 1.25rem; }
";

impl Study {
    /// The study as one page in HTML that needs no other file and no script.
    #[must_use]
    pub fn page(&self) -> String {
        let mut content = String::new();
        // Writing to a string does not fail.
        let _ = write!(
            content,
            "<h1>Structures, and ways to walk them</h1>\n<p class=\"lead\">{}</p>\n",
            escaped(&self.summary())
        );
        content += &self.notes_in_html();
        content += &self.contents();
        content += &self.families();
        content += &overall::section(self);
        for (index, scene) in self.scenes.iter().enumerate() {
            content += &self.scene(index, scene);
        }
        content += &santos::section(self);
        content += HOW;
        let style = format!("{}{STYLE}", plot::STYLE);
        document("Structures, and ways to walk them", &style, &content, None)
    }

    /// Memory against speed over all scenes, as a drawing in SVG that stands alone; `None` where
    /// nothing was on the clock.
    #[must_use]
    pub fn drawing(&self) -> Option<String> {
        overall::drawing(self)
    }

    fn summary(&self) -> String {
        let structures = self.structures().len() as u64;
        let rays = u64::from(self.size[0]) * u64::from(self.size[1]);
        let threads: Vec<_> = self.threads.iter().map(usize::to_string).collect();
        format!(
            "{} in {}, {} of each kind from a picture of {} × {} pixels, {} on {} of {} ({}), \
             by ombra {}. All answers were compared bit for bit before the clock ran; none differs.",
            counted(structures, "structure"),
            counted(self.scenes.len() as u64, "scene"),
            counted(rays, "ray"),
            self.size[0],
            self.size[1],
            counted(self.rounds as u64, "round"),
            if threads.len() == 1 && threads[0] == "1" {
                "1 thread".to_owned()
            } else {
                format!("{} threads", list(&threads))
            },
            self.machine.cpu,
            self.machine.target,
            self.ombra,
        )
    }

    /// What a reader must know before comparing anything, a line each.
    pub(crate) fn notes(&self) -> Vec<String> {
        let mut notes = Vec::new();
        if self.interrupted {
            notes.push(
                "This study was interrupted; what is here is what was measured until then."
                    .to_owned(),
            );
        }
        for scene in &self.scenes {
            for set in scene.workloads.iter().filter(|set| set.rays == 0) {
                notes.push(format!(
                    "{}: there are no {} rays.",
                    scene.scene, set.workload
                ));
            }
            for (structure, fewer) in subsets_by_structure(scene) {
                notes.push(format!(
                    "{}: {structure} got {}: all would take too long.",
                    scene.scene,
                    list(&fewer)
                ));
            }
        }
        notes
    }

    fn notes_in_html(&self) -> String {
        let notes = self.notes();
        let (first, rest) = match self.interrupted {
            true => notes.split_at(1),
            false => notes.split_at(0),
        };
        let mut text = String::new();
        for note in first {
            let _ = writeln!(text, "<p><strong>{}</strong></p>", escaped(note));
        }
        if !rest.is_empty() {
            text += "<details><summary>What got fewer rays, or none</summary>\n<ul>\n";
            for note in rest {
                let _ = writeln!(text, "<li>{}</li>", escaped(note));
            }
            text += "</ul>\n</details>\n";
        }
        text
    }

    fn contents(&self) -> String {
        let mut text =
            "<nav aria-label=\"Contents\"><ul>\n<li><a href=\"#all\">All scenes</a></li>\n"
                .to_owned();
        for (index, scene) in self.scenes.iter().enumerate() {
            let _ = writeln!(
                text,
                "<li><a href=\"#scene{index}\">{}</a></li>",
                escaped(&scene.scene)
            );
        }
        if self.santos.is_some() {
            text += "<li><a href=\"#santos\">Against the study of 2014</a></li>\n";
        }
        text + "<li><a href=\"#how\">How this was measured</a></li>\n</ul></nav>\n"
    }

    fn families(&self) -> String {
        let structures = self.structures();
        let there = |family: &Family| structures.iter().any(|name| Family::of(name) == *family);
        let mut text = "<ul class=\"families\" aria-label=\"Colours\">\n".to_owned();
        for family in Family::ALL.iter().filter(|family| there(family)) {
            let (class, name) = (family.class(), family.name());
            let _ = writeln!(text, "<li class=\"{class}\"><span>{name}</span></li>");
        }
        text + "</ul>\n"
    }

    fn scene(&self, index: usize, scene: &SceneReport) -> String {
        let mut text = format!(
            "<section aria-labelledby=\"scene{index}\">\n<h2 id=\"scene{index}\">{}</h2>\n<p>{}</p>\n",
            escaped(&scene.scene),
            escaped(&about(scene))
        );
        text += &speeds::figure(self, scene);
        text += "<div class=\"panels\">\n";
        text += &trade::figure(self, scene);
        text += &steps::figure(self, scene);
        text += "</div>\n";
        text += &costs::figure(self, scene);
        text += &tables::details(self, scene);
        text + "</section>\n"
    }
}

/// Which structures got fewer rays than there are, and how many of which kinds.
fn subsets_by_structure(scene: &SceneReport) -> Vec<(&'static str, Vec<String>)> {
    let mut found: Vec<(&str, Vec<String>)> = Vec::new();
    for (structure, workload, rays, all) in scene.subsets() {
        let (rays, all) = (grouped(rays as u64), grouped(all as u64));
        let said = format!("{rays} of {all} {workload} rays");
        match found.iter_mut().find(|(name, _)| *name == structure) {
            Some((_, fewer)) => fewer.push(said),
            None => found.push((structure, vec![said])),
        }
    }
    found
}

/// A scene and its rays.
fn about(scene: &SceneReport) -> String {
    let what = match scene.line {
        "" => String::new(),
        line => format!("{line}; "),
    };
    let rays: Vec<_> = scene
        .workloads
        .iter()
        .filter(|set| set.rays > 0)
        .map(|set| {
            let share = 100.0 * set.hits as f64 / set.rays as f64;
            format!("{share:.0} % of the {} rays", set.workload)
        })
        .collect();
    let mut text = format!(
        "{what}{}; {} hit something.",
        counted(scene.primitives as u64, "primitive"),
        list(&rays)
    );
    if let Some(first) = text.get(..1) {
        let upper = first.to_uppercase();
        text.replace_range(..1, &upper);
    }
    text
}

/// A plot with its sentence.
fn figure(svg: &str, says: &str) -> String {
    format!(
        "<figure>\n{svg}<figcaption>{}</figcaption>\n</figure>\n",
        escaped(says)
    )
}

const HOW: &str = "<section aria-labelledby=\"how\">
<h2 id=\"how\">How this was measured</h2>
<p><strong>Rays.</strong> Primary rays go from the camera through the middle of each pixel, row by row. Diffuse rays go
from where those end into random directions over the surface, by the cosine. Shadow rays go from there to the lights in
turn and ask whether anything is in between; any hit will do. Random rays begin anywhere in the box around the scene and
go anywhere. Ray i + 1 of the first three kinds starts near ray i; random rays have nothing in common.</p>
<p><strong>Answers.</strong> Each structure answers every ray alone and in batches; both must be those of the default
structure, to the bit. If one differs there is no page.</p>
<p><strong>Counts.</strong> Nodes are boxes or planes tested and cells entered, so nodes of different structures are
different things. Tests are primitives tested. Both are means over the rays and the same on every machine.</p>
<p><strong>Times.</strong> In each round every structure is built and answers each kind of rays, in turns, each round beginning
with another one, so that what else the machine does falls on all alike. Bars are medians of the rounds, thin lines go
from quartile to quartile. Rays are asked in batches, all threads taking from one heap. Speed over several kinds of rays
or scenes is the geometric mean, in which none counts more than another.</p>
<p><strong>Memory.</strong> The structure alone, on both levels of instancing: without the primitives, but of a mesh the wide trees (<code>bvh8</code> and its kin) hold the triangles themselves.</p>
</section>
";
