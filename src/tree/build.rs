//! Builds a tree: keys along the curve, a sort, leaves, and level after level up to the root.

use std::sync::Arc;

use super::{
    GROUP, LEAF, Opening, TREE_BODY, TREE_CENTER, TREE_DEMAND, TREE_HIGH, TREE_ID, TREE_LOW, TREE_MASS, TREE_SHAPE,
    Tree, curve, reference,
};
use crate::error::Error;
use crate::kernel::{Field, Host, Kernel, Name, POSITION, Pass, Problem, Scalar, Shader, Source};
use crate::primitives::{Items, Operation, radix_sort, rows};

/// Temporary fields of the construction, shared by all trees. First the corners of the bounding box.
pub(super) const LEAST: Field<glam::Vec4> = Field::new("tree_least");
pub(super) const GREATEST: Field<glam::Vec4> = Field::new("tree_greatest");
/// The lowest corner of all positions, and their places from there, where positions have two words.
pub(super) const ORIGIN: Field<glam::Vec4> = Field::new("tree_origin");
pub(super) const PLACE: Field<glam::Vec4> = Field::new("tree_place");
/// Its lowest corner, and cells per length.
pub(super) const CUBE: Field<glam::Vec4> = Field::new("tree_cube");
/// The key word of the next sort, in the present order; and the upper words by id.
pub(super) const KEY: Field<u32> = Field::new("tree_key");
pub(super) const UPPER: Field<u32> = Field::new("tree_upper");

/// The level below the root from which the sum of the magnitudes of attractions is taken.
pub(super) const PULLS: u32 = 6;
/// The fraction of that sum that counts as a force where attractions cancel.
pub(super) const PART: f64 = 1.0 / 32.0;

/// The type of a reference of a tree kernel.
type Rule = fn(&Tree, &Host) -> Result<(), Error>;

impl Tree {
    /// The kernels that build it from the current positions and, with the relative opening criterion, from the
    /// last accelerations.
    ///
    /// # Errors
    /// When a shader does not compile, or there are more particles than a sort takes.
    pub fn kernels(&self, problem: &Problem) -> Result<Vec<Kernel>, Error> {
        let (machine, count) = (&problem.machine, self.count);
        let corner = |of: Field<glam::Vec4>, operation, into: Field<glam::Vec4>| {
            rows(operation, Items::Vec4, &of.name.into(), &into.name.into(), count, machine)
        };
        let places = self.places();
        let sort = |bits| radix_sort(&KEY.name.into(), &self.field(TREE_ID).1, count, bits, machine);
        let mut kernels = Vec::new();
        if self.two_words {
            kernels.push(corner(POSITION, Operation::Min, ORIGIN)?);
            let pass = self.each(&[crate::shader!("tree/place.wgsl")], count)?;
            kernels.push(self.kernel("places", pass, reference::places));
        }
        kernels.extend([
            corner(places, Operation::Min, LEAST)?,
            corner(places, Operation::Max, GREATEST)?,
            self.kernel("cube", self.cube()?, reference::cube),
            self.kernel("keys", self.placed(&[crate::shader!("tree/key.wgsl"), HILBERT])?, reference::keys),
            sort(curve::LOWER)?,
            self.kernel("upper words", self.each(&[crate::shader!("tree/upper.wgsl")], count)?, reference::upper),
            sort(curve::UPPER)?,
            self.kernel("carry", self.placed(&[crate::shader!("tree/carry.wgsl")])?, reference::carry),
            self.levels()?,
        ]);
        if let Opening::Relative { alpha, g, .. } = self.opening {
            let mut pass = self.each(&[LIVE, crate::shader!("tree/demand.wgsl")], self.groups())?;
            let above = self.height().saturating_sub(PULLS);
            let (first, _) = self.level(above);
            pass.constants.extend(problem.constants(&pass.shader));
            pass.constants.extend([("GROUP", f64::from(GROUP)), ("STRICTNESS", g / alpha), ("PART", g * PART)]);
            pass.constants
                .extend([("FIRST", first), ("ABOVE", above), ("LEAF", LEAF)].map(|(name, n)| (name, f64::from(n))));
            pass.work = 3 * u64::from(count);
            kernels.push(self.kernel("demand", pass, reference::demand));
        }
        if problem.block_steps.is_some() {
            let mut pass = self.each(&[crate::shader!("tree/due.wgsl")], self.groups())?;
            let relative = u8::from(self.opening.is_relative());
            pass.constants.extend([("GROUP", f64::from(GROUP)), ("RELATIVE", f64::from(relative))]);
            kernels.push(self.kernel("due groups", pass, reference::due));
        }
        Ok(kernels)
    }

    /// The fields that do not have one element for each particle, and their elements: for kernels that bind them.
    #[must_use]
    pub fn sizes(&self) -> Vec<(Name, u64)> {
        let nodes =
            [TREE_CENTER, TREE_MASS, TREE_SHAPE, TREE_LOW, TREE_HIGH].map(|of| (self.field(of).1, self.nodes()));
        let mut all = nodes.to_vec();
        all.push((self.field(TREE_DEMAND).1, u64::from(self.groups())));
        all
    }

    /// The fields of this tree, by the names that shaders use.
    #[must_use]
    pub fn fields(&self) -> [(&'static str, Name); 8] {
        [TREE_ID, TREE_BODY, TREE_CENTER, TREE_MASS, TREE_SHAPE, TREE_LOW, TREE_HIGH, TREE_DEMAND]
            .map(|name| self.field(name))
    }

    fn kernel(&self, name: &str, pass: Pass, reference: Rule) -> Kernel {
        let tree = self.clone();
        let corners = [LEAST.name, GREATEST.name, CUBE.name, ORIGIN.name].map(|name| (name.into(), 1));
        Kernel {
            name: format!("{name} {}", self.name()),
            passes: vec![pass],
            reference: Some(Arc::new(move |host: &Host| reference(&tree.of_rows(host.world().count), host))),
            sizes: [corners.to_vec(), self.sizes()].concat(),
            scratch: Vec::new(),
            tables: Vec::new(),
        }
    }

    fn each(&self, files: &[Source], threads: u32) -> Result<Pass, Error> {
        let mut all = vec![crate::shader!("world.wgsl"), crate::shader!("fields.wgsl")];
        all.extend_from_slice(files);
        Ok(Pass::new(Shader::join(&all)?, threads).on(&self.fields()))
    }

    /// A pass over all particles that finds places under the name of positions.
    fn placed(&self, files: &[Source]) -> Result<Pass, Error> {
        let mut pass = self.each(files, self.count)?;
        pass.fields.push((POSITION.name.into(), self.places().name.into()));
        Ok(pass)
    }

    fn cube(&self) -> Result<Pass, Error> {
        self.each(&[HILBERT, crate::shader!("tree/cube.wgsl")], 1)
    }

    /// The leaves, and each level above them.
    fn levels(&self) -> Result<Kernel, Error> {
        let node = crate::shader!("tree/node.wgsl");
        let leaf = self.each(&[node.clone(), LIVE, crate::shader!("tree/leaf.wgsl")], 1)?;
        let inner = self.each(&[node, LIVE, crate::shader!("tree/inner.wgsl")], 1)?;
        let mut passes = Vec::new();
        for above in 0..=self.height() {
            let (first, nodes) = self.level(above);
            let pass = if above == 0 { &leaf } else { &inner };
            let values = [("first", first), ("above", above)].map(|(name, n)| (name, Scalar::Uint(n)));
            let block = pass.shader.reflection().binding("level");
            let block = block.map_or(Ok(Vec::new()), |b| b.packed.pack("level", &values))?;
            let constants = vec![("OPENING", self.stretch()), ("CORE", self.core), ("LEAF", f64::from(LEAF))];
            passes.push(Pass {
                constants,
                uniforms: vec![("level", block)],
                ..Pass { fields: pass.fields.clone(), ..Pass::new(pass.shader.clone(), nodes) }
            });
        }
        let mut kernel = self.kernel("nodes", leaf, reference::nodes);
        kernel.passes = passes;
        Ok(kernel)
    }
}

const LIVE: Source = crate::shader!("tree/live.wgsl");
const HILBERT: Source = crate::shader!("tree/hilbert.wgsl");
