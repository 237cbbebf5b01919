//! Keywords that are passed over, counted.

use std::collections::HashMap;

use crate::finding::Finding;

/// Kinds of keywords that are told apart; a file of garbage has no end of them.
const MOST_KINDS: usize = 32;
const LONGEST: usize = 40;

/// How often each keyword occurs, and where first.
#[derive(Default)]
pub(in crate::mesh) struct Unused {
    counts: HashMap<Vec<u8>, (u64, u64)>,
}

impl Unused {
    pub(in crate::mesh) fn count(&mut self, keyword: &[u8], line: u64) {
        let short = &keyword[..keyword.len().min(LONGEST)];
        if let Some((_, count)) = self.counts.get_mut(short) {
            *count += 1;
        } else if self.counts.len() < MOST_KINDS {
            self.counts.insert(short.to_vec(), (line, 1));
        }
    }

    /// One finding a keyword, in the order of their first lines.
    pub(in crate::mesh) fn report(self, file: Option<&str>, findings: &mut Vec<Finding>) {
        let mut counts: Vec<_> = self.counts.into_iter().collect();
        counts.sort_unstable_by_key(|(_, (line, _))| *line);
        findings.extend(
            counts
                .into_iter()
                .map(|(name, (line, count))| Finding::Unused {
                    what: "keyword",
                    name: String::from_utf8_lossy(&name).into_owned(),
                    count,
                    file: file.map(str::to_owned),
                    line: Some(line),
                }),
        );
    }
}
