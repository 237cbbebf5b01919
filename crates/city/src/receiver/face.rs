//! Places on the faces of buildings: roofs and façades.

use ombra_geometry::{Point3, Vector3};

use super::grid::{GridError, MAX_PLACES};
use crate::building::{Face, Part, Prism, Surface};
use crate::city::{City, Plane, face_triangles, is_flat};
use crate::inside::Inside;
use crate::polygon::{edges, is_inside};

/// How far a place stands off its face, along the normal, in metres: in the very plane of a wall it would be on
/// either side of it by rounding. Sun that is behind the wall, but so near to its plane that it passes between the
/// place and the wall, reaches it: with 10 m of wall beside the place within 0.1° of the plane, half a minute.
pub const STAND_OFF: f64 = 0.02;

/// A face whose normal is closer to level than this (its z), less than 15° from upright, is a façade where the file
/// does not say; one that faces up more is a roof.
const UPRIGHT: f64 = 0.258_819;

/// Which faces of buildings are looked at.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum FaceKind {
    /// What faces up.
    Roof,
    /// Outer walls.
    Facade,
}

impl FaceKind {
    /// The word for one: "roof" or "facade".
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Roof => "roof",
            Self::Facade => "facade",
        }
    }
}

/// A place on a face of a building.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FacePlace {
    /// Local metres, [`STAND_OFF`] before the face.
    pub at: Point3,
    /// Which way the face looks; of length 1.
    pub normal: Vector3,
    /// Whose face it is, by its place in [`City::buildings`].
    pub building: u32,
    /// Which of [`City::face_charts`] it is on.
    pub face: u32,
    /// Its cell there, counted to the right and upslope.
    pub cell: [u32; 2],
}

/// A face as it is covered by places, for pictures of it.
#[derive(Clone, Debug, PartialEq)]
pub struct FaceChart {
    /// Cells to the right, as seen from outside, and upslope.
    pub count: [u32; 2],
    /// The face cut into triangles, [`STAND_OFF`] before it, local metres.
    pub triangles: Vec<[Point3; 3]>,
    /// The same corners in cells, to the right and upslope from where the lattice begins.
    pub in_cells: Vec<[[f64; 2]; 3]>,
    /// The cells that have a place, whether or not it is seen.
    pub cells: Vec<[u32; 2]>,
}

impl City {
    /// Places on all faces of a kind, as they come: building by building, face by face. Some may lie in
    /// another building, as on a wall against its neighbour, or below the terrain.
    ///
    /// A face is covered by a lattice in its own plane: level and upslope, as wide as the face, in equal steps of
    /// `cell` metres or somewhat less (up to a twentieth more where that saves a row). A place is the middle of a cell that lies in the face; a face too small
    /// to have one has one all the same. It is there if it is to be `kept`, which is asked with local metres east and
    /// north. What the file calls roof or wall is that; what it does not call
    /// anything is a façade within 15° of upright, and a roof if it faces up more.
    ///
    /// # Errors
    /// A cell below 1 cm or above 10 km, more than [`MAX_PLACES`].
    pub fn face_places(
        &self,
        kind: FaceKind,
        cell: f64,
        kept: impl Fn([f64; 2]) -> bool,
    ) -> Result<Vec<FacePlace>, GridError> {
        if !(0.01..=10_000.0).contains(&cell) {
            return Err(GridError::Cell(cell));
        }
        let mut places = Vec::new();
        for (index, (owner, face, chart)) in self.charts(kind, cell).enumerate() {
            let more = chart.count[0] * chart.count[1];
            if places.len() as f64 + more > MAX_PLACES as f64 {
                return Err(GridError::ManyPlaces);
            }
            let normal = chart.normal.map(|x| x as f32).into();
            let all = chart.places(&face).into_iter();
            let kept = all.filter(|(_, at)| kept([at.x, at.y].map(f64::from)));
            places.extend(kept.map(|(cell, at)| FacePlace {
                at,
                normal,
                building: owner,
                face: index as u32,
                cell,
            }));
        }
        Ok(places)
    }

    /// The faces that [`face_places`](Self::face_places) has places on, in the same order; `cell` is one that it takes.
    pub fn face_charts(&self, kind: FaceKind, cell: f64) -> impl Iterator<Item = FaceChart> {
        let charts = self.charts(kind, cell);
        charts.map(|(_, face, chart)| chart.shown(&face))
    }

    /// All faces of a kind with a lattice over each, and whose they are.
    fn charts(&self, kind: FaceKind, cell: f64) -> impl Iterator<Item = (u32, Face, Chart)> {
        let inside = Inside::new(self);
        let parts = (0..).zip(&self.buildings).flat_map(|(owner, building)| {
            let parts = building.parts.iter();
            parts.map(move |part| (owner, part))
        });
        let all = parts.flat_map(move |(owner, part)| {
            let faces = faces(part, kind).into_iter();
            faces.map(move |(face, is_closed)| (owner, face, is_closed))
        });
        all.filter_map(move |(owner, face, is_closed)| {
            let chart = Chart::of(&face, cell)?;
            let chart = match kind {
                _ if is_closed => Some(chart),
                FaceKind::Roof => Some(chart.turned(chart.normal[2] < 0.0)),
                FaceKind::Facade => chart.outward(&face, &inside),
            };
            let chart = chart.filter(|chart| kind.is_faced_by(chart.normal))?;
            Some((owner, face, chart))
        })
    }
}

impl FaceKind {
    /// Whether a face that is turned outward can be of this kind: no roof faces down.
    fn is_faced_by(self, normal: [f64; 3]) -> bool {
        self == Self::Facade || normal[2] > 0.0
    }
}

/// The faces of a kind, flat ones, and whether they are known to face outward.
fn faces(part: &Part, kind: FaceKind) -> Vec<(Face, bool)> {
    match part {
        Part::Prism(prism) => (of_prism(prism, kind).into_iter())
            .map(|face| (face, true))
            .collect(),
        Part::Faces(faces) => (faces.faces.iter())
            .filter(|face| is_of(face, kind, faces.is_closed))
            .flat_map(flattened)
            .map(|face| (face, faces.is_closed))
            .collect(),
    }
}

fn of_prism(prism: &Prism, kind: FaceKind) -> Vec<Face> {
    let at = |[x, y]: [f32; 2], z| Point3::new(x, y, z);
    let Prism { outline, base, top } = prism;
    match kind {
        FaceKind::Roof => {
            let ring = |ring: &[[f32; 2]]| ring.iter().map(|&p| at(p, *top)).collect();
            vec![Face {
                rings: outline.rings().map(ring).collect(),
                surface: Surface::Roof,
            }]
        }
        FaceKind::Facade => (outline.rings())
            .flat_map(|ring| edges(ring.iter().copied()))
            .map(|(a, b)| Face {
                rings: vec![vec![at(a, *base), at(b, *base), at(b, *top), at(a, *top)]],
                surface: Surface::Wall,
            })
            .collect(),
    }
}

fn is_of(face: &Face, kind: FaceKind, is_closed: bool) -> bool {
    match (face.surface, kind) {
        (Surface::Roof, FaceKind::Roof) | (Surface::Wall, FaceKind::Facade) => true,
        (Surface::Roof | Surface::Wall | Surface::Ground, _) => false,
        (Surface::Untold, _) => Plane::of(&face.rings[0]).is_some_and(|plane| {
            let up = plane.normal().z;
            match kind {
                FaceKind::Facade => up.abs() <= UPRIGHT,
                FaceKind::Roof if is_closed => up > UPRIGHT,
                FaceKind::Roof => up.abs() > UPRIGHT,
            }
        }),
    }
}

/// The face itself, or the triangles of one that is bent.
fn flattened(face: &Face) -> Vec<Face> {
    if is_flat(face) {
        return vec![face.clone()];
    }
    let corners: Vec<Point3> = face.corners().collect();
    (face_triangles(face).into_iter())
        .map(|[a, b, c, _]| Face {
            rings: vec![[a, b, c].map(|i| corners[i as usize]).to_vec()],
            surface: face.surface,
        })
        .collect()
}

/// A lattice over a face, in its plane.
#[derive(Clone, Copy, Debug)]
struct Chart {
    /// A place of the plane.
    from: [f64; 3],
    /// Level, to the right as seen from outside.
    right: [f64; 3],
    /// At right angles to it, upslope.
    up: [f64; 3],
    normal: [f64; 3],
    /// Where the lattice begins, along the two.
    least: [f64; 2],
    step: [f64; 2],
    /// Whole numbers, 1 at least.
    count: [f64; 2],
}

impl Chart {
    /// `None` for a face without an area.
    fn of(face: &Face, cell: f64) -> Option<Self> {
        let normal = Plane::of(&face.rings[0])?.normal().to_array();
        let [x, y, z] = normal;
        let level = x.hypot(y);
        let (right, up) = if level > 1e-6 {
            let right = [-y / level, x / level, 0.0];
            (right, cross(normal, right))
        } else {
            ([1.0, 0.0, 0.0], [0.0, z.signum(), 0.0])
        };
        let from = face.rings[0][0].wide().to_array();
        let mut chart = Self {
            from,
            right,
            up,
            normal,
            least: [0.0; 2],
            step: [0.0; 2],
            count: [1.0; 2],
        };
        let nothing = [[f64::INFINITY; 2], [f64::NEG_INFINITY; 2]];
        let [least, most] = face.rings[0]
            .iter()
            .fold(nothing, |[least, most], &corner| {
                let at = chart.seen(corner);
                [
                    [0, 1].map(|k| f64::min(least[k], at[k])),
                    [0, 1].map(|k| f64::max(most[k], at[k])),
                ]
            });
        chart.least = least;
        for k in 0..2 {
            let extent = most[k] - least[k];
            // What is a twentieth of a cell longer than a whole number of them has no more of them.
            chart.count[k] = (extent / cell - 0.05).ceil().max(1.0);
            chart.step[k] = extent / chart.count[k];
        }
        Some(chart)
    }

    /// Along the two axes.
    fn seen(&self, p: Point3) -> [f64; 2] {
        let p = p.wide().to_array();
        let away = [0, 1, 2].map(|k| p[k] - self.from[k]);
        [dot(away, self.right), dot(away, self.up)]
    }

    /// What is off the face by so much, metres.
    fn off(&self, [right, up]: [f64; 2], off: f64) -> Point3 {
        let at = |k: usize| {
            let in_plane = right * self.right[k] + up * self.up[k];
            (self.from[k] + in_plane + off * self.normal[k]) as f32
        };
        Point3::new(at(0), at(1), at(2))
    }

    /// The same lattice on the other side.
    fn turned(mut self, is_turned: bool) -> Self {
        if is_turned {
            self.normal = self.normal.map(|x| -x);
        }
        self
    }

    /// Turned to the side that lies in no building; as it is where neither does, `None` where both do.
    fn outward(self, face: &Face, inside: &Inside) -> Option<Self> {
        let middle = self.middle(face)?;
        let [before, behind] =
            [STAND_OFF, -STAND_OFF].map(|off| inside.contains(self.off(middle, off)));
        (!(before && behind)).then(|| self.turned(before))
    }

    /// By their cells.
    fn places(&self, face: &Face) -> Vec<([u32; 2], Point3)> {
        let rings: Vec<Vec<[f64; 2]>> = (face.rings.iter())
            .map(|ring| ring.iter().map(|&p| self.seen(p)).collect())
            .collect();
        let holds = |place: [f64; 2]| {
            (rings.iter()).fold(false, |inside, ring| {
                inside ^ is_inside(ring.iter().copied(), place)
            })
        };
        let [columns, rows] = self.count.map(|count| count as u32);
        let cells = (0..rows).flat_map(|row| (0..columns).map(move |column| [column, row]));
        let middles = cells.map(|cell| {
            let at = |k: usize| self.least[k] + (f64::from(cell[k]) + 0.5) * self.step[k];
            (cell, [at(0), at(1)])
        });
        let mut places: Vec<_> = middles.filter(|&(_, place)| holds(place)).collect();
        if places.is_empty() {
            places.extend(self.middle(face).map(|middle| {
                let cell = self.in_cells(middle);
                let last = [columns - 1, rows - 1];
                (
                    [0, 1].map(|k| (cell[k].max(0.0) as u32).min(last[k])),
                    middle,
                )
            }));
        }
        (places.into_iter())
            .map(|(cell, place)| (cell, self.off(place, STAND_OFF)))
            .collect()
    }

    /// From metres along the two axes to cells.
    fn in_cells(&self, at: [f64; 2]) -> [f64; 2] {
        [0, 1].map(|k| {
            // A face without an extent one way has no way to go there.
            let step = if self.step[k] > 0.0 {
                self.step[k]
            } else {
                1.0
            };
            (at[k] - self.least[k]) / step
        })
    }

    fn shown(&self, face: &Face) -> FaceChart {
        let corners: Vec<[f64; 2]> = face.corners().map(|p| self.seen(p)).collect();
        let triangles = face_triangles(face).into_iter();
        let triangles: Vec<[[f64; 2]; 3]> = triangles
            .map(|[a, b, c, _]| [a, b, c].map(|i| corners[i as usize]))
            .collect();
        FaceChart {
            count: self.count.map(|count| count as u32),
            cells: self
                .places(face)
                .into_iter()
                .map(|(cell, _)| cell)
                .collect(),
            in_cells: (triangles.iter())
                .map(|triangle| triangle.map(|at| self.in_cells(at)))
                .collect(),
            triangles: (triangles.iter())
                .map(|triangle| triangle.map(|at| self.off(at, STAND_OFF)))
                .collect(),
        }
    }

    /// The middle of the largest of the pieces that a face is cut into: it lies in the face, whatever its shape.
    fn middle(&self, face: &Face) -> Option<[f64; 2]> {
        let corners: Vec<[f64; 2]> = face.corners().map(|p| self.seen(p)).collect();
        let area = |[a, b, c]: [[f64; 2]; 3]| {
            ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])).abs()
        };
        (face_triangles(face).into_iter())
            .map(|[a, b, c, _]| [a, b, c].map(|i| corners[i as usize]))
            .max_by(|a, b| area(*a).total_cmp(&area(*b)))
            .map(|triangle| [0, 1].map(|k| triangle.iter().map(|p| p[k]).sum::<f64>() / 3.0))
    }
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

#[cfg(test)]
mod tests;
