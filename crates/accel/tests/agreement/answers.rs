//! What a structure answers to a ray, down to the bit.

use ombra_accel::{Accel, AnyHit, Level, Primitives, StructureKind, Traversable};
use ombra_geometry::{Hit, Ray};

/// A hit as bits, so that −0 and 0 differ and NaN equals itself.
pub(crate) type Bits = [u32; 6];

pub(crate) fn bits(hit: &Hit) -> Bits {
    [
        hit.t.to_bits(),
        hit.u.to_bits(),
        hit.v.to_bits(),
        hit.primitive.0,
        hit.geometry.0,
        hit.instance.0,
    ]
}

#[derive(Debug, PartialEq)]
pub(crate) struct Answers {
    closest: Option<Bits>,
    occluded: bool,
    all_hits: Vec<Bits>,
    /// What an any-hit program sees that ignores everything, in sorted order.
    seen: Vec<Bits>,
    /// The closest hit among the primitives with odd numbers.
    closest_odd: Option<Bits>,
}

impl Answers {
    pub(crate) fn of(accel: &impl Traversable, ray: &Ray) -> Self {
        let mut all_hits = Vec::new();
        accel.all_hits(ray, &mut all_hits);
        let mut seen = Vec::new();
        let ignored = accel.trace(ray, &mut |hit| {
            seen.push(bits(hit));
            AnyHit::Ignore
        });
        assert_eq!(ignored, None, "every hit was ignored");
        seen.sort_unstable();
        let odd = accel.trace(ray, &mut |hit| match hit.primitive.0 % 2 {
            0 => AnyHit::Ignore,
            _ => AnyHit::Accept,
        });
        Self {
            closest: accel.intersect(ray).as_ref().map(bits),
            occluded: accel.occluded(ray),
            all_hits: all_hits.iter().map(bits).collect(),
            seen,
            closest_odd: odd.as_ref().map(bits),
        }
    }

    /// What holds for any structure on its own.
    pub(crate) fn assert_consistent(&self, name: &str, ray: &Ray) {
        let about = || format!("{name}: {ray:?}: {self:?}");
        assert_eq!(self.occluded, self.closest.is_some(), "{}", about());
        assert_eq!(self.closest.is_some(), !self.seen.is_empty(), "{}", about());
        assert!(self.seen.len() >= self.all_hits.len(), "{}", about());
        let t = |hit: &Bits| f32::from_bits(hit[0]);
        assert!(self.all_hits.is_sorted_by_key(t), "{}", about());
        if let Some(closest) = &self.closest {
            let in_range = ray.t_min <= t(closest) && t(closest) <= ray.t_max;
            assert!(in_range, "{}", about());
            let nearer = self.seen.iter().any(|hit| t(hit) < t(closest));
            assert!(!nearer, "{}", about());
        }
    }

    /// The same ray, ending or beginning exactly where it hits.
    fn rays_up_to_and_from_the_hit(&self, ray: &Ray) -> Vec<Ray> {
        let Some(closest) = self.closest else {
            return Vec::new();
        };
        let t = f32::from_bits(closest[0]);
        vec![
            Ray { t_max: t, ..*ray },
            Ray { t_min: t, ..*ray },
            Ray {
                t_min: t,
                t_max: t,
                ..*ray
            },
            Ray {
                t_max: t.next_down().max(ray.t_min),
                ..*ray
            },
        ]
    }
}

/// What is traced by kernels.
const WIDE: [StructureKind; 4] = [
    StructureKind::Bvh8,
    StructureKind::Bvh8Fast,
    StructureKind::Bvh8High,
    StructureKind::Bvh8Compact,
];

/// Holds every structure over the primitives, at every level of instructions, against brute force.
/// Returns how many hits there were.
pub(crate) fn assert_agreement<P: Primitives + Clone>(
    name: &str,
    primitives: &P,
    rays: &[Ray],
) -> usize {
    let build = |kind| Accel::build(primitives.clone(), kind);
    let levels = Level::available();
    for &level in &levels[..levels.len() - 1] {
        let build = |kind| build(kind).at_level(level);
        let name = format!("{name}, {level:?}");
        assert_kinds_same(&name, &build, rays, &WIDE);
    }
    assert_same(name, &build, rays)
}

/// Holds what is built with every kind against what is built with brute force. Returns how many
/// hits there were.
pub(crate) fn assert_same<T: Traversable>(
    name: &str,
    build: &dyn Fn(StructureKind) -> T,
    rays: &[Ray],
) -> usize {
    assert_kinds_same(name, build, rays, StructureKind::ALL)
}

/// All rays in one call, and a few, and none, get the answers that each gets alone.
fn assert_many_are_as_one(name: &str, accel: &impl Traversable, judged: &[(Ray, Answers)]) {
    for count in [judged.len(), 3, 1, 0] {
        let (rays, answers): (Vec<Ray>, Vec<&Answers>) =
            judged.iter().take(count).map(|(ray, a)| (*ray, a)).unzip();
        let (mut hits, mut occluded) = (vec![None; rays.len()], vec![false; rays.len()]);
        accel.intersect_many(&rays, &mut hits);
        accel.occluded_many(&rays, &mut occluded);
        for (i, answers) in answers.iter().enumerate() {
            let closest = hits[i].as_ref().map(bits);
            assert_eq!(closest, answers.closest, "{name}: {:?}", rays[i]);
            assert_eq!(occluded[i], answers.occluded, "{name}: {:?}", rays[i]);
        }
    }
}

fn assert_kinds_same<T: Traversable>(
    name: &str,
    build: &dyn Fn(StructureKind) -> T,
    rays: &[Ray],
    kinds: &[StructureKind],
) -> usize {
    let judge = build(StructureKind::BruteForce);
    let mut judged = Vec::new();
    for ray in rays {
        let answers = Answers::of(&judge, ray);
        for limited in answers.rays_up_to_and_from_the_hit(ray) {
            judged.push((limited, Answers::of(&judge, &limited)));
        }
        judged.push((*ray, answers));
    }
    for (ray, answers) in &judged {
        answers.assert_consistent(name, ray);
    }
    for &kind in kinds {
        if kind == StructureKind::BruteForce {
            continue;
        }
        let accel = build(kind);
        assert_eq!(accel.bounds(), judge.bounds(), "{name}, {kind}");
        for (ray, expected) in &judged {
            let found = Answers::of(&accel, ray);
            assert!(
                found == *expected,
                "{name}, {kind}: {ray:?}\nfound    {found:?}\nexpected {expected:?}"
            );
        }
        assert_many_are_as_one(&format!("{name}, {kind}"), &accel, &judged);
    }
    judged.iter().map(|(_, answers)| answers.seen.len()).sum()
}
