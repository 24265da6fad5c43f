//! Bodies to build trees of, and trees of them on a device.

use glam::{DVec3, Vec4};
use motes::gpu::Gpu;
use motes::kernel::{ACCELERATION, Array, Backend, Element, Host, Machine, POSITION, Plan, Problem, World};
use motes::tree::{Opening, Tree};

use crate::support::{Random, Shared, machines};

/// The variants of the sort and of reductions: for GPUs, and for software adapters.
pub const MACHINES: [Machine; 2] = [
    Machine { software: true, subgroup: 0, invocations: 256, ..Machine::HOST },
    Machine { software: false, subgroup: 0, invocations: 1 << 18, ..Machine::HOST },
];
pub const GEOMETRIC: Opening = Opening::Geometric { theta: 0.7 };
pub const RELATIVE: Opening = Opening::Relative { alpha: 0.005, g: 1.3, theta: 0.6 };

/// Bodies in a cube of side 2, their masses about 1 / n, as f32 holds them.
pub fn cloud(count: usize, seed: u64) -> Vec<Vec4> {
    let mut random = Random::new(seed);
    (0..count).map(|_| random.vector().extend((1.3 + 0.4 * random.next()) / count as f64).as_vec4()).collect()
}

/// Sets that are awkward, by name.
pub fn awkward(count: usize) -> Vec<(&'static str, Vec<Vec4>)> {
    let mut random = Random::new(9);
    let shaped = |shape: fn(DVec3) -> DVec3, random: &mut Random| -> Vec<Vec4> {
        (0..count).map(|_| shape(random.vector()).extend(0.7 + 0.2 * random.next()).as_vec4()).collect()
    };
    let heavy = |i: usize| if i % 17 == 3 { 1e6 } else { 1.0 };
    let mut ratio = cloud(count, 4);
    ratio.iter_mut().enumerate().for_each(|(i, b)| b.w *= heavy(i) as f32);
    let mut some = cloud(count, 5);
    some.iter_mut().enumerate().filter(|(i, _)| i % 3 > 0).for_each(|(_, b)| b.w = 0.0);
    let mut twice = cloud(count, 6);
    (0..count / 2).for_each(|i| twice[2 * i + 1] = twice[2 * i]);
    vec![
        ("at one place", vec![Vec4::new(0.3, -1.7, 2.9, 0.4); count]),
        ("in a line", shaped(|x| DVec3::new(0.5, 3.0 * x.y, -1.0), &mut random)),
        ("in a plane", shaped(|x| DVec3::new(x.x + 10.0, x.y, 0.25), &mut random)),
        ("in a skew line", shaped(|x| x.x * DVec3::new(1.0, -2.0, 0.5), &mut random)),
        ("in a cusp", shaped(|x| x * x.length().powi(6), &mut random)),
        ("far away", shaped(|x| x + DVec3::new(1e5, -3e4, 7e3), &mut random)),
        ("heavy and light", ratio),
        ("massless", cloud(count, 7).into_iter().map(|b| b.truncate().extend(0.0)).collect()),
        ("some massless", some),
        ("in pairs", twice),
    ]
}

/// A device with bodies and their last accelerations, and a tree over them, not yet built.
pub struct Built {
    pub gpu: Gpu,
    pub tree: Tree,
    pub plan: Plan,
    count: u32,
}

impl Built {
    pub fn new(shared: &Shared, bodies: &[Vec4], last: &[Vec4], opening: Opening, core: f64, machine: Machine) -> Self {
        let count = u32::try_from(bodies.len()).expect("few");
        let mut gpu = machines::gpu(shared, bodies.len());
        gpu.pretend(machine);
        let problem = Problem::new(count, machine);
        let tree = Tree::new(opening, core, &problem);
        let mut plan = Plan::default();
        tree.kernels(&problem).expect("kernels").into_iter().for_each(|kernel| plan.add(kernel));
        gpu.compile(&plan).expect("a program");
        gpu.set_world(World { count, ..World::default() }).expect("a world");
        gpu.write_bytes(POSITION.name, 0, bytemuck::cast_slice(bodies)).expect("bodies");
        if !last.is_empty() && matches!(opening, Opening::Relative { .. }) {
            gpu.write_bytes(ACCELERATION.name, 0, bytemuck::cast_slice(last)).expect("their last accelerations");
        }
        Self { gpu, tree, plan, count }
    }
    /// A tree that a device has built.
    pub fn run(mut self) -> Self {
        let program = self.gpu.compile(&self.plan).expect("a program");
        self.gpu.run(&program, 1).expect("a run");
        self
    }
    /// The bytes of a field.
    pub fn bytes(&mut self, name: &'static str) -> Vec<u8> {
        let fields = self.plan.fields(self.count);
        let own = self.tree.field(name).1;
        let name = if fields.contains_key(name) { name } else { &own };
        let bytes = fields.get(name).copied().unwrap_or_else(|| panic!("no field {name}"));
        pollster::block_on(self.gpu.bytes(name, 0, bytes)).expect("a field")
    }
    /// The field's elements.
    pub fn read<T: Element>(&mut self, name: &'static str) -> Vec<T> {
        bytemuck::pod_collect_to_vec(&self.bytes(name))
    }
    /// All that is read of a tree, on the host.
    pub fn host(&mut self) -> Host {
        let mut host = Host::default();
        host.set_world(World { count: self.count, ..World::default() });
        let mut insert = |built: &mut Self, name: &'static str, kind: Array| {
            let array = kind.like(&built.bytes(name));
            host.insert(&built.tree.field(name).1.clone(), array);
        };
        insert(self, "tree_id", Array::Uint(Vec::new()));
        for name in ["tree_body", "tree_center", "tree_mass", "tree_shape", "tree_low", "tree_high"] {
            insert(self, name, Array::Vec4(Vec::new()));
        }
        if matches!(self.tree.opening, Opening::Relative { .. }) {
            insert(self, "tree_demand", Array::Float(Vec::new()));
        }
        host
    }
}
