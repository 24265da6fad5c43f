mod support;
use motes::settings::{Settings, Value};
use motes::*;

fn setup(n: usize) -> Setup {
    let e = forces::entry("gravity").unwrap();
    let s = Settings::defaults(e.keys).with("softening", Value::Number(0.07)).with("g", Value::Number(1.1));
    Setup {
        particles: support::cloud(n, 3),
        forces: vec![(e.build)(&s)],
        integrator: (integrators::entry("leapfrog").unwrap().build)(),
        dt: 0.013,
    }
}

#[test]
fn gpu_and_cpu_agree() {
    let d = support::device();
    for n in [1usize, 2, 63, 64, 65, 128, 129, 511, 512, 513, 1000, 4000] {
        for (soft, sub, inv) in [(true, 8, 1), (true, 8, 2048), (true, 0, 1), (false, 0, 1), (false, 0, 1 << 18)] {
            let mut gpu = Gpu::new(&d.found.device, &d.found.queue, n as u32).unwrap();
            gpu.pretend(kernel::Machine { software: soft, subgroup: sub, invocations: inv });
            let mut a = Simulation::on(gpu, &setup(n)).unwrap();
            let mut b = Simulation::on(Cpu::new(n as u32).unwrap(), &setup(n)).unwrap();
            a.step(3).unwrap();
            b.step(3).unwrap();
            let x = pollster::block_on(a.snapshot()).unwrap();
            let y = pollster::block_on(b.snapshot()).unwrap();
            let worst = x
                .particles
                .position
                .iter()
                .zip(&y.particles.position)
                .map(|(a, b)| (*a - *b).length())
                .fold(0.0, f64::max);
            let (p, q): (f64, f64) = (x.potential.iter().sum(), y.potential.iter().sum());
            println!("{n} {soft} {sub} {inv} {} worst {worst:e} {p} {q}", a.plan());
            assert!(worst < 2e-6 && (p - q).abs() < 1e-5, "{n}");
        }
    }
}
