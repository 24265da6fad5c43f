//! Starts: what would explode is refused, and the cause is named.

use motes::Setup;
use motes::scene::SCENES;

use crate::walls::{builtin, load, setup};

/// A scene of a fluid in the plane or in space, of these particles.
fn scene(flat: bool, force: &str, particles: &str) -> Setup {
    let plane = if flat { "[box]\nsize = [9, 9, 0]\nboundary = \"open\"\n" } else { "" };
    setup(&format!(
        "[simulation]\ndt = 1e-4\nsteps = 1\n{plane}{particles}[[force]]\nkind = \"fluid\"\nspacing = 0.1\nsound_speed = 20\n{force}"
    ))
}

fn block(more: &str) -> String {
    format!("[[particles]]\nshape = \"block\"\n{more}\n")
}

fn refused(setup: &Setup) -> String {
    setup.start().expect_err("a bad start").to_string()
}

#[test]
fn what_would_explode_is_named() {
    let cube = block("size = [0.6, 0.6, 0.6]");
    let square = block("size = [0.6, 0.6, 0]");
    // A wall of one layer, one spacing from the first of the fluid.
    let floor = "[[particles]]\nshape = \"lattice\"\nsize = [6, 6, 1]\nspacing = 0.1\ncenter = [0, 0, -0.35]\nfixed = [FIXED]\n";
    let fixed: Vec<String> = (0..36).map(|id| id.to_string()).collect();
    let floor = floor.replace("FIXED", &fixed.join(", "));
    for (flat, force, particles, words) in [
        (
            false,
            "support = 3\n",
            format!("{cube}{floor}"),
            "of a wall is 1.000e-1 away from it, and leaves the fluid at rest at 1.395e-1",
        ),
        (
            false,
            "",
            block("size = [0.6, 0.6, 0.6]\ndensity = 2000"),
            "its mass is 2.000000e0, and density × spacing^3 is 1.000000e0",
        ),
        (true, "", block("size = [0.6, 0.6, 0]\ndensity = 1300"), "density × spacing^2 is 1.000000e1"),
        (
            false,
            "",
            block("size = [0.6, 0.6, 0.6]\nspacing = 0.2"),
            "particles have the spacing 0.200000, and the force has 0.1",
        ),
        (
            true,
            "",
            block("size = [0.6, 0.6, 0]\nspacing = 0.17"),
            "particles have the spacing 0.170000, and the force has 0.1",
        ),
        (
            false,
            "",
            format!("{cube}{}", block("size = [0.6, 0.6, 0.6]\ncenter = [0.55, 0, 0]")),
            "of the fluid is 5.000e-2 away from it, and the spacing is 0.1: two blocks overlap",
        ),
        (true, "", format!("{square}{}", block("size = [0.2, 0.2, 0]\ncenter = [0.1, 0.1, 0]")), "two blocks overlap"),
    ] {
        let error = refused(&scene(flat, force, &particles));
        assert!(
            error.contains("this start would explode") && error.contains(words),
            "`{error}` does not say `{words}`"
        );
    }
}

#[test]
fn two_at_one_place_are_refused_however_wide_the_kernel() {
    // With a support of 4 spacings one more at the same place is 4 % of the density: no pressure to speak of, and none that parts
    // them.
    let one = "[[particles]]\nbodies = [{ position = [0.05, 0.05, 0.05], mass = 1 }]\n";
    let setup = scene(false, "support = 4\n", &format!("{}{one}", block("size = [0.6, 0.6, 0.6]")));
    let error = refused(&setup);
    assert!(error.contains("particles 129 and 216 of the fluid are") && error.contains("apart"), "{error}");
}

#[test]
fn what_is_no_fluid_is_refused() {
    let empty = block("size = [0.6, 0.6, 0.6]") + "[[particles]]\nbodies = [{ position = [2, 0, 0], mass = 0 }]\n";
    let error = refused(&scene(false, "", &empty));
    assert!(error.contains("particle 216 of the fluid has mass 0") && error.contains("give it the mass 1"), "{error}");
    let fluid = "[[force]]\nkind = \"fluid\"\nspacing = 0.1\nsound_speed = 20\n";
    let head = "[simulation]\ndt = 1e-4\nsteps = 1\n[[particles]]\n";
    let tank = format!("{head}shape = \"tank\"\nsize = [1, 1, 1]\n{fluid}");
    let walls = load(&tank).err().expect("walls alone").to_string();
    assert!(walls.contains("a fluid without particles") && walls.contains("shape = \"block\""), "{walls}");
    let mut two = scene(false, "", &block("size = [0.6, 0.6, 0.6]"));
    two.forces.extend(scene(false, "", &block("size = [0.6, 0.6, 0.6]")).forces);
    let error = two.check().expect_err("two fluids").to_string();
    assert!(error.contains("there are 2 fluids"), "{error}");
    let none = setup("[simulation]\ndt = 1\nsteps = 1\n[[particles]]\nbodies = [{ position = [0, 0, 0], mass = 0 }]\n");
    assert_eq!(none.start().expect("no fluid"), None);
}

#[test]
fn scenes_that_come_with_the_program_start_well() {
    let fluids: Vec<_> = SCENES.iter().filter(|scene| scene.text.contains("kind = \"fluid\"")).collect();
    assert!(fluids.len() >= 3);
    for scene in fluids {
        let start =
            builtin(scene.name, &[]).start().unwrap_or_else(|why| panic!("{}: {why}", scene.name)).expect("a fluid");
        // Up to corners of three walls.
        assert!(!start.summed || start.densest.1 < 1.012, "{}: {start:?}", scene.name);
    }
}

#[test]
fn by_continuity_a_fluid_begins_at_rest() {
    let heavy = |density: f64| block(&format!("size = [0.6, 0.6, 0.6]\ndensity = {density}"));
    let continuity = "density_by = \"continuity\"\n";
    let start = scene(false, continuity, &heavy(1100.0)).start().expect("a start").expect("a fluid");
    assert!(!start.summed && (start.densest.1 - 1.1).abs() < 1e-9, "{start:?}");
    // What a sum would refuse stays as it is forever, and is refused too.
    for by in ["density_by = \"summation\"\n", continuity] {
        assert!(refused(&scene(false, by, &heavy(2000.0))).contains("explode"));
    }
}

/// The bound is Mach 0.2 by the Riemann invariant of Tait's equation: (1.2 · 3 / 2 − …) for γ = 7, ((1 + x)³ − 1) / 3 = 0.2 at
/// x = 1.6^(1/3) − 1 = 0.1696.
#[test]
fn the_bound_is_where_it_says() {
    let dense = |density: f64| scene(false, "", &block(&format!("size = [0.6, 0.6, 0.6]\ndensity = {density}")));
    let start = dense(1169.0).start().expect("just below").expect("a fluid");
    assert!((start.densest.1 - 1.169).abs() < 1e-9 && (start.burst() / 20.0 - 0.1992).abs() < 1e-3, "{start:?}");
    assert!(refused(&dense(1170.0)).contains("64 of 216 particles"), "{}", refused(&dense(1170.0)));
    // Tait: B ((ρ/ρ₀)^7 − 1), B = ρ₀ c² / 7.
    let wanted = 1000.0 * 400.0 / 7.0 * (1.169f64.powi(7) - 1.0);
    assert!((start.pressure() / wanted - 1.0).abs() < 1e-9, "{} {wanted}", start.pressure());
    // Particles with a prescribed motion are walls, whatever they weigh.
    assert_eq!((start.fluid, start.walls), (216, 0));
}

/// A cube of 8³ in a box that it fills, of masses e more than at rest, is everywhere at 1 + e: what fills 512 d³ wants 512 (1 + e) d³ at
/// rest, and leaves by faces of 6 · 64 d², so that the fastest moves 4/3 e spacings: 0.4 of them where e is 0.3.
#[test]
fn starts_whose_projection_moves_particles_too_far_are_refused() {
    let dense = |ratio: f64, flat: bool| {
        let (size, box_size) = if flat { ("0.8, 0.8, 0", "0.8, 0.8, 0") } else { ("0.8, 0.8, 0.8", "0.8, 0.8, 0.8") };
        let density = 1000.0 * ratio;
        setup(&format!(
            "[simulation]\ndt = 1e-3\nsteps = 1\nintegrator = \"symplectic_euler\"\n[box]\nsize = [{box_size}]\nboundary = \"periodic\"\n\
             [[particles]]\nshape = \"block\"\nsize = [{size}]\ndensity = {density}\n\
             [[force]]\nkind = \"fluid\"\nspacing = 0.1\nsolver = \"dfsph\"\n"
        ))
    };
    let start = dense(1.29, false).start().expect("just below").expect("a fluid");
    assert!((start.thrust - 4.0 / 3.0 * 0.29).abs() < 1e-6, "{start:?}");
    let error = refused(&dense(1.31, false));
    for words in
        ["would explode", "of the fluid, the densest", "1.310 times", "0.41 spacings", "density × spacing^3 is"]
    {
        assert!(error.contains(words), "{error}");
    }
    // In the plane 64 e d² and 32 d.
    let start = dense(1.19, true).start().expect("just below").expect("a fluid");
    assert!((start.thrust - 2.0 * 0.19).abs() < 1e-6, "{start:?}");
    assert!(refused(&dense(1.21, true)).contains("0.42 spacings"));
    let start = dense(1.0, false).start().expect("at rest").expect("a fluid");
    assert!(start.thrust.abs() < 1e-6 && start.pressure() == 0.0, "{start:?}");
}

/// What is too dense in one corner of much that is not: the whole has room enough, that part has not.
#[test]
fn a_part_of_a_fluid_may_be_too_dense() {
    let solved = "[simulation]\ndt = 1e-3\nsteps = 1\nintegrator = \"symplectic_euler\"\n";
    let force = "[[force]]\nkind = \"fluid\"\nspacing = 0.1\nsolver = \"dfsph\"\n";
    let pool = block("size = [3.2, 0.8, 0.8]");
    let second = |x: f64| block(&format!("size = [0.8, 0.8, 0.8]\ncenter = [{x:?}, 0.05, 0.05]"));
    let error = refused(&setup(&format!("{solved}{pool}{}{force}", second(1.25))));
    assert!(error.contains("would explode") && error.contains("two blocks overlap"), "{error}");
    let start = setup(&format!("{solved}{pool}{}{force}", second(2.05))).start().expect("beside it").expect("a fluid");
    assert!(start.thrust < 0.1, "{start:?}");
}
