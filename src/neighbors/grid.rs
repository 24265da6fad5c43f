//! The grid of a cell list: the width of a cell, and the number of cells before folding.

use glam::{DVec3, Vec3};

use super::field;
use crate::error::Error;
use crate::kernel::{Binding, Bounds, Name, Problem, Scalar, Side};

/// A cell is wider than the range by this part, so that rounding moves no neighbour two cells away; see `shaders/visit/near_rows.wgsl`. Up
/// to [`FINEST`] cells from the corner the error of a position is at most 2 · 8192 · 2⁻²⁴ of a cell (two roundings), and that of a
/// difference twice that: 2⁻⁹.
const SLACK: f64 = 1.0 / 512.0;
/// The maximum number of cells along one axis.
const FINEST: f64 = 8192.0;
/// The possible numbers of cells per range along each axis, the best first: with finer cells, fewer candidates are out of range, and there
/// are more rows. Finer cells along y and z are for ranges with very many particles.
const FINE: [[u32; 3]; 6] = [[32, 8, 8], [16, 4, 4], [8, 2, 2], [4, 1, 1], [2, 1, 1], [1, 1, 1]];
/// Up to this number of particles of a species, no cells are needed.
const FEW: u32 = 32;
/// The number of particles per cell from which it is worthwhile to divide y and z too.
const DENSE: f64 = 4.0;
/// The approximate maximum number of cells per particle: more are almost empty, and cost memory and time to clear.
const CELLS_PER_PARTICLE: f64 = 2.0;
/// The maximum number of cells: 64 MiB, half of what every device binds.
const MOST: f64 = 16_777_216.0;
/// The maximum number of cells between the origin and the corner of an axis without a period. A position uses digits for its distance from
/// the origin; with a more distant corner, too few digits would be left to distinguish cells.
const NEAREST_CORNER: f64 = 1_048_576.0;

/// A uniform grid of cells no narrower than a range.
#[derive(Debug, Clone, PartialEq)]
pub struct Grid {
    /// Its name: its range, and the species that it contains.
    pub name: String,
    /// The range of a search \[length\].
    pub range: f64,
    /// The only species in it.
    pub of: Option<u32>,
    /// Its corner \[length\].
    pub low: DVec3,
    /// One over the width of a cell \[1 / length\].
    pub per_cell: DVec3,
    /// Cells along each axis.
    pub cells: [u32; 3],
    /// The number of cells per range along each axis.
    pub fine: [u32; 3],
    /// Whether fixed particles come after all others: mobile ones are then contiguous, and can be the only targets.
    pub apart: bool,
    /// The mean number of particles per cell at the start, for a uniform distribution.
    pub occupancy: f64,
    /// The way in which the number of cells was reduced to fit the limits.
    pub fitted: &'static str,
    /// Whether its cells change with the box.
    pub elastic: bool,
}

impl Grid {
    /// For searches within a range.
    ///
    /// # Errors
    /// [`Error::Scene`] when the range is not a positive number.
    pub fn new(range: f64, of: Option<u32>, problem: &Problem) -> Result<Self, Error> {
        checked(range)?;
        let mut name = format!("{range:?}");
        if let Some(species) = of {
            name = format!("{name} species {species}");
        }
        Ok(Self::finest(&name, range, of, 1.0, problem))
    }

    /// The same for all particles, with fixed ones after all others.
    ///
    /// # Errors
    /// [`Error::Scene`] when the range is not a positive number.
    pub fn apart(range: f64, problem: &Problem) -> Result<Self, Error> {
        if problem.held.is_empty() {
            return Self::new(range, None, problem);
        }
        checked(range)?;
        Ok(Self { apart: true, ..Self::finest(&format!("{range:?} held last"), range, None, 2.0, problem) })
    }

    /// The finest cells within the limits, which allow `times` times as many.
    fn finest(name: &str, range: f64, of: Option<u32>, times: f64, problem: &Problem) -> Self {
        let width = range * (1.0 + SLACK);
        let make = |fine: [u32; 3]| Self::of_cells(name.to_owned(), range, of, (width, fine, times), problem);
        let mut grids = FINE.iter().map(|fine| make(*fine)).filter(|grid| grid.fine[1] == 1 || grid.is_dense());
        grids.find(|grid| grid.fitted.is_empty()).unwrap_or_else(|| make([1; 3]))
    }

    /// For searches of the nearest neighbours, at any distance: cells with about `occupancy` particles each.
    #[must_use]
    pub fn sparse(occupancy: f64, problem: &Problem) -> Self {
        let sides = size(problem).to_array().into_iter().filter(|side| *side > 0.0);
        let (mut volume, mut axes) = (1.0, 0);
        for side in sides {
            (volume, axes) = (volume * side, axes + 1);
        }
        let width = (volume * occupancy / f64::from(problem.particles)).powf(1.0 / f64::from(axes.max(1)));
        // Its inverse must be finite too.
        let width = if width.is_finite() && width > 0.0 { width.clamp(1e-37, 1e37) } else { 1.0 };
        Self::of_cells(format!("cells of {occupancy:?}"), width, None, (width, [1; 3], 1.0), problem)
    }

    fn of_cells(
        name: String,
        range: f64,
        of: Option<u32>,
        (width, fine, times): (f64, [u32; 3], f64),
        problem: &Problem,
    ) -> Self {
        let periodic = problem.bounds.axes(Side::Periodic);
        let size = size(problem);
        let parts = DVec3::from_array(fine.map(f64::from));
        let whole_cells = size / width * parts * problem.elastic.map_or(1.0, |elastic| elastic.least);
        // A period is divided into whole cells; elsewhere the last cell may extend beyond the box.
        let wish = DVec3::select(periodic.cmpgt(DVec3::ZERO), whole_cells.floor(), whole_cells.ceil()).max(DVec3::ONE);
        let flat = problem.bounds.dimensions == 2;
        let room = (CELLS_PER_PARTICLE * f64::from(problem.count_of(of))).clamp(64.0, MOST / times);
        // A few particles of one species are all candidates.
        let few = of.is_some() && problem.count_of(of) <= FEW;
        let wish = if few { DVec3::ONE } else { wish };
        let most = FINEST * parts;
        let mut cells = wish.min(most);
        while cells.element_product() > room {
            // The longest axis first, and no more than necessary.
            let longest = cells.max_position();
            let less = (cells[longest] * 0.9).min(cells[longest] * room / cells.element_product());
            cells[longest] = less.max(cells[longest] / 2.0).floor().max(1.0);
        }
        let mut fitted = "";
        if cells != wish {
            let coarser = (0..3).any(|axis| periodic[axis] > 0.0 && cells[axis] < wish[axis]);
            fitted = if coarser { " coarser" } else { " folded" };
        }
        // Particles that start close together in open space may spread: cells are allocated for that.
        let open: Vec<usize> =
            (0..3).filter(|axis| problem.bounds.sides[*axis] == Side::Open && !(flat && *axis == 2)).collect();
        let spread = 0.5 * room / cells.element_product();
        if spread > 1.0 && !few && !open.is_empty() {
            let factor = spread.powf(1.0 / open.len() as f64);
            for axis in &open {
                cells[*axis] = (cells[*axis] * factor).floor().clamp(cells[*axis], most[*axis]);
            }
        }
        let per_cell = |axis: usize| {
            if periodic[axis] * size[axis] > 0.0 { cells[axis] / size[axis] } else { parts[axis] / width }
        };
        let count = |axis: usize| whole(cells[axis]);
        Self {
            name,
            range,
            of,
            low: low(problem, width),
            per_cell: DVec3::new(per_cell(0), per_cell(1), per_cell(2)),
            cells: [count(0), count(1), count(2)],
            fine,
            apart: false,
            occupancy: f64::from(problem.count_of(of)) / wish.element_product(),
            fitted,
            elastic: problem.elastic.is_some(),
        }
    }
    /// The shortest sides of a periodic box in which a cell is wide enough for its range.
    #[must_use]
    pub fn shortest_sides(&self) -> DVec3 {
        let side = |axis: usize| {
            let [cells, fine] = [self.cells, self.fine].map(|counts| f64::from(counts[axis]));
            // Where all cells are visited, none can be too narrow.
            if cells <= 2.0 * fine { 0.0 } else { self.range * (1.0 + SLACK) * cells / fine }
        };
        DVec3::new(side(0), side(1), side(2))
    }
    /// Its corner and one over the width of a cell in a box, as the device has them.
    #[must_use]
    pub(super) fn placed(&self, bounds: &Bounds) -> (Vec3, Vec3) {
        if !self.elastic {
            return (self.low.as_vec3(), self.per_cell.as_vec3());
        }
        let cells = DVec3::from_array(self.cells.map(f64::from)).as_vec3();
        (bounds.low.as_vec3(), cells * bounds.frequency().as_vec3())
    }

    /// Whether finer cells would still contain several particles each, for a uniform distribution.
    fn is_dense(&self) -> bool {
        self.occupancy > DENSE
    }
    /// The number of cells.
    #[must_use]
    pub fn count(&self) -> u32 {
        self.cells.iter().product()
    }
    /// The number of lists of particles, one after another.
    #[must_use]
    pub fn layers(&self) -> u32 {
        1 + u32::from(self.apart)
    }
    /// The same, for searches that find only particles that are not fixed.
    #[must_use]
    pub fn of_those_ahead(&self) -> Self {
        Self { apart: false, ..self.clone() }
    }
    /// The number of starts of cells, of all lists, including the end of the last.
    #[must_use]
    pub fn bins(&self) -> u32 {
        self.count() * self.layers() + 1
    }
    /// The maximum number of particles before the fixed ones.
    #[must_use]
    pub fn ahead(&self, problem: &Problem) -> u32 {
        let held = if self.apart { u32::try_from(problem.held.len()).unwrap_or(u32::MAX) } else { 0 };
        problem.capacity.saturating_sub(held)
    }
    /// Whether a period has so few cells that those on both sides of a particle coincide.
    #[must_use]
    pub fn narrow(&self, problem: &Problem) -> bool {
        (0..3).any(|axis| problem.bounds.sides[axis] == Side::Periodic && self.cells[axis] <= 2 * self.fine[axis])
    }
    /// The approximate number of candidates of a search, for a uniform distribution.
    #[must_use]
    pub fn candidates(&self, problem: &Problem) -> f64 {
        let around: u32 = self.cells.iter().zip(self.fine).map(|(n, fine)| (*n).min(2 * fine + 1)).product();
        (f64::from(problem.count_of(self.of)) * f64::from(around) / f64::from(self.count())).max(1.0)
    }
    /// A field of it, by its name in shaders.
    #[must_use]
    pub fn field(&self, name: &'static str) -> (&'static str, Name) {
        (name, field(name, &self.name))
    }
    /// The block `grid` of a shader, for the targets `first` ≤ k < `end`.
    ///
    /// # Errors
    /// When the shader's block has another shape.
    pub fn uniform(&self, binding: &Binding, first: u32, end: u32) -> Result<Vec<u8>, Error> {
        let values = [
            ("low", Scalar::Vector(self.low)),
            ("range", Scalar::Float(self.range)),
            ("per_cell", Scalar::Vector(self.per_cell)),
            ("first", Scalar::Uint(first)),
            ("cells", Scalar::Uints(self.cells)),
            ("end", Scalar::Uint(end)),
            ("fine", Scalar::Uints(self.fine)),
            ("only", Scalar::Uint(self.of.unwrap_or(u32::MAX))),
        ];
        binding.packed.pack("grid", &values)
    }
}

/// Checks whether a range can be searched: its square must fit single precision.
///
/// # Errors
/// [`Error::Scene`] when it does not.
pub fn checked(range: f64) -> Result<(), Error> {
    if range > 0.0 && (f64::from(f32::MIN_POSITIVE)..=f64::from(f32::MAX)).contains(&(range * range)) {
        return Ok(());
    }
    Err(Error::Scene(format!(
        "a search for neighbours has a range of {range:e}: it must be between 1.1e-19 and 1.8e19, so that \
         single precision holds its square"
    )))
}

/// The corner of the grid: that of the box, or that of the initial positions.
fn low(problem: &Problem, width: f64) -> DVec3 {
    let corner = |axis: usize| match problem.bounds.sides[axis] {
        Side::Periodic => problem.bounds.low[axis],
        side => {
            let low = if side == Side::Open { problem.extent.0[axis] } else { problem.bounds.low[axis] };
            if low.abs() <= NEAREST_CORNER * width { low } else { 0.0 }
        }
    };
    DVec3::new(corner(0), corner(1), corner(2))
}

/// The extent of the particles, or of the box; 0 along an axis where that is NaN.
fn size(problem: &Problem) -> DVec3 {
    let open = problem.bounds.axes(Side::Open).cmpgt(DVec3::ZERO);
    let (low, high) = (problem.bounds.low, problem.bounds.high);
    let size = DVec3::select(open, problem.extent.1 - problem.extent.0, high - low);
    let size = DVec3::from_array(size.to_array().map(|side| if side.is_finite() { side } else { 0.0 }));
    if problem.bounds.dimensions == 2 { size.with_z(0.0) } else { size }
}

#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "whole, between 1 and 8192")]
fn whole(x: f64) -> u32 {
    x as u32
}
