//! The grid of a cell list: the width of a cell, and the number of cells before folding.

use glam::DVec3;

use super::field;
use crate::error::Error;
use crate::kernel::{Binding, Name, Problem, Scalar, Side};

/// A cell is wider than the range by this part, so that rounding moves no neighbour two cells away; see
/// `shaders/visit/near_rows.wgsl`. Up to [`FINEST`] cells from the corner a place is wrong by 2 · 8192 · 2⁻²⁴ of a cell at
/// most (two roundings), and two places differ by twice that: 2⁻⁹.
const SLACK: f64 = 1.0 / 512.0;
/// Cells along one axis, at most.
const FINEST: f64 = 8192.0;
/// Cells that a range may be along each axis, the best first: the finer, the fewer are looked at for nothing, and the
/// more rows there are. Finer along y and z is for ranges that hold very many.
const FINE: [[u32; 3]; 6] = [[32, 8, 8], [16, 4, 4], [8, 2, 2], [4, 1, 1], [2, 1, 1], [1, 1, 1]];
/// So few of one species need no cells.
const FEW: u32 = 32;
/// Particles of a cell from which on it is worth while to cut y and z too.
const DENSE: f64 = 4.0;
/// Cells for each particle, about, at most: more are all but empty, and cost memory and time to clear.
const CELLS_PER_PARTICLE: f64 = 2.0;
/// Cells, at most: 64 MiB, half of what every device binds.
const MOST: f64 = 16_777_216.0;
/// Cells between the origin and the corner of an axis without a period, at most. A place there has digits for its
/// distance from the origin; further from the corner than this, fewer would be left of it than tell cells apart.
const NEAREST_CORNER: f64 = 1_048_576.0;

/// A uniform grid of cells no narrower than a range.
#[derive(Debug, Clone, PartialEq)]
pub struct Grid {
    /// What it is for: its range, and the species that it holds.
    pub name: String,
    /// How far a search looks \[length\].
    pub range: f64,
    /// The only species in it.
    pub of: Option<u32>,
    /// Its corner \[length\].
    pub low: DVec3,
    /// One over the width of a cell \[1 / length\].
    pub per_cell: DVec3,
    /// Cells along each axis.
    pub cells: [u32; 3],
    /// Cells that make up a range along each axis.
    pub fine: [u32; 3],
    /// Whether fixed particles stand behind all others: those that move are then side by side, and are searched for alone.
    pub apart: bool,
    /// Particles of a cell at the start, when they are spread evenly.
    pub occupancy: f64,
    /// How the cells that the range and the place of the particles ask for were brought down to what there is room for.
    pub fitted: &'static str,
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

    /// The same for all particles, with fixed ones behind all others.
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

    /// As fine as there is room for, so many times over.
    fn finest(name: &str, range: f64, of: Option<u32>, times: f64, problem: &Problem) -> Self {
        let width = range * (1.0 + SLACK);
        let make = |fine: [u32; 3]| Self::of_cells(name.to_owned(), range, of, (width, fine, times), problem);
        let mut grids = FINE.iter().map(|fine| make(*fine)).filter(|grid| grid.fine[1] == 1 || grid.is_dense());
        grids.find(|grid| grid.fitted.is_empty()).unwrap_or_else(|| make([1; 3]))
    }

    /// For searches of the nearest, which may be anywhere: cells that hold about `occupancy` particles each.
    #[must_use]
    pub fn sparse(occupancy: f64, problem: &Problem) -> Self {
        let sides = size(problem).to_array().into_iter().filter(|side| *side > 0.0);
        let (mut volume, mut axes) = (1.0, 0);
        for side in sides {
            (volume, axes) = (volume * side, axes + 1);
        }
        let width = (volume * occupancy / f64::from(problem.particles)).powf(1.0 / f64::from(axes.max(1)));
        // One over it is to be a number too.
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
        let whole_cells = size / width * parts;
        // A period is cut into whole cells; elsewhere the last cell may stick out.
        let wish = DVec3::select(periodic.cmpgt(DVec3::ZERO), whole_cells.floor(), whole_cells.ceil()).max(DVec3::ONE);
        let flat = problem.bounds.dimensions == 2;
        let room = (CELLS_PER_PARTICLE * f64::from(problem.count_of(of))).clamp(64.0, MOST / times);
        // A few of one species are looked at all together.
        let few = of.is_some() && problem.count_of(of) <= FEW;
        let wish = if few { DVec3::ONE } else { wish };
        let most = FINEST * parts;
        let mut cells = wish.min(most);
        while cells.element_product() > room {
            // The longest axis first, and no more than is needed.
            let longest = cells.max_position();
            let less = (cells[longest] * 0.9).min(cells[longest] * room / cells.element_product());
            cells[longest] = less.max(cells[longest] / 2.0).floor().max(1.0);
        }
        let mut fitted = "";
        if cells != wish {
            let coarser = (0..3).any(|axis| periodic[axis] > 0.0 && cells[axis] < wish[axis]);
            fitted = if coarser { " coarser" } else { " folded" };
        }
        // Particles that start close together in open space may spread: there is to be room for that.
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
        }
    }

    /// Whether cells that are so much finer still hold several particles each, when these are spread evenly.
    fn is_dense(&self) -> bool {
        self.occupancy > DENSE
    }
    /// How many cells there are.
    #[must_use]
    pub fn count(&self) -> u32 {
        self.cells.iter().product()
    }
    /// In how many lists particles are kept, one after the other.
    #[must_use]
    pub fn layers(&self) -> u32 {
        1 + u32::from(self.apart)
    }
    /// The same, where searches find those ahead alone.
    #[must_use]
    pub fn of_those_ahead(&self) -> Self {
        Self { apart: false, ..self.clone() }
    }
    /// Where cells begin, of all lists, and where the last ends.
    #[must_use]
    pub fn bins(&self) -> u32 {
        self.count() * self.layers() + 1
    }
    /// How many stand before all fixed particles, at most.
    #[must_use]
    pub fn ahead(&self, problem: &Problem) -> u32 {
        let held = if self.apart { u32::try_from(problem.held.len()).unwrap_or(u32::MAX) } else { 0 };
        problem.capacity.saturating_sub(held)
    }
    /// Whether a period has so few cells that those on both sides of me are the same.
    #[must_use]
    pub fn narrow(&self, problem: &Problem) -> bool {
        (0..3).any(|axis| problem.bounds.sides[axis] == Side::Periodic && self.cells[axis] <= 2 * self.fine[axis])
    }
    /// About how many particles a search looks at, when they are spread evenly.
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

/// A range that can be searched: single precision must hold its square.
///
/// # Errors
/// [`Error::Scene`] when it is another.
pub fn checked(range: f64) -> Result<(), Error> {
    if range > 0.0 && (f64::from(f32::MIN_POSITIVE)..=f64::from(f32::MAX)).contains(&(range * range)) {
        return Ok(());
    }
    Err(Error::Scene(format!(
        "a search for neighbours has a range of {range}: it must be above 0, and between 1.1e-19 and 1.8e19, so that \
         single precision holds its square"
    )))
}

/// Where the grid begins: a box says so, and elsewhere it is where the first particles are.
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

/// How far particles are spread, or the box; 0 along an axis where that is NaN.
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
