//! A plan of two loops, one in the other, whose kernels count how often they run.

use std::sync::Arc;

use motes::kernel::{Host, Kernel, Plan, Reference, Shader, Source};

/// Several workgroups, the last not full.
pub const COUNT: u32 = 300;

const STATE: &str = "
struct State { outer: u32, outer_done: u32, inner: u32, inner_done: u32 }
override LIMIT: u32 = 0u;
";

/// The outer loop is done after `outer` iterations, the inner one after one more in each: `inner`, `inner` + 1 …
#[derive(Debug, Clone, Copy)]
pub struct Toy {
    pub outer: u32,
    pub inner: u32,
    /// How often the outer loop runs at most, and the inner one.
    pub most: [u32; 2],
}

/// Flags that come early, late and never; loops of one, of none.
pub fn all() -> Vec<Toy> {
    let mut all = Vec::new();
    for most in [[1, 1], [4, 1], [1, 4], [5, 6], [6, 5], [0, 3], [3, 0]] {
        for (outer, inner) in [(1, 1), (2, 1), (1, 4), (3, 2), (3, 5), (9, 9)] {
            all.push(Toy { outer, inner, most });
        }
    }
    all
}

impl Toy {
    pub fn plan(self) -> Plan {
        let mut inner = Plan::of([begin()]);
        let body = Plan::of([work(), counting("count", "inner", self.inner)]);
        inner.repeat(self.most[1], "state", 0, "inner_done", body).expect("a loop");
        inner.append(Plan::of([mark(), counting("count outer", "outer", self.outer)]));
        let mut plan = Plan::of([kernel("start", START, "state[0] = State();", Arc::new(start), 0)]);
        plan.repeat(self.most[0], "state", 0, "outer_done", inner).expect("a loop");
        plan
    }
    /// How often the bodies run, the inner one and the outer one.
    pub fn counts(self) -> [u32; 2] {
        let (mut work, mut marks) = (0, 0);
        for outer in 0..self.most[0].min(self.outer) {
            work += self.most[1].min(self.inner + outer);
            marks += 1;
        }
        [work, marks]
    }
}

const START: &str = "@group(0) @binding(1) var<storage, read_write> state: array<State>;";

fn kernel(name: &str, bindings: &'static str, body: &'static str, reference: Reference, limit: u32) -> Kernel {
    let entry = "@compute @workgroup_size(64) fn run(@builtin(global_invocation_id) id: vec3u) { let i = id.x; let limit = LIMIT; ";
    let text = [STATE, bindings, entry, body, " }"].concat();
    let shader = Shader::join(&[Source::theirs(name.to_owned(), text)]).expect("a shader");
    let lanes = if bindings.contains("array<u32>") { COUNT } else { 1 };
    let mut kernel = Kernel::new(name, shader, vec![("LIMIT", f64::from(limit))], lanes, reference);
    name.clone_into(&mut kernel.name);
    kernel.sizes.push(("state".into(), 1));
    kernel
}

fn start(host: &Host) -> Result<(), motes::Error> {
    host.writing::<u32>("state")?.fill(0);
    Ok(())
}

fn begin() -> Kernel {
    let reference = |host: &Host| {
        host.writing::<u32>("state")?[2..].fill(0);
        Ok(())
    };
    let text = "if i == 0u { state[0].inner = 0u; state[0].inner_done = 0u; }";
    kernel("begin", START, text, Arc::new(reference), 0)
}

fn adds(name: &str, field: &'static str, bindings: &'static str, body: &'static str) -> Kernel {
    let reference = move |host: &Host| {
        host.writing::<u32>(field)?.iter_mut().for_each(|n| *n += 1);
        Ok(())
    };
    kernel(name, bindings, body, Arc::new(reference), 0)
}

/// Every lane works.
pub fn work() -> Kernel {
    let binding = "@group(0) @binding(0) var<storage, read_write> work: array<u32>;";
    adds("work", "work", binding, "if i < arrayLength(&work) { work[i] += 1u; }")
}

fn mark() -> Kernel {
    let binding = "@group(0) @binding(0) var<storage, read_write> marks: array<u32>;";
    adds("mark", "marks", binding, "if i < arrayLength(&marks) { marks[i] += 1u; }")
}

/// The kernel that ends the inner loop.
pub fn count() -> Kernel {
    counting("count", "inner", 3)
}

/// One that reads the state and writes elsewhere.
pub fn look() -> Kernel {
    let bindings = "@group(0) @binding(0) var<storage, read_write> work: array<u32>;
        @group(0) @binding(1) var<storage, read> state: array<State>;";
    adds("look", "work", bindings, "if i < arrayLength(&work) { work[i] += min(1u, state[0].inner + 1u); }")
}

fn counting(name: &str, level: &'static str, limit: u32) -> Kernel {
    let inner = level == "inner";
    let reference = move |host: &Host| {
        let mut state = host.writing::<u32>("state")?;
        let (first, limit) = if inner { (2, limit + state[0]) } else { (0, limit) };
        state[first] += 1;
        state[first + 1] = u32::from(state[first] >= limit);
        Ok(())
    };
    let text = if inner {
        "if i == 0u { state[0].inner += 1u; state[0].inner_done = u32(state[0].inner >= limit + state[0].outer); }"
    } else {
        "if i == 0u { state[0].outer += 1u; state[0].outer_done = u32(state[0].outer >= limit); }"
    };
    kernel(name, START, text, Arc::new(reference), limit)
}
