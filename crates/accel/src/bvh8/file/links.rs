//! Whether nodes and leaves make one tree.

use super::super::kernel::MAX_DEPTH;
use super::super::node::{Child, Node};
use super::check::{Content, at_node};
use super::fault::{Found, Part, StructureFault};
use super::header::{AT_DEPTH, AT_ROOT};

/// What was seen so far.
struct Seen {
    /// The levels that nodes lie on, from 1; 0 for those that nobody named yet.
    levels: Vec<u8>,
    quads: Vec<bool>,
}

/// Whether each node and each quad has one parent, and the depth is what is stated. That children
/// are there, and after their parents, was asked before: so a node has its level when its turn
/// comes, or nobody names it.
pub(super) fn check(content: &Content<'_>) -> Result<(), Found> {
    let Content {
        header,
        nodes,
        quads,
    } = *content;
    // Both lists are in memory already, and much larger.
    let mut seen = Seen {
        levels: vec![0; nodes.len()],
        quads: vec![false; quads.len()],
    };
    let at_root = |fault| (AT_ROOT as u64, fault);
    seen.child(header.root, 1).map_err(at_root)?;
    let mut depth = 1;
    for (index, node) in nodes.iter().enumerate() {
        let here = |fault| (at_node(index), fault);
        let level = usize::from(seen.levels[index]);
        if level == 0 {
            return Err(here(unnamed(Part::Nodes, index)));
        }
        depth = depth.max(level);
        seen.node(node, level).map_err(here)?;
    }
    if let Some(index) = seen.quads.iter().position(|&named| !named) {
        let at = header.quads_begin() + (index * size_of_val(&quads[0])) as u64;
        return Err((at, unnamed(Part::Quads, index)));
    }
    if depth != header.depth as usize {
        let stated = header.depth;
        let fault = StructureFault::Depth {
            stated,
            found: depth,
        };
        return Err((AT_DEPTH as u64, fault));
    }
    Ok(())
}

fn unnamed(part: Part, index: usize) -> StructureFault {
    StructureFault::Unnamed { part, index }
}

impl Seen {
    fn node(&mut self, node: &Node, level: usize) -> Result<(), StructureFault> {
        let children = node.child.iter().filter(|&&child| child != Child::NONE);
        for &child in children {
            self.child(child, level + 1)?;
        }
        Ok(())
    }

    /// A child, on a level.
    fn child(&mut self, child: Child, level: usize) -> Result<(), StructureFault> {
        if child.is_leaf() {
            let first = child.quad();
            for index in first..first + child.places() / 4 {
                if std::mem::replace(&mut self.quads[index], true) {
                    let part = Part::Quads;
                    return Err(StructureFault::Twice { part, index });
                }
            }
            return Ok(());
        }
        if level > MAX_DEPTH {
            return Err(StructureFault::Deep(level));
        }
        let index = child.index();
        if std::mem::replace(&mut self.levels[index], level as u8) != 0 {
            let part = Part::Nodes;
            return Err(StructureFault::Twice { part, index });
        }
        Ok(())
    }
}
