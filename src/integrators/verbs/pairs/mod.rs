//! The verbs for declared columns: every column with a rate is advanced like positions and velocities.

pub mod advance;
pub mod around;
pub mod runge_kutta;

use std::ops::{Add, Mul, Range};
use std::sync::Arc;

use glam::{DVec4, Vec4};

use crate::error::Error;
use crate::kernel::{
    Advance, Column, Columns, Element, Host, Kernel, Name, Pair, Pass, Problem, Reference, Shader, Shape, Source,
    Table, Threads,
};

/// The part of a buffer that a column occupies: the buffer that kernels bind, and the components of its elements.
#[derive(Debug, Clone)]
pub struct Part {
    /// The name of the column.
    pub name: Name,
    /// Its buffer.
    pub buffer: Name,
    /// Whether the elements of the buffer are vectors.
    pub vectors: bool,
    /// Its components of each element.
    pub components: Range<usize>,
    /// The number of elements.
    pub shape: Shape,
    /// Whether fixed particles are advanced too.
    pub of_fixed: bool,
}

/// A column and the buffer of its rate, which has the same layout.
#[derive(Debug, Clone)]
pub struct Advanced {
    /// The column that is advanced.
    pub part: Part,
    /// The buffer of its rate.
    pub rate: Name,
}

impl Part {
    /// The part of a declared column.
    pub fn of(column: &Column, columns: &Columns) -> Self {
        let first = usize::from(column.place.component);
        Self {
            name: column.name.clone(),
            buffer: column.place.buffer.clone(),
            vectors: columns.lies_in_vectors(column),
            components: first..first + column.kind.components(),
            shape: column.shape,
            of_fixed: column.advance == Advance::Everywhere,
        }
    }
    fn elements(&self, problem: &Problem) -> usize {
        self.shape.len(problem.capacity as usize)
    }
    fn slots(&self) -> usize {
        if let Shape::Slots(k) = self.shape { k as usize } else { 1 }
    }
    /// The file with the element of its buffer.
    fn source(&self) -> Source {
        if self.vectors {
            crate::shader!("integrators/pairs/vector.wgsl")
        } else {
            crate::shader!("integrators/pairs/scalar.wgsl")
        }
    }
    /// Whether a particle's elements are advanced: not those of inactive particles, and of fixed ones only where that is declared.
    fn moving(&self, problem: &Problem, host: &Host) -> Result<impl Fn(usize) -> bool + use<>, Error> {
        let (is_active, mask, slots) = (host.is_active()?, problem.mask.clone(), self.slots());
        let (all, of_fixed) = (matches!(self.shape, Shape::System(_)), self.of_fixed);
        Ok(move |i: usize| {
            let id = i / slots;
            all || is_active(id) && (of_fixed || mask.get(id).is_none_or(|word| *word == 0))
        })
    }
}

impl Advanced {
    /// The advanced column of a declared pair.
    pub fn of(pair: &Pair, columns: &Columns) -> Self {
        Self { part: Part::of(&pair.column, columns), rate: pair.rate.place.buffer.clone() }
    }
}

/// The element of a buffer of real numbers that contains a column.
pub trait Real: Element<Reference: Add<Output = Self::Reference> + Mul<f64, Output = Self::Reference>> {
    /// Zero.
    const ZERO: Self::Reference;
    /// The new value in the components of a column, the old one elsewhere.
    fn own(old: Self::Reference, new: Self::Reference, components: &Range<usize>) -> Self::Reference;
    /// Whether the components of a column are finite.
    fn is_finite(value: Self::Reference, components: &Range<usize>) -> bool;
}

impl Real for f32 {
    const ZERO: f64 = 0.0;
    fn own(_: f64, new: f64, _: &Range<usize>) -> f64 {
        new
    }
    fn is_finite(value: f64, _: &Range<usize>) -> bool {
        value.is_finite()
    }
}

impl Real for Vec4 {
    const ZERO: DVec4 = DVec4::ZERO;
    fn own(old: DVec4, new: DVec4, components: &Range<usize>) -> DVec4 {
        let (mut mixed, new) = (old.to_array(), new.to_array());
        for (mixed, new) in mixed.iter_mut().zip(new).take(components.end).skip(components.start) {
            *mixed = new;
        }
        DVec4::from(mixed)
    }
    fn is_finite(value: DVec4, components: &Range<usize>) -> bool {
        Self::own(DVec4::ZERO, value, components).is_finite()
    }
}

/// The operation of a kernel, for either type of element.
pub trait Work: Clone + Send + Sync + 'static {
    /// The reference.
    fn run<T: Real>(&self, host: &Host) -> Result<(), Error>;
}

/// A kernel of one invocation for each element of a part, under the name of its column.
pub fn kernel(
    verb: &str,
    part: &Part,
    file: Source,
    constants: &[(&'static str, f64)],
    fields: &[(&'static str, Name)],
    problem: &Problem,
    work: impl Work,
) -> Result<Kernel, Error> {
    let system = matches!(part.shape, Shape::System(_));
    let (holding, tables): (Source, Vec<Table>) =
        if system || part.of_fixed { (crate::shader!("motion/free.wgsl"), Vec::new()) } else { problem.holding() };
    let living = if system { crate::shader!("life/all_active.wgsl") } else { problem.active() };
    let shader = Shader::join(&[
        crate::shader!("world.wgsl"),
        crate::shader!("broken.wgsl"),
        holding,
        living,
        part.source(),
        file,
    ])?;
    let elements = part.elements(problem);
    let own = [
        ("ELEMENTS", elements),
        ("SLOTS", part.slots()),
        ("FIRST", part.components.start),
        ("END", part.components.end),
    ];
    let known = |name: &str| shader.reflection().overrides.contains_key(name);
    let own = own.into_iter().filter(|(name, _)| known(name)).map(|(name, value)| (name, value as f64));
    let constants: Vec<_> = constants.iter().copied().chain(own).collect();
    // Fields with one element for each particle need no length.
    let sizes = |fields: &[(&'static str, Name)]| -> Vec<(Name, u64)> {
        let listed = part.shape != Shape::Particle;
        fields.iter().filter(|_| listed).map(|(_, name)| (name.clone(), elements as u64)).collect()
    };
    let number = u32::try_from(elements).map_err(|_| {
        Error::Limit(format!("the column `{}` has {elements} elements: 2³² − 1 are the most", part.name))
    })?;
    let reference: Reference = if part.vectors {
        Arc::new(move |host: &Host| work.run::<Vec4>(host))
    } else {
        Arc::new(move |host: &Host| work.run::<f32>(host))
    };
    let (sizes, threads) = (sizes(fields), Threads::new(number));
    let pass = Pass { constants, threads, alone: true, ..Pass::new(shader, number) }.on(fields);
    let factors =
        pass.constants.iter().filter(|(name, value)| ["FACTOR", "WEIGHT"].contains(name) && (*value - 1.0).abs() > 0.0);
    let factors = factors.map(|(name, value)| format!(" {name}={}", crate::kernel::short(*value)));
    let factors = factors.collect::<Vec<_>>().concat();
    Ok(Kernel {
        name: format!("{verb} {}{factors}", part.name),
        passes: vec![pass],
        reference: Some(reference),
        sizes,
        scratch: Vec::new(),
        tables,
    })
}
