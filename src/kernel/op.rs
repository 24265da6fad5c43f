//! The order in which kernels run: a list of operations, some of them loops. A plan gives the body of a loop, the maximum number of
//! iterations, and the flag that ends it; a backend decides how to run it.

use super::{Kernel, Name, Plan};

/// A word of a field that a kernel sets to a nonzero value.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Flag {
    /// The field.
    pub field: Name,
    /// The index of the word, of four bytes each.
    pub word: u32,
    /// Its name in the shader.
    pub member: &'static str,
}

/// One operation of a plan.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Op {
    /// Runs a kernel, by its index in [`Plan::kernels`].
    Run(usize),
    /// Runs operations once, and then again for as long as the flag is zero.
    Repeat {
        /// The maximum number of times they run.
        most: u32,
        /// The flag that ends the loop. It is checked after each iteration but the last.
        until: Flag,
        /// The repeated operations; loops may contain loops.
        body: Vec<Op>,
    },
}

impl Op {
    /// The kernels that it runs, in order; those of a loop once.
    pub(super) fn kernels(&self) -> Box<dyn Iterator<Item = usize> + '_> {
        match self {
            Self::Run(index) => Box::new(std::iter::once(*index)),
            Self::Repeat { body, .. } => Box::new(body.iter().flat_map(Self::kernels)),
        }
    }
    /// The sum of a quantity over all kernels that it runs, loops in full.
    pub(super) fn total(&self, of: &dyn Fn(usize) -> u64) -> u64 {
        match self {
            Self::Run(index) => of(*index),
            Self::Repeat { most, body, .. } => u64::from(*most) * body.iter().map(|op| op.total(of)).sum::<u64>(),
        }
    }
    /// The same with other indices of kernels; empty loops are left out.
    pub(super) fn mapped(&self, place: &dyn Fn(usize) -> Option<usize>) -> Option<Self> {
        match self {
            Self::Run(index) => place(*index).map(Self::Run),
            Self::Repeat { most, until, body } => {
                let body: Vec<_> = body.iter().filter_map(|op| op.mapped(place)).collect();
                (!body.is_empty()).then(|| Self::Repeat { most: *most, until: until.clone(), body })
            }
        }
    }
}

/// The next action in a run of a plan.
#[derive(Debug, Clone, Copy)]
pub enum Next<'a> {
    /// A kernel runs.
    Run(&'a Kernel),
    /// A loop may end: if its flag is set, call [`Walk::leave`].
    Ask(&'a Flag),
}

/// A run of a plan, operation by operation, for a backend that can read flags on the way.
#[derive(Debug, Clone)]
pub struct Walk<'a> {
    plan: &'a Plan,
    levels: Vec<Level<'a>>,
}

/// A list of operations that is being run.
#[derive(Debug, Clone)]
struct Level<'a> {
    ops: &'a [Op],
    at: usize,
    /// Iterations left, including this one.
    left: u32,
    until: Option<&'a Flag>,
}

impl<'a> Walk<'a> {
    pub(super) fn new(plan: &'a Plan) -> Self {
        Self { plan, levels: vec![Level { ops: &plan.ops, at: 0, left: 1, until: None }] }
    }
    /// Ends the loop whose flag was returned last.
    pub fn leave(&mut self) {
        self.levels.pop();
    }
}

impl<'a> Iterator for Walk<'a> {
    type Item = Next<'a>;

    fn next(&mut self) -> Option<Next<'a>> {
        while let Some(level) = self.levels.last_mut() {
            match level.ops.get(level.at) {
                Some(Op::Run(index)) => {
                    level.at += 1;
                    if let Some(kernel) = self.plan.kernels.get(*index) {
                        return Some(Next::Run(kernel));
                    }
                }
                Some(Op::Repeat { most, until, body }) => {
                    level.at += 1;
                    if *most > 0 {
                        self.levels.push(Level { ops: body, at: 0, left: *most, until: Some(until) });
                    }
                }
                None => {
                    level.left -= 1;
                    match level.until {
                        Some(flag) if level.left > 0 => {
                            level.at = 0;
                            return Some(Next::Ask(flag));
                        }
                        _ => {
                            self.levels.pop();
                        }
                    }
                }
            }
        }
        None
    }
}

impl std::fmt::Display for Plan {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&self.line(&self.ops))
    }
}

impl Plan {
    fn line(&self, ops: &[Op]) -> String {
        let word = |op: &Op| match op {
            Op::Run(index) => match self.kernels.get(*index) {
                Some(kernel) if kernel.passes.len() > 1 => format!("{} ×{}", kernel.name, kernel.passes.len()),
                kernel => kernel.map_or_else(String::new, |kernel| kernel.name.clone()),
            },
            Op::Repeat { most, body, .. } => format!("(repeat ≤ {most}: {})", self.line(body)),
        };
        ops.iter().map(word).collect::<Vec<_>>().join(" | ")
    }
}
