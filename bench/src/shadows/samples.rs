//! One sun a minute.

use ombra_sun::{Sky, Span};

/// Seconds from sample to sample.
pub(crate) const STEP: f64 = 60.0;

/// Directions a packet.
const LANES: usize = 16;

/// The directions to the sun in the middles of minutes, ready for rays.
#[derive(Debug)]
pub(crate) struct Samples {
    spans: Vec<OfSpan>,
}

#[derive(Debug)]
struct OfSpan {
    /// What a sample stands for: a minute or a little less.
    seconds: f64,
    directions: Vec<[f32; 3]>,
    /// By packet and axis.
    packed: Vec<[[f32; LANES]; 3]>,
}

impl Samples {
    pub(crate) fn new(sky: &Sky, spans: &[Span]) -> Self {
        let of_span = |span: &Span| {
            let (seconds, middles) = span.middles(STEP);
            let directions: Vec<[f32; 3]> = middles
                .map(|instant| sky.direction(instant).map(|x| x as f32))
                .collect();
            let pack = |chunk: &[[f32; 3]]| {
                let lane = |k: usize| chunk[k.min(chunk.len() - 1)];
                [0, 1, 2].map(|axis| std::array::from_fn(|k| lane(k)[axis]))
            };
            OfSpan {
                seconds,
                packed: directions.chunks(LANES).map(pack).collect(),
                directions,
            }
        };
        Self {
            spans: spans.iter().map(of_span).collect(),
        }
    }

    /// How many there are.
    pub(crate) fn count(&self) -> usize {
        self.spans.iter().map(|span| span.directions.len()).sum()
    }

    /// Hands out the directions of each span, and the seconds that one stands for.
    #[inline]
    pub(crate) fn each(&self, mut take: impl FnMut(&[[f32; 3]], f64)) {
        for span in &self.spans {
            take(&span.directions, span.seconds);
        }
    }

    /// The seconds of all that `blocked` counts.
    #[inline]
    pub(crate) fn sum(&self, mut blocked: impl FnMut(&[[f32; 3]]) -> u32) -> f64 {
        let mut sum = 0.0;
        self.each(|directions, seconds| sum += seconds * f64::from(blocked(directions)));
        sum
    }

    /// Hands out sixteen directions at a time, how many of them count, and the seconds of one.
    #[inline]
    pub(crate) fn each_packed(&self, mut take: impl FnMut(&[[f32; LANES]; 3], usize, f64)) {
        for span in &self.spans {
            for (k, packed) in span.packed.iter().enumerate() {
                let count = (span.directions.len() - k * LANES).min(LANES);
                take(packed, count, span.seconds);
            }
        }
    }
}
