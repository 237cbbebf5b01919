//! Memory asked for before it is needed.

use ombra_accel::{BoxChild, prefetch};

use crate::occluder::Occluders;

impl Occluders {
    /// Asks for what a child is: it comes while others are looked at.
    #[inline(always)]
    pub(super) fn ask_for(&self, child: BoxChild) {
        const LINE: usize = 64;
        // Addresses of what is not there do no harm.
        let (at, lines) = match child.leaf() {
            // What tells whether it is seen at all.
            Some(which) => (self.list.as_ptr().wrapping_add(which).cast::<u8>(), 1),
            None => {
                let nodes = self.tree.nodes().as_ptr();
                (nodes.wrapping_add(child.node()).cast::<u8>(), 4)
            }
        };
        for line in 0..lines {
            prefetch(at.wrapping_add(LINE * line));
        }
    }
}
