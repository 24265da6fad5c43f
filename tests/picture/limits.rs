//! What must not overflow, and what must not be written.

use glam::DVec3;
use motes::kernel::{Array, Backend, World};
use motes::render::{Picture, Trail};
use motes::settings::Value;
use motes::*;

use super::*;

#[test]
fn all_lights_on_one_pixel_do_not_overflow() {
    // The canvas holds what all of them give: with a unit one bit larger, it would not.
    let count = 70_000_u32;
    let many = count as usize;
    let mut particles = State::default();
    for _ in 0..count {
        particles.push(DVec3::ZERO, DVec3::ZERO, 1.0, 0.0);
    }
    let settings = settings(65, 65).with("color", word("group")).with("style", word("glow"));
    let mut picture = Picture::new(&settings, &particles, &[], Trail::new(many)).unwrap();
    picture.color = render::Color::Given(vec![u32::MAX; many]);
    let device = support::device();
    let mut gpu = Gpu::new(&device.found.device, &device.found.queue, count).unwrap();
    let program = gpu.compile(&picture.plan().unwrap()).unwrap();
    gpu.set_world(World { count, dt: 0.1, ..World::default() }).unwrap();
    let array = |v: &[DVec3]| Array::Vec4(v.iter().map(|x| x.extend(1.0)).collect());
    gpu.write("position", &array(particles.position())).unwrap();
    gpu.write("velocity", &Array::Vec4(vec![glam::DVec4::ZERO; many])).unwrap();
    gpu.write("color", &Array::Uint(vec![u32::MAX; many])).unwrap();
    gpu.run(&program, 1).unwrap();
    let canvas = pollster::block_on(gpu.read("canvas", &Array::Uint(Vec::new()), 3 * 65 * 65)).unwrap();
    let Array::Uint(canvas) = canvas else { panic!("a canvas is of whole numbers") };
    // The particles are in the middle of the middle pixel, where each gives the whole unit.
    let middle = canvas[3 * (32 * 65 + 32)];
    assert!((f64::from(middle) - f64::from(count) * picture.frame.unit).abs() < 0.5, "{middle}");
    assert!(middle > u32::MAX / 4, "{middle}: a coarser unit than need be");
    assert!(f64::from(count) * 2.0 * picture.frame.unit > f64::from(u32::MAX) / 2.0);
}

#[test]
fn nothing_is_written_behind_the_end() {
    const MARK: u8 = 0xA7;
    const PAD: u64 = 256;
    for (count, width, height) in [(1_u32, 61, 33), (65, 130, 67), (1000, 64, 64)] {
        let mut particles = support::cloud(count as usize, 11);
        particles.size_mut().iter_mut().step_by(2).for_each(|r| *r = 0.2);
        // Much is beyond the edges.
        let settings =
            settings(width, height).with("auto_frame", Value::Flag(false)).with("extent", Value::Number(0.4));
        let picture = Picture::new(&settings, &particles, &[], trail(&particles)).unwrap();
        let device = support::device();
        let mut gpu = Gpu::new(&device.found.device, &device.found.queue, count).unwrap();
        gpu.pad(PAD);
        let plans =
            [picture.plan().unwrap(), picture.development(render::Exposure { knee: 900.0, white: 9e4 }).unwrap()];
        let programs = plans.each_ref().map(|plan| gpu.compile(plan).unwrap());
        gpu.set_world(World { count, dt: 0.1, ..World::default() }).unwrap();
        let fields: Vec<(String, u64)> =
            plans.iter().flat_map(|plan| plan.fields(count)).filter(|(name, _)| name != "world").collect();
        for (name, _) in &fields {
            gpu.write_bytes(name, 0, &vec![MARK; usize::try_from(gpu.size(name)).unwrap()]).unwrap();
        }
        let array = |v: &[DVec3], w: &[f64]| Array::Vec4(v.iter().zip(w).map(|(x, w)| x.extend(*w)).collect());
        gpu.write("position", &array(particles.position(), particles.mass())).unwrap();
        gpu.write("velocity", &array(particles.velocity(), particles.size())).unwrap();
        gpu.write("color", &Array::Uint(vec![0xff30_90e0; count as usize])).unwrap();
        let points: Vec<_> = picture.trail.points().map(|x| x.extend(0.0)).collect();
        if !points.is_empty() {
            gpu.write("trail", &Array::Vec4(points)).unwrap();
        }
        for program in &programs {
            gpu.run(program, 1).unwrap();
        }
        for (name, bytes) in fields {
            let size = gpu.size(&name);
            let behind = pollster::block_on(gpu.bytes(&name, bytes, size - bytes)).unwrap();
            assert!(behind.len() as u64 >= PAD * 16 && behind.iter().all(|b| *b == MARK), "{name} of {count}");
        }
    }
}
