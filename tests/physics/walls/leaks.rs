//! No particle leaves.

use glam::DVec3;
use motes::settings::Value;
use motes::sph::{Smoothing, gap};

use crate::support::states::force;
use crate::walls::{builtin, setup, vector, watched, word};

/// How many of the first are outside of a room.
fn outside(places: &[DVec3], fluid: usize, low: DVec3, high: DVec3) -> usize {
    places[..fluid].iter().filter(|x| x.cmplt(low).any() || x.cmpgt(high).any()).count()
}

/// 2000 particles fall from the left of a closed tank to its right, up to its lid, and back.
#[test]
fn walls_of_particles_leak_nothing() {
    let room = DVec3::new(2.0, 1.0, 2.5);
    let setup = setup(
        "[simulation]\ndt = 0.001\nsteps = 1\n[[particles]]\nshape = \"block\"\nsize = [1, 1, 2]\ncenter = [0.5, 0.5, 1]\n\
         [[particles]]\nshape = \"tank\"\nsize = [2, 1, 2.5]\ncenter = [1, 0.5, 1.25]\n\
         [[force]]\nkind = \"uniform\"\nacceleration = [3, 2, -9.81]\n\
         [[force]]\nkind = \"fluid\"\nspacing = 0.1\nsound_speed = 62.6\nalpha = 0.02\n",
    );
    setup.start().expect("a good start");
    // Walls stand so far behind the face, and a particle before them is in: what is pressed to them comes near.
    let margin = 0.1 * (gap(Smoothing::Cubic, 2.0, 1, 3) - 0.5);
    let (mut top, mut right) = (0.0f64, 0.0f64);
    watched(&setup, 50, |time, places| {
        let out = outside(places, 2000, DVec3::splat(-margin), room + margin);
        assert_eq!(out, 0, "{out} are outside after {time} s");
        top = places[..2000].iter().map(|x| x.z).fold(top, f64::max);
        right = places[..2000].iter().map(|x| x.x).fold(right, f64::max);
        time < 2.0
    });
    // It was violent: they were at the right wall, and above where they began.
    assert!(right > 1.9 && top > 2.0, "{right} {top}");
}

/// The same in a solid, which puts back every particle in it; and in one with walls of particles before it.
#[test]
fn solids_leak_nothing() {
    let text = |walls: &str, thickness: f64| {
        format!(
            "[simulation]\ndt = 0.001\nsteps = 1\n[box]\nsize = [3, 3, 0]\nboundary = \"open\"\n\
             [[particles]]\nshape = \"block\"\nsize = [1, 1.6, 0]\ncenter = [0.5, 0.8, 0]\n{walls}\
             [[force]]\nkind = \"uniform\"\nacceleration = [0, -9.81, 0]\n\
             [[force]]\nkind = \"fluid\"\nspacing = 0.05\nsound_speed = 40\nalpha = 0.1\n\
             [[force]]\nkind = \"solid\"\nshape = \"box\"\nposition = [1, 1, 0]\nsize = [2, 2, 1]\ninside = true\nthickness = {thickness}\n"
        )
    };
    let tank = "[[particles]]\nshape = \"tank\"\nsize = [2, 2, 0]\ncenter = [1, 1, 0]\nopen = \"+y\"\n";
    // A margin of half a spacing, where nothing else keeps the first layer off.
    for (walls, thickness) in [("", 0.025), (tank, 0.0)] {
        let setup = setup(&text(walls, thickness));
        let margin = DVec3::new(thickness, thickness, 0.0) - 1e-6;
        let mut right = 0.0f64;
        watched(&setup, 50, |time, places| {
            let out = outside(places, 640, margin.with_z(-1.0), DVec3::splat(2.0) - margin);
            assert_eq!(out, 0, "{out} are outside after {time} s");
            right = places[..640].iter().map(|x| x.x).fold(right, f64::max);
            time < 1.5
        });
        assert!(right > 1.9, "{right}");
    }
}

/// Splash is faster than the flow, and goes anywhere: what we show ends with none out of its box.
#[test]
fn splash_stays_in_the_box_of_what_we_show() {
    let readme = include_str!("../../../docs/pages/tutorials/dam_break.md")
        .split("```toml\n")
        .nth(1)
        .expect("a dam in the book");
    let coarse = ["force.1.spacing=0.1", "simulation.dt=0.001"];
    let small = setup(readme.split("```").next().expect("a scene"));
    for (setup, fluid, until, high) in
        [(small, 1000, 1.0, DVec3::new(2.0, 1.0, 0.0)), (builtin("dam_break_2d", &coarse), 200, 1.6, DVec3::splat(4.0))]
    {
        let mut top = 0.0f64;
        watched(&setup, 50, |time, places| {
            let out = outside(places, fluid, DVec3::ZERO, high);
            assert_eq!(out, 0, "{out} are out of {high} at {time}");
            top = places[..fluid].iter().map(|x| x.y).fold(top, f64::max);
            time < until
        });
        // Splash got there, or above the edge.
        assert!(top > 0.8 * high.y, "{top} of {}", high.y);
    }
}

/// The paddle of the wave tank goes where its motion says, the water goes along with it, and stays before it.
#[test]
fn a_paddle_makes_waves_and_lets_no_particle_by() {
    let setup = builtin("wave_tank", &["force.1.spacing=0.0625", "simulation.dt=0.001", "particles.0.jitter=0.05"]);
    let count = 64 * 8;
    let (paddle, motion) =
        (setup.state.held.iter().map(|one| one.id as usize).max().expect("held"), &setup.state.motions[0]);
    let home = setup.state.position()[paddle];
    let mut crest = 0.0f64;
    watched(&setup, 50, |time, places| {
        let face = places[paddle];
        // Positions of f32 up to 4: 2.4e-7 in each of some hundred steps, by half of them to either side.
        assert!(face.distance(motion.place(home, time)) < 1e-5, "{face} at {time}");
        let behind = places[..count].iter().filter(|x| x.x < face.x || x.y < 0.0 || x.x > 4.03).count();
        assert_eq!(behind, 0, "{behind} are through at {time}");
        crest = places[..count].iter().map(|x| x.y).fold(crest, f64::max);
        time < 2.0
    });
    // By theory crests are 1.2 strokes high from trough to crest: some 0.1 above the level of 0.5 - 0.03.
    assert!((0.52..0.75).contains(&crest), "{crest}");
}

/// A solid in the box that it keeps: what the force says of itself.
#[test]
fn a_solid_that_is_no_container_keeps_a_fluid_out() {
    let solid = force(
        "solid",
        &[("shape", word("sphere")), ("inside", Value::Flag(false)), ("position", vector(0.0, 0.0, 0.0))],
    );
    let mut setup = setup(
        "[simulation]\ndt = 0.001\nsteps = 1\n[box]\nsize = [9, 9, 0]\nboundary = \"open\"\n\
         [[particles]]\nshape = \"drop\"\nsize = [0.8, 0.8, 0]\ncenter = [0.1, 1.2, 0]\nvelocity = [0, -3, 0]\n\
         [[force]]\nkind = \"fluid\"\nspacing = 0.05\nsound_speed = 40\nalpha = 0.1\n",
    );
    setup.forces.push(solid);
    let (mut near, mut low) = (f64::INFINITY, 9.0f64);
    watched(&setup, 20, |time, places| {
        near = places.iter().map(|x| x.length()).fold(near, f64::min);
        low = places.iter().map(|x| x.y).fold(low, f64::min);
        time < 0.8
    });
    // On the surface, to the rounding of f32; and by it.
    assert!(near > 0.5 - 1e-6 && near < 0.51 && low < 0.2, "{near} {low}");
}
