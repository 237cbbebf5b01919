//! Against the study of 2014: where we agree, where not, and why.

use std::fmt::Write as _;

use super::figure as framed;
use crate::family::Family;
use crate::html::{escaped, table};
use crate::numbers::{list, percent, short};
use crate::plot::{Mark, Strip};
use crate::santos::{BOXES, ROPES, STACK, THEIR_MEMORY, THEIRS};
use crate::{Pair, Santos, Study, Verdict};

pub(super) fn section(study: &Study) -> String {
    let Some(santos) = &study.santos else {
        return String::new();
    };
    let mut text = format!(
        "<section aria-labelledby=\"santos\">\n<h2 id=\"santos\">Against the study of 2014</h2>\n<p>Santos and others, \
         “Review and Comparative Study of Ray Traversal Algorithms on a Modern GPU Architecture”, WSCG 2014, ran such \
         a comparison on a graphics processor of that year. A kd-tree walked along ropes was 13 to 71 % faster than \
         their bounding volume hierarchy, at up to {THEIR_MEMORY} times the memory. The same two here are {ROPES} \
         and {BOXES}.</p>\n"
    );
    let says = sentence(santos);
    text += &framed(&strip(santos).draw(&says), &says);
    let heads = [
        "scene",
        "rays",
        "speed, ropes over boxes",
        "memory",
        "against 2014",
    ];
    let rows: Vec<_> = santos.pairs.iter().map(row).collect();
    text += "<details><summary>The numbers</summary>\n";
    text += &table("Ropes against boxes", &heads, &rows);
    text += "</details>\n<h3>Why</h3>\n";
    for reason in reasons(study, santos) {
        let _ = writeln!(text, "<p>{}</p>", escaped(&reason));
    }
    text + "</section>\n"
}

fn row(pair: &Pair) -> Vec<String> {
    vec![
        pair.scene.clone(),
        pair.workload.to_string(),
        percent(pair.speed),
        format!("{} ×", short(pair.memory)),
        pair.verdict.words().to_owned(),
    ]
}

fn strip(santos: &Santos) -> Strip<'static> {
    let mut last = "";
    let mut marks = Vec::with_capacity(santos.pairs.len());
    for pair in &santos.pairs {
        let faster = if pair.speed > 1.0 { ROPES } else { BOXES };
        marks.push(Mark {
            name: format!("{}, {}", pair.scene, pair.workload),
            class: Family::of(faster).class(),
            middle: pair.speed,
            range: pair.speed_range,
            said: percent(pair.speed),
            begins: pair.scene != last,
        });
        last = &pair.scene;
    }
    Strip {
        title: "Ropes against boxes",
        axis: "rays a second of kd-ropes over those of bvh; lines go from quartile to quartile",
        marks,
        band: Some((THEIRS, "2014, GPU")),
    }
}

fn sentence(santos: &Santos) -> String {
    let of = |verdict| santos.count(verdict);
    let all = santos.pairs.len();
    let [more, agrees, less, opposite] = [
        Verdict::More,
        Verdict::Agrees,
        Verdict::Less,
        Verdict::Opposite,
    ]
    .map(of);
    let places = |wanted: &[Verdict]| {
        let pairs = santos
            .pairs
            .iter()
            .filter(|pair| wanted.contains(&pair.verdict));
        let names: Vec<_> = pairs
            .map(|pair| format!("{} ({})", pair.scene, pair.workload))
            .collect();
        if names.len() > 6 {
            String::new()
        } else {
            format!(": {}", list(&names))
        }
    };
    let mut text = format!("Of {all} pairs of scene and rays, ");
    text += &match agrees + more {
        0 => "ropes are nowhere ahead by 13 % or more".to_owned(),
        count => format!(
            "ropes are ahead by 13 % or more in {count}{}",
            places(&[Verdict::Agrees, Verdict::More])
        ),
    };
    if less > 0 {
        text += &format!(", by less in {less}");
    }
    text += &format!(
        "; boxes are ahead in {opposite}. Ropes' speed over that of boxes is {} in the mean",
        short(santos.speed)
    );
    text += match santos.speed {
        ratio if ratio >= THEIRS[0] => ": we agree.",
        ratio if ratio > 1.0 => ": the same way, but by less.",
        _ => ": on speed we do not agree.",
    };
    let [least, most] = santos.memory;
    text += &format!(
        " Ropes take {} to {} times the memory of boxes; {}.",
        short(least),
        short(most),
        match most {
            most if most > THEIR_MEMORY => "more even than the 9 times of 2014",
            most if most > 2.0 => "on memory we agree that ropes are dear",
            _ => "less than in 2014",
        }
    );
    text
}

/// Why it is so, as far as this run's own numbers show it.
fn reasons(study: &Study, santos: &Santos) -> Vec<String> {
    let mut reasons = Vec::new();
    if let (Some(speed), Some(nodes)) = (santos.speed_over_stack, santos.nodes_over_stack) {
        reasons.push(format!(
            "What a stack costs. A graphics processor keeps thousands of rays in flight, and a stack for each of them does \
             not fit into registers: it lies in memory, and every push and pop goes there. A walk along ropes has only its \
             leaf to remember. On a CPU core there is one ray at a time; its stack is some hundred bytes that never leave \
             the nearest cache, so there is little to be saved. It shows on the same tree: against {STACK}, ropes visit \
             {} times the nodes and answer {} times the rays a second.",
            short(nodes),
            short(speed),
        ));
    }
    if let (Some(nodes), Some(tests)) = (santos.nodes, santos.tests) {
        reasons.push(format!(
            "What a step does. A node of a kd-tree is one plane, and a triangle that the plane cuts lies on both sides and \
             may be tested twice. In {BOXES} vector instructions test the boxes of two children at once (and count two \
             nodes); a box closes in on a triangle from six sides, where a plane does from one. Here a ray in {ROPES} \
             visits {} times the nodes and makes {} times the tests of one in {BOXES}. A GPU of 2014 ran its vectors across \
             rays, one ray a lane, so to it two boxes were two steps.",
            short(nodes),
            short(tests),
        ));
    }
    let [least, most] = santos.memory;
    reasons.push(format!(
        "What memory costs. A GPU waits for memory by going on with other rays; a core that follows one ray waits. Each \
         leaf with ropes holds its box and six neighbours, and is entered anew from every side, so the {} to {} times \
         of memory here are read, not only held. The larger the scene over the cache, the more that counts{}.",
        short(least),
        short(most),
        by_size(study, santos),
    ));
    reasons.push(
        "What was compared. Their hierarchy and ours are not the same, nor are the trees: builders, the size of leaves and the \
         tests of triangles differ, and our leaves with ropes keep their faces in double precision so that every structure \
         gives the same bits. A ratio of two depends on both. Theirs is one machine and ours is one machine; run this on \
         yours."
            .to_owned(),
    );
    reasons
}

/// The ratio in the smallest and the largest scene.
fn by_size(study: &Study, santos: &Santos) -> String {
    let ratio = |name: &str| {
        let pairs = santos.pairs.iter().filter(|pair| pair.scene == name);
        crate::spread::geometric_mean(pairs.map(|pair| pair.speed))
    };
    let bytes = |scene: &&crate::SceneReport| scene.get(ROPES).map_or(0, |report| report.bytes);
    let small = study.timed_scenes().min_by_key(bytes);
    let large = study.timed_scenes().max_by_key(bytes);
    if let (Some(small), Some(large)) = (small, large)
        && small.scene != large.scene
        && let (Some(in_small), Some(in_large)) = (ratio(&small.scene), ratio(&large.scene))
    {
        return format!(
            ": ropes over boxes is {} in {}, where ropes take {}, and {} in {}, where they take {}",
            short(in_small),
            small.scene,
            crate::numbers::bytes(bytes(&small) as f64),
            short(in_large),
            large.scene,
            crate::numbers::bytes(bytes(&large) as f64),
        );
    }
    String::new()
}
