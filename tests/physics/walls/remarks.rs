//! What `motes check` tells of a fluid, and that `run` refuses what it refuses.

use std::process::Command;

fn motes(arguments: &[&str]) -> (i32, String, String) {
    let out = Command::new(env!("CARGO_BIN_EXE_motes")).args(arguments).output().expect("motes");
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    (out.status.code().unwrap_or(-1), text(&out.stdout), text(&out.stderr))
}

#[test]
fn check_tells_of_a_fluid() {
    let few = ["--backend", "cpu", "--set", "force.1.spacing=0.2", "--set", "simulation.dt=0.001"];
    let (code, out, _) = motes(&[&["check", "dam_break_2d"][..], &few].concat());
    assert_eq!(code, 0, "{out}");
    for words in [
        "density 1000.0, on a square lattice of 0.2; a particle has mass 4.0000e1 and support 4.0000e-1",
        "50 of the fluid, 52 of walls",
        "62.6, 10.0 times the fastest flow expected: √(2 g H) = 6.2642 with g = 9.8100, H = 2.0000",
        "the maximum density is 1.0035 of rest (particle 0), a pressure of 0.709 ρ g H",
        "the minimum density is 0.7",
    ] {
        let plain = out.replace("density 1000,", "density 1000.0,");
        assert!(plain.contains(words), "no `{words}` in\n{out}");
    }
    let slow = ["--set", "force.1.sound_speed=20"];
    let (_, out, _) = motes(&[&["check", "dam_break_2d"][..], &few, &slow].concat());
    assert!(out.contains("note: the speed of sound is 3.2 times the fastest flow expected"), "{out}");
    assert!(out.contains("sound_speed = 62.6418 makes that 1 %"), "{out}");
    let light = ["--set", "particles.0.density=800"];
    let (_, out, _) = motes(&[&["check", "dam_break_2d"][..], &few, &light].concat());
    assert!(out.contains("under gravity it will collapse"), "{out}");
    assert!(
        out.contains("masses from 3.2000e1 to 3.2000e1, and density × spacing^2 of the force is 4.0000e1"),
        "{out}"
    );
    let heavy = ["--set", "particles.0.density=1120"];
    let (_, out, _) = motes(&[&["check", "dam_break_2d"][..], &few, &heavy].concat());
    assert!(out.contains("faster than the flow for which the speed of sound is chosen"), "{out}");
}

const SOLVED: [&str; 4] = ["--set", "force.1.solver=\"dfsph\"", "--set", "simulation.integrator=\"symplectic_euler\""];

#[test]
fn check_tells_of_a_fluid_that_is_solved_for() {
    // 0.4 of 0.2 in 0.001, and in 0.02.
    for (dt, bears, remarked) in [("0.001", "80.0000", false), ("0.02", "4.0000", true)] {
        let few = ["--backend", "cpu", "--set", "force.1.spacing=0.2", "--set", &format!("simulation.dt={dt}")];
        let (code, out, err) = motes(&[&["check", "dam_break_2d"][..], &few, &SOLVED].concat());
        assert_eq!(code, 0, "{out}{err}");
        for words in [
            &format!("the fastest flow expected 6.2642, and dt is stable up to {bears}: √(2 g H)"),
            "the maximum density is 1.0035 of rest (particle 0), and the fastest moves 0.001 spacings in the first step, at least",
        ] {
            assert!(out.contains(words), "no `{words}` in\n{out}");
        }
        // 0.4 of 0.2 at √(2 · 9.81 · 2).
        assert!(out.contains("choose 1.277e-2") == remarked && !out.contains("speed of sound is"), "{out}");
    }
}

#[test]
fn check_and_run_refuse_what_would_explode() {
    let folder = tempfile::tempdir().expect("a folder");
    let output = folder.path().join("out").display().to_string();
    let bad = ["--backend", "cpu", "--set", "force.1.spacing=0.2", "--set", "particles.0.density=2000"];
    let runs: [Vec<&str>; 2] = [vec!["check", "dam_break_2d"], vec!["run", "dam_break_2d", "-o", &output]];
    for arguments in runs {
        let (code, _, err) = motes(&[&arguments[..], &bad].concat());
        assert_eq!(code, 3, "{err}");
        assert!(err.contains("this start would explode") && err.contains("its mass is 8.000000e1"), "{err}");
        let (code, _, err) = motes(&[&arguments[..], &bad, &SOLVED].concat());
        assert_eq!(code, 3, "{err}");
        assert!(err.contains("this start would explode") && err.contains("would have to move at least"), "{err}");
    }
    assert!(!folder.path().join("out").exists(), "refused before anything is written");
}

/// A fluid keeps what its pressure keeps; one with friction, or without an energy of its surface, is not said to.
#[test]
fn what_a_fluid_keeps_is_claimed_and_nothing_else() {
    let folder = tempfile::tempdir().expect("a folder");
    let (scene, out) =
        (folder.path().join("drop.toml").display().to_string(), folder.path().join("out").display().to_string());
    let run = |set: &[&str]| {
        let mut args = vec!["run", &scene, "-o", &out, "--overwrite", "--backend", "cpu"];
        args.extend(["--set", "output.formats=[\"csv\"]"]);
        args.extend(set.iter().flat_map(|value| ["--set", *value]));
        let (code, stdout, stderr) = motes(&args);
        assert_eq!(code, 0, "{set:?}: {stderr}");
        stdout
    };
    let drop = "[simulation]\ndt = 0.001\nsteps = 2\nintegrator = \"leapfrog\"\n[box]\nsize = [4, 4, 0]\nboundary = \"open\"\n\
                [[particles]]\nshape = \"drop\"\nsize = [0.5, 0.5, 0]\ncenter = [2, 2, 0]\nvelocity = [1, 0, 0]\n\
                [[force]]\nkind = \"fluid\"\nspacing = 0.1\nsound_speed = 9\n";
    std::fs::write(&scene, drop).expect("written");
    let ideal = run(&[]);
    assert!(ideal.contains(", error ") && ideal.contains("angular momentum by"), "{ideal}");
    let by_rate = run(&["force.0.density_by=continuity"]);
    assert!(by_rate.contains(", error ") && by_rate.contains("angular momentum by"), "{by_rate}");
    for (value, why, turns) in [
        ("alpha=0.1", "not conserved (viscosity), change", ""),
        ("viscosity=0.1", "not conserved (viscosity), change", ""),
        ("viscosity=0.1 viscosity_form=\"morris\"", "not conserved (viscosity), change", "viscosity_form = \"morris\""),
        ("xsph=0.1", "not conserved (XSPH), change", "XSPH"),
        ("tension=1", "not conserved (surface tension, which is not counted), change", "surface tension"),
    ] {
        let set: Vec<String> = value.split(' ').map(|one| format!("force.0.{one}")).collect();
        let rubs = run(&set.iter().map(String::as_str).collect::<Vec<_>>());
        let named = format!("angular momentum not conserved ({turns}), change ");
        assert!(rubs.contains(why) && rubs.contains("angular momentum by") == turns.is_empty(), "{value}: {rubs}");
        assert!(turns.is_empty() || rubs.contains(&named), "{value}: {rubs}");
        assert!(rubs.contains("momentum changed by"), "{rubs}");
    }
    let walled = format!("{drop}[[particles]]\nshape = \"tank\"\nsize = [4, 4, 0]\ncenter = [2, 2, 0]\n");
    std::fs::write(&scene, walled).expect("written");
    let walled = run(&["force.0.alpha=0.1"]);
    assert!(walled.contains("(viscosity; walls), change") && walled.contains("energy without walls"), "{walled}");
}
