//! Words that do not lie on one another.

use super::view::Place;

/// A rectangle that something takes up: left, top, right, bottom.
pub(crate) type Taken = [f64; 4];

/// What is on the page so far.
#[derive(Debug, Default)]
pub(crate) struct Labels {
    taken: Vec<Taken>,
    lines: Vec<[Place; 2]>,
}

/// The size of the letters of labels, in pixels.
pub(crate) const LETTERS: f64 = 11.0;

impl Labels {
    /// A line that labels had better not lie on.
    pub(crate) fn add_line(&mut self, line: [Place; 2]) {
        self.lines.push(line);
    }

    /// A place that no label may take.
    pub(crate) fn take(&mut self, taken: Taken) {
        self.taken.push(taken);
    }

    /// The one of some middles of a text at which it covers no other text, and as few lines as may be;
    /// none if there is no room.
    pub(crate) fn find(
        &mut self,
        text: &str,
        middles: impl IntoIterator<Item = Place>,
        within: Taken,
    ) -> Option<Place> {
        let half = [
            0.31 * LETTERS * text.chars().count() as f64 + 1.5,
            LETTERS * 0.5 + 1.0,
        ];
        let mut best: Option<(usize, Place, Taken)> = None;
        for [x, y] in middles {
            let place = [x - half[0], y - half[1], x + half[0], y + half[1]];
            let inside = place[0] >= within[0]
                && place[1] >= within[1]
                && place[2] <= within[2]
                && place[3] <= within[3];
            if !inside || self.taken.iter().any(|other| overlap(&place, other)) {
                continue;
            }
            let crossed = self
                .lines
                .iter()
                .filter(|line| crosses(line, &place))
                .count();
            if best.as_ref().is_none_or(|(least, ..)| crossed < *least) {
                best = Some((crossed, [x, y], place));
            }
        }
        let (_, middle, place) = best?;
        self.taken.push(place);
        Some(middle)
    }
}

fn overlap(a: &Taken, b: &Taken) -> bool {
    a[0] < b[2] && b[0] < a[2] && a[1] < b[3] && b[1] < a[3]
}

/// Whether a segment passes through a rectangle, by its points a few pixels apart.
fn crosses([from, to]: &[Place; 2], rectangle: &Taken) -> bool {
    let apart = [
        from[0].min(to[0]),
        from[1].min(to[1]),
        from[0].max(to[0]),
        from[1].max(to[1]),
    ];
    if !overlap(
        &[
            apart[0] - 0.1,
            apart[1] - 0.1,
            apart[2] + 0.1,
            apart[3] + 0.1,
        ],
        rectangle,
    ) {
        return false;
    }
    let length = (to[0] - from[0]).hypot(to[1] - from[1]);
    let steps = (length / 3.0).ceil().max(1.0) as usize;
    (0..=steps).any(|i| {
        let s = i as f64 / steps as f64;
        let (x, y) = (
            from[0] + (to[0] - from[0]) * s,
            from[1] + (to[1] - from[1]) * s,
        );
        (rectangle[0]..=rectangle[2]).contains(&x) && (rectangle[1]..=rectangle[3]).contains(&y)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn labels_keep_off_one_another_and_off_lines() {
        let page = [0.0, 0.0, 100.0, 100.0];
        let mut labels = Labels::default();
        labels.add_line([[0.0, 20.0], [100.0, 20.0]]);
        let candidates = [[50.0, 20.0], [50.0, 50.0]];
        assert_eq!(labels.find("12", candidates, page), Some([50.0, 50.0]));
        assert_eq!(labels.find("13", candidates, page), Some([50.0, 20.0]));
        assert_eq!(labels.find("14", candidates, page), None, "no room is left");
    }
}
