//! The tables of a law, of pairs of species and of data, bound to fields of its own, and its constants.

use super::{Law, PAIR_TABLE, numbered};
use crate::error::Error;
use crate::kernel::{Access, Kernel, Name, Pass, Problem};

impl Law {
    /// The tables that its WGSL binds, of pairs of species and of data, and the values of its `override`s.
    pub(super) fn bind_tables(&self, kernel: &mut Kernel, problem: &Problem) -> Result<(), Error> {
        for pass in &mut kernel.passes {
            pass.constants.extend(pass.shader.reflection().known(&self.constants));
        }
        let passes = kernel.passes.clone();
        let binding = |name: &str| {
            let mut all = passes.iter().flat_map(|pass| &pass.shader.reflection().bindings);
            all.find(|binding| binding.name == name)
        };
        let mut tables = Vec::new();
        if let Some(pairs) = &self.pairs {
            let present: Vec<u32> = if problem.species.is_empty() {
                vec![0]
            } else {
                problem.species.iter().map(|(species, _)| *species).collect()
            };
            let Some(binding) = binding(PAIR_TABLE) else {
                return Err(Error::Scene(format!(
                    "`{}` is given parameters of pairs of species, but {} reads no `var<storage, read> {PAIR_TABLE}: array<Pair>`",
                    self.name, self.wgsl.file
                )));
            };
            let words = pairs.words(&self.name, binding, &present)?;
            let (uniform, stride) = (binding.access == Access::Uniform, binding.stride);
            let side = if pairs.is_alike() { 1.0 } else { f64::from(pairs.side(&present)) };
            if uniform {
                let bytes: Vec<u8> = words.1.iter().flat_map(|word| word.to_le_bytes()).collect();
                let binds = |pass: &&mut Pass| pass.shader.reflection().binding(PAIR_TABLE).is_some();
                kernel.passes.iter_mut().filter(binds).for_each(|pass| pass.uniforms.push((PAIR_TABLE, bytes.clone())));
            } else {
                tables.push((words, stride));
            }
            let tells = |pass: &&mut Pass| pass.shader.reflection().overrides.contains_key("SPECIES");
            kernel.passes.iter_mut().filter(tells).for_each(|pass| pass.constants.push(("SPECIES", side)));
        }
        for table in &self.tables {
            let Some(binding) = binding(&table.0) else {
                return Err(Error::Scene(format!(
                    "`{}` is given the table `{}`, but {} reads no storage buffer of that name",
                    self.name, table.0, self.wgsl.file
                )));
            };
            tables.push((table.clone(), binding.stride));
        }
        for (table, stride) in tables {
            let (inside, words) = table;
            // Each law has one of the first name; of the others, each of one file.
            let field: Name = if inside == PAIR_TABLE {
                format!("{inside} of {}", self.name).into()
            } else {
                numbered(&inside, self.earlier).into()
            };
            kernel.sizes.push((field.clone(), 4 * words.len() as u64 / stride.max(1)));
            let binds = |pass: &&mut Pass| pass.shader.reflection().binding(&inside).is_some();
            kernel.passes.iter_mut().filter(binds).for_each(|pass| pass.fields.push((inside.clone(), field.clone())));
            kernel.tables.push((field, words));
        }
        Ok(())
    }
}
