//! A mesh of triangles: out of the text of an OBJ file, and sampled by particles.

use std::collections::HashMap;

use glam::DVec3;

/// A mesh.
#[derive(Debug, Default)]
pub(super) struct Mesh {
    pub places: Vec<DVec3>,
    pub triangles: Vec<[usize; 3]>,
}

/// The minimum distance of samples, in spacings: with this random packing there is one for each square of a spacing (Feder 1980: disks of
/// half that distance cover 0.547 of a plane).
const APART: f64 = 0.834;
/// Places that are tried along a spacing.
const TRIES: f64 = 4.0;
/// The maximum displacement of corners, in depths of a wall, however sharp they are.
const SHARP: f64 = 3.0;

impl Mesh {
    /// Reads Wavefront OBJ: the lines `v` and `f`; faces of more than three corners become a fan. What else is there (normals,
    /// textures, groups, materials) makes no wall, and is passed over. The error names the line.
    pub fn read(text: &str) -> Result<Self, String> {
        let mut mesh = Self::default();
        for (line, number) in text.lines().zip(1..) {
            let words: Vec<&str> = line.split('#').next().unwrap_or_default().split_whitespace().collect();
            let refuse = |what: String| format!("line {number}: {what}");
            match words.split_first() {
                Some((&"v", numbers)) => mesh.places.push(place(numbers).map_err(refuse)?),
                Some((&"f", corners)) => mesh.face(corners).map_err(refuse)?,
                _ => {}
            }
        }
        if mesh.triangles.is_empty() {
            return Err("it has no faces: lines such as `f 1 2 3`".to_owned());
        }
        Ok(mesh)
    }
    fn face(&mut self, corners: &[&str]) -> Result<(), String> {
        let have = self.places.len();
        let corner = |word: &&str| {
            let number = word.split('/').next().unwrap_or_default();
            let index: i64 =
                number.parse().map_err(|_| format!("`{word}` is no corner: a whole number, as in 3 or 3/1/2"))?;
            // Below zero one counts from the last vertex that is there.
            let from = if index < 0 { i64::try_from(have).unwrap_or(i64::MAX) } else { -1 };
            let place = usize::try_from(index.saturating_add(from)).ok().filter(|place| *place < have);
            place.ok_or_else(|| format!("there is no vertex {index}: {have} come before this face, counted from 1"))
        };
        let ids = corners.iter().map(corner).collect::<Result<Vec<_>, _>>()?;
        if ids.len() < 3 {
            return Err(format!("a face has three corners or more, not {}", ids.len()));
        }
        self.triangles.extend(ids[1..].windows(2).map(|pair| [ids[0], pair[0], pair[1]]));
        Ok(())
    }
    fn corners(&self, triangle: &[usize; 3]) -> [DVec3; 3] {
        triangle.map(|id| self.places[id])
    }
    /// The area of its surface.
    pub fn area(&self) -> f64 {
        let of = |t: &[usize; 3]| {
            let [a, b, c] = self.corners(t);
            0.5 * (b - a).cross(c - a).length()
        };
        self.triangles.iter().map(of).sum()
    }
    /// The mesh at a depth behind its faces: corners move along their normals, weighted by angles (Thürmer & Wüthrich 1998), far enough
    /// that the planes of their faces are at that depth.
    pub fn behind(&self, depth: f64) -> Self {
        let mut normals = vec![DVec3::ZERO; self.places.len()];
        let mut around: Vec<Vec<DVec3>> = vec![Vec::new(); self.places.len()];
        for triangle in &self.triangles {
            let [a, b, c] = self.corners(triangle);
            let normal = (b - a).cross(c - a).normalize_or_zero();
            for (k, (x, (y, z))) in [(a, (b, c)), (b, (c, a)), (c, (a, b))].into_iter().enumerate() {
                normals[triangle[k]] += normal * angle(y - x, z - x);
                around[triangle[k]].push(normal);
            }
        }
        let moved = |(place, (normal, faces)): (&DVec3, (&DVec3, &Vec<DVec3>))| {
            let way = normal.normalize_or_zero();
            let slope = faces.iter().map(|face| face.dot(way)).fold(1.0, f64::min);
            *place - way * depth * slope.max(1.0 / SHARP).recip()
        };
        let places = self.places.iter().zip(normals.iter().zip(&around)).map(moved).collect();
        Self { places, triangles: self.triangles.clone() }
    }
    /// The approximate number of points that [`Mesh::sampled`] would try at a spacing, for its edges and faces.
    pub fn tries(&self, spacing: f64) -> f64 {
        let per = TRIES / spacing;
        let of = |t: &[usize; 3]| {
            let [a, b, c] = self.corners(t);
            let around = (b - a).length() + (c - b).length() + (a - c).length();
            3.0 + per * around + 0.5 * per * per * (b - a).cross(c - a).length()
        };
        self.triangles.iter().map(of).sum()
    }
    /// Samples of its surface at a spacing: corners first, then edges, then faces; each point is accepted if it is far enough from all
    /// previous ones, so that there are no duplicates and no hole is larger than a spacing. The same mesh gives the same samples.
    pub fn sampled(&self, spacing: f64) -> Vec<DVec3> {
        let mut taken = Taken { apart: APART * spacing, cells: HashMap::new(), places: Vec::new() };
        let all = || self.triangles.iter().map(|triangle| self.corners(triangle));
        all().flatten().for_each(|corner| taken.add(corner));
        for [a, b, c] in all() {
            for (from, to) in [(a, b), (b, c), (c, a)] {
                inner((to - from).length(), spacing).for_each(|part| taken.add(from.lerp(to, part)));
            }
        }
        for [a, b, c] in all() {
            // Rows along the longest edge, as far apart as points: narrow triangles have few.
            let edges = [(a, b, c), (b, c, a), (c, a, b)];
            let longest =
                edges.into_iter().reduce(|x, y| if (y.1 - y.0).length() > (x.1 - x.0).length() { y } else { x });
            let Some((from, to, top)) = longest.filter(|(from, to, _)| from != to) else { continue };
            let height = (to - from).cross(top - from).length() / (to - from).length();
            for up in inner(height, spacing) {
                let (from, to) = (from.lerp(top, up), to.lerp(top, up));
                inner((to - from).length(), spacing).for_each(|part| taken.add(from.lerp(to, part)));
            }
        }
        taken.places
    }
}

/// The points between the ends of an edge that are tried, as parts of its length.
fn inner(length: f64, spacing: f64) -> impl Iterator<Item = f64> {
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "tries are counted before")]
    let parts = (TRIES * length / spacing).ceil().max(1.0) as u32;
    (1..parts).map(move |part| f64::from(part) / f64::from(parts))
}

/// The angle between two ways, the same on every platform.
fn angle(a: DVec3, b: DVec3) -> f64 {
    libm::atan2(a.cross(b).length(), a.dot(b))
}

fn place(numbers: &[&str]) -> Result<DVec3, String> {
    // A fourth is a weight, or three more a colour.
    let [x, y, z, ..] = numbers else { return Err(format!("a vertex has three numbers, not {}", numbers.len())) };
    let number = |word: &str| {
        word.parse::<f64>().ok().filter(|x| x.is_finite()).ok_or_else(|| format!("`{word}` is no finite number"))
    };
    Ok(DVec3::new(number(x)?, number(y)?, number(z)?))
}

/// Places that keep their distance.
struct Taken {
    apart: f64,
    cells: HashMap<[i64; 3], Vec<usize>>,
    places: Vec<DVec3>,
}

impl Taken {
    fn add(&mut self, x: DVec3) {
        #[expect(clippy::cast_possible_truncation, reason = "saturates")]
        let home = (x / self.apart).floor().to_array().map(|i| (i as i64).clamp(i64::MIN / 2, i64::MAX / 2));
        for dx in -1..=1 {
            for dy in -1..=1 {
                for dz in -1..=1 {
                    let near = self.cells.get(&[home[0] + dx, home[1] + dy, home[2] + dz]);
                    if near.into_iter().flatten().any(|id| self.places[*id].distance(x) < self.apart) {
                        return;
                    }
                }
            }
        }
        self.cells.entry(home).or_default().push(self.places.len());
        self.places.push(x);
    }
}
