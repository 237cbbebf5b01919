//! Nodes: where everything stands (section 3.5 of the specification).

use super::buffer::no_such;
use super::document::{Document, NodeSpec};
use super::wrong;
use crate::error::FormatError;

/// The rows of a 3 × 4 matrix: linear part, then translation.
pub(super) type Matrix = [[f64; 4]; 3];

pub(super) const IDENTITY: Matrix = [
    [1.0, 0.0, 0.0, 0.0],
    [0.0, 1.0, 0.0, 0.0],
    [0.0, 0.0, 1.0, 0.0],
];

/// A node of the scene that is shown.
#[derive(Clone, Copy, Debug)]
pub(super) struct Placed {
    /// Which node.
    pub(super) node: usize,
    /// From its space to that of the scene.
    pub(super) matrix: Matrix,
}

/// The nodes of the scene that is shown, parents before their children and these in the order of the
/// file. Without a `scene` it is the first one; without any scene, all nodes are shown.
pub(super) fn placed(document: &Document) -> Result<Vec<Placed>, FormatError> {
    let parents = parents(document)?;
    refuse_cycles(&parents)?;
    let roots = roots(document, &parents)?;
    let mut placed = Vec::new();
    // The last is taken first.
    let mut waiting: Vec<(usize, Matrix)> =
        roots.into_iter().rev().map(|n| (n, IDENTITY)).collect();
    while let Some((node, parent)) = waiting.pop() {
        let spec = &document.nodes[node];
        let matrix = product(&parent, &local(spec, &format!("nodes[{node}]"))?);
        placed.push(Placed { node, matrix });
        waiting.extend(spec.children.iter().rev().map(|&child| (child, matrix)));
    }
    Ok(placed)
}

/// The parent of each node.
fn parents(document: &Document) -> Result<Vec<Option<usize>>, FormatError> {
    let count = document.nodes.len();
    let mut parents: Vec<Option<usize>> = vec![None; count];
    for (node, spec) in document.nodes.iter().enumerate() {
        for (i, &child) in spec.children.iter().enumerate() {
            let place = || format!("nodes[{node}].children[{i}]");
            let parent = parents
                .get_mut(child)
                .ok_or_else(|| wrong(place(), no_such("nodes", child, count)))?;
            if let Some(other) = parent {
                let message = format!(
                    "nodes[{child}] is a child of nodes[{other}] already; a node has one parent \
                     at most"
                );
                return Err(wrong(place(), message));
            }
            *parent = Some(node);
        }
    }
    Ok(parents)
}

/// Nodes that are their own ancestors are refused. Every node has one parent at most, so it is enough
/// to climb from each until a node that was climbed over before.
fn refuse_cycles(parents: &[Option<usize>]) -> Result<(), FormatError> {
    let mut climbed_from = vec![usize::MAX; parents.len()];
    for start in 0..parents.len() {
        let mut at = start;
        while climbed_from[at] == usize::MAX {
            climbed_from[at] = start;
            match parents[at] {
                Some(parent) => at = parent,
                None => break,
            }
        }
        let met_itself = climbed_from[at] == start && parents[at].is_some();
        if met_itself {
            return Err(wrong(format!("nodes[{at}]"), cycle(parents, at)));
        }
    }
    Ok(())
}

/// The way down around a cycle, such as "nodes\[0\] -> nodes\[1\] -> nodes\[0\]".
fn cycle(parents: &[Option<usize>], node: usize) -> String {
    const SHOWN: usize = 8;
    let mut names = vec![format!("nodes[{node}]")];
    let mut at = parents[node];
    while let Some(above) = at {
        names.push(format!("nodes[{above}]"));
        if above == node {
            break;
        }
        if names.len() > SHOWN {
            names.push("...".to_owned());
            break;
        }
        at = parents[above];
    }
    names.reverse();
    format!(
        "the nodes have a cycle, {}; they have to make trees",
        names.join(" -> ")
    )
}

fn roots(document: &Document, parents: &[Option<usize>]) -> Result<Vec<usize>, FormatError> {
    let count = document.nodes.len();
    if document.scenes.is_empty() && document.scene.is_none() {
        return Ok((0..count).filter(|&node| parents[node].is_none()).collect());
    }
    let scene = document.scene.unwrap_or(0);
    let spec = document.scenes.get(scene).ok_or_else(|| {
        let count = document.scenes.len();
        wrong("scene", no_such("scenes", scene, count))
    })?;
    let mut seen = vec![false; count];
    for (i, &node) in spec.nodes.iter().enumerate() {
        let place = || format!("scenes[{scene}].nodes[{i}]");
        let seen = seen
            .get_mut(node)
            .ok_or_else(|| wrong(place(), no_such("nodes", node, count)))?;
        if *seen {
            let message = format!("nodes[{node}] is in the scene already");
            return Err(wrong(place(), message));
        }
        if let Some(parent) = parents[node] {
            let message = format!(
                "nodes[{node}] is a child of nodes[{parent}]; a scene lists nodes without parents"
            );
            return Err(wrong(place(), message));
        }
        *seen = true;
    }
    Ok(spec.nodes.clone())
}

/// What a node says of itself: a matrix, or a scale, then a rotation, then a translation.
fn local(spec: &NodeSpec, place: &str) -> Result<Matrix, FormatError> {
    match &spec.matrix {
        Some(m) => of_columns(m, place),
        None => of_parts(
            spec.translation.unwrap_or_default(),
            spec.rotation.unwrap_or([0.0, 0.0, 0.0, 1.0]),
            spec.scale.unwrap_or([1.0; 3]),
        )
        .ok_or_else(|| {
            let message = format!(
                "is {:?}; a unit quaternion [x, y, z, w] is right",
                spec.rotation.unwrap_or_default()
            );
            wrong(format!("{place}.rotation"), message)
        }),
    }
}

fn of_columns(m: &[f64; 16], place: &str) -> Result<Matrix, FormatError> {
    let last = [m[3], m[7], m[11], m[15]];
    if last != [0.0, 0.0, 0.0, 1.0] {
        let message = format!("has the last row {last:?}; [0, 0, 0, 1] is right");
        return Err(wrong(format!("{place}.matrix"), message));
    }
    Ok(std::array::from_fn(|row| {
        std::array::from_fn(|column| m[4 * column + row])
    }))
}

/// First the scale, then the rotation (a quaternion of any length but 0), then the translation;
/// `None` if the quaternion has no length.
pub(super) fn of_parts(t: [f64; 3], q: [f64; 4], s: [f64; 3]) -> Option<Matrix> {
    let length = q.iter().map(|x| x * x).sum::<f64>().sqrt();
    if !(length > 0.0 && length.is_finite()) {
        return None;
    }
    let [x, y, z, w] = q.map(|x| x / length);
    let rotation = [
        [
            1.0 - 2.0 * (y * y + z * z),
            2.0 * (x * y - z * w),
            2.0 * (x * z + y * w),
        ],
        [
            2.0 * (x * y + z * w),
            1.0 - 2.0 * (x * x + z * z),
            2.0 * (y * z - x * w),
        ],
        [
            2.0 * (x * z - y * w),
            2.0 * (y * z + x * w),
            1.0 - 2.0 * (x * x + y * y),
        ],
    ];
    Some(std::array::from_fn(|i| {
        let [a, b, c] = rotation[i];
        [a * s[0], b * s[1], c * s[2], t[i]]
    }))
}

/// `a` after `b`.
pub(super) fn product(a: &Matrix, b: &Matrix) -> Matrix {
    std::array::from_fn(|i| {
        std::array::from_fn(|j| {
            let last = if j == 3 { a[i][3] } else { 0.0 };
            a[i][0] * b[0][j] + a[i][1] * b[1][j] + a[i][2] * b[2][j] + last
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn nodes(nodes: &str, rest: &str) -> Result<Vec<(usize, Matrix)>, String> {
        let json = format!(r#"{{"asset": {{"version": "2.0"}}, "nodes": [{nodes}]{rest}}}"#);
        let document = super::super::document::parse(json.as_bytes()).unwrap();
        placed(&document)
            .map(|placed| placed.iter().map(|p| (p.node, p.matrix)).collect())
            .map_err(|error| error.to_string())
    }

    fn order(list: &str, rest: &str) -> Vec<usize> {
        nodes(list, rest).unwrap().iter().map(|p| p.0).collect()
    }

    #[test]
    fn parents_come_before_children_in_the_order_of_the_file() {
        let list = r#"{"children": [2, 1]}, {}, {"children": [3]}, {}, {}"#;
        assert_eq!(order(list, ""), [0, 2, 3, 1, 4]);
        assert_eq!(
            order(list, r#", "scenes": [{"nodes": [4, 0]}]"#),
            [4, 0, 2, 3, 1]
        );
        let two = r#", "scene": 1, "scenes": [{"nodes": [0]}, {"nodes": [4]}]"#;
        assert_eq!(order(list, two), [4]);
        assert_eq!(order(list, r#", "scenes": [{}]"#), [0; 0]);
    }

    #[test]
    fn a_chain_of_any_length_is_followed() {
        let count = 100_000;
        let list: Vec<_> = (1..count)
            .map(|i| format!(r#"{{"children": [{i}], "translation": [1, 0, 0]}}"#))
            .collect();
        let placed = nodes(&(list.join(",") + ", {}"), "").unwrap();
        assert_eq!(placed.len(), count);
        assert_eq!(placed[count - 1].1[0][3], (count - 1) as f64);
    }

    #[test]
    fn a_matrix_and_its_parts_are_the_same() {
        let half = std::f64::consts::FRAC_1_SQRT_2;
        let parts = format!(
            r#"{{"translation": [1, 2, 3], "rotation": [0, 0, {half}, {half}], "scale": [2, 3, 4]}}"#
        );
        let matrix = r#"{"matrix": [0, 2, 0, 0, -3, 0, 0, 0, 0, 0, 4, 0, 1, 2, 3, 1]}"#;
        let [a, b] = [&parts[..], matrix].map(|node| nodes(node, "").unwrap()[0].1);
        for (a, b) in a.iter().flatten().zip(b.iter().flatten()) {
            assert!((a - b).abs() < 1e-12, "{a} {b}");
        }
        let long = format!(r#"{{"rotation": [0, 0, {half}, {half}]}}"#).replace("0.7", "7");
        assert!(nodes(&long, "").is_ok(), "of any length");
    }

    #[test]
    fn graphs_that_are_no_trees_are_refused() {
        let error = |list: &str, rest: &str| nodes(list, rest).unwrap_err();
        assert_eq!(
            error(r#"{"children": [1]}, {"children": [0]}"#, ""),
            "nodes[0]: the nodes have a cycle, nodes[0] -> nodes[1] -> nodes[0]; they have to \
             make trees"
        );
        assert!(error(r#"{"children": [0]}"#, "").contains("nodes[0] -> nodes[0]"));
        let tail = r#"{}, {"children": [2]}, {"children": [1]}"#;
        assert!(error(tail, "").contains("cycle"));
        let two_parents = r#"{"children": [2]}, {"children": [2]}, {}"#;
        assert_eq!(
            error(two_parents, ""),
            "nodes[1].children[0]: nodes[2] is a child of nodes[0] already; a node has one parent \
             at most"
        );
        assert!(error(r#"{"children": [1, 1]}, {}"#, "").contains("already"));
        assert_eq!(
            error(r#"{"children": [7]}"#, ""),
            "nodes[0].children[0]: refers to nodes[7], but there is only nodes[0]"
        );
        let scene = |nodes| format!(r#", "scenes": [{{"nodes": [{nodes}]}}]"#);
        assert!(error("{}", &scene("3")).starts_with("scenes[0].nodes[0]: refers to nodes[3]"));
        assert!(error("{}", &scene("0, 0")).contains("in the scene already"));
        let child = r#"{"children": [1]}, {}"#;
        assert!(error(child, &scene("0, 1")).contains("a child of nodes[0]"));
        assert!(error("{}", r#", "scene": 2"#).contains("refers to scenes[2]"));
    }

    #[test]
    fn transforms_that_are_none_are_refused() {
        let error = |node: &str| nodes(node, "").unwrap_err();
        assert!(error(r#"{"rotation": [0, 0, 0, 0]}"#).contains("a unit quaternion"));
        let perspective = r#"{"matrix": [1, 0, 0, 1, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]}"#;
        assert!(error(perspective).starts_with("nodes[0].matrix: has the last row"));
    }
}
