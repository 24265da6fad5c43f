//! Walls out of meshes.

use std::fmt::Write as _;

use glam::DVec3;
use motes::scene::{Builtin, Options, Scene, Source};
use motes::settings::Value;
use motes::sph::{Smoothing, gap};

use crate::walls::{load, made, number, word};

/// A cube of sides 2 about the origin, its faces outwards; in the words that OBJ has for corners.
const CUBE: &str = "# a cube\no cube\nv -1 -1 -1\nv 1 -1 -1 1.0\nv 1 1 -1\nv -1 1 -1\nv -1 -1 1\nv 1 -1 1\nv 1 1 1\nv -1 1 1\nvt 0 0\nvn 0 0 1\n\
                    f 1 4 3 2 # below\nf -4 -3 -2 -1\nf 1/1 2/1 6/1 5/1\nf 2//1 3//1 7//1 6//1\nf 3/1/1 4/1/1 8/1/1 7/1/1\nf 4 1 5 8\n";

fn mesh(text: &str, values: &[(&'static str, Value)]) -> Result<Vec<DVec3>, motes::Error> {
    let base = [("surface", word("mesh")), ("mesh", word(text)), ("spacing", number(0.1)), ("scale", number(0.5))];
    Ok(made("wall", &[&base, values].concat())?.position().to_vec())
}

fn least(places: &[DVec3]) -> f64 {
    let of = |(n, x): (usize, &DVec3)| places[n + 1..].iter().map(|y| x.distance(*y)).fold(f64::INFINITY, f64::min);
    places.iter().enumerate().map(of).fold(f64::INFINITY, f64::min)
}

#[test]
fn a_cube_is_sampled_evenly_and_once() {
    let depth = (gap(Smoothing::Cubic, 2.0, 1, 3) - 0.5) * 0.1;
    for (inside, half) in [(false, 0.5 - depth), (true, 0.5 + depth)] {
        let places = mesh(CUBE, &[("inside", Value::Flag(inside))]).expect("a cube");
        // All on the faces of the cube that is as much smaller or larger.
        let off = places.iter().map(|x| (x.abs().max_element() - half).abs()).fold(0.0, f64::max);
        assert!(off < 1e-12, "{off}");
        // No two nearer than they are to be, and no hole: every place of the surface is near to one.
        assert!(least(&places) >= 0.0834 - 1e-12, "{}", least(&places));
        let mut worst = 0.0f64;
        for i in 0..=40 {
            for j in 0..=40 {
                let [u, v] = [i, j].map(|n| (f64::from(n) / 20.0 - 1.0) * half);
                for x in [DVec3::new(u, v, half), DVec3::new(-half, u, v), DVec3::new(u, -half, v)] {
                    worst = worst.max(places.iter().map(|y| y.distance(x)).fold(f64::INFINITY, f64::min));
                }
            }
        }
        assert!(worst < 0.1, "{worst}");
        // About one for each square of a spacing.
        #[expect(clippy::cast_precision_loss, reason = "few")]
        let share = places.len() as f64 / (6.0 * (2.0 * half / 0.1).powi(2));
        assert!((0.85..1.3).contains(&share), "{share}");
        for corner in 0..8 {
            let sign = |bit: i32| if corner >> bit & 1 == 1 { half } else { -half };
            let corner = DVec3::new(sign(0), sign(1), sign(2));
            assert!(places.iter().any(|x| x.distance(corner) < 1e-9), "no sample at {corner}");
        }
    }
}

#[test]
fn a_finer_mesh_of_the_same_gives_as_many() {
    // One square, as two triangles and as 800.
    let coarse = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n".to_owned();
    let mut fine = String::new();
    for j in 0..=20 {
        for i in 0..=20 {
            let _ = writeln!(fine, "v {} {} 0", f64::from(i) / 20.0, f64::from(j) / 20.0);
        }
    }
    for j in 0..20 {
        for i in 0..20 {
            let a = 1 + i + 21 * j;
            let _ = writeln!(fine, "f {} {} {} {}", a, a + 1, a + 22, a + 21);
        }
    }
    let [a, b] = [coarse, fine].map(|text| mesh(&text, &[("scale", number(1.0))]).expect("a square"));
    for places in [&a, &b] {
        assert!(
            least(places) >= 0.0834 - 1e-12 && (95..150).contains(&places.len()),
            "{} {}",
            least(places),
            places.len()
        );
        let behind = (gap(Smoothing::Cubic, 2.0, 1, 3) - 0.5) * 0.1;
        assert!(places.iter().all(|x| (x.z + behind).abs() < 1e-12));
    }
    let layers = mesh("v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n", &[("layers", number(2.0))]).expect("a triangle");
    let mut heights: Vec<f64> = layers.iter().map(|x| x.z).collect();
    heights.dedup_by(|a, b| (*a - *b).abs() < 1e-12);
    assert!(heights.len() == 2 && (heights[0] - heights[1] - 0.1).abs() < 1e-12, "{heights:?}");
}

#[test]
fn faults_of_a_mesh_name_their_lines() {
    for (text, words) in [
        ("v 0 0\n", "line 1: a vertex has three numbers, not 2"),
        ("v 0 0 0\nv 1 x 0\n", "line 2: `x` is no finite number"),
        ("v 0 0 nan\n", "line 1: `nan` is no finite number"),
        ("v 0 0 0\n\nf 1 1 2\n", "line 3: there is no vertex 2: 1 come before this face"),
        ("v 0 0 0\nf 0 1 1\n", "line 2: there is no vertex 0"),
        ("v 0 0 0\nf -2 1 1\n", "line 2: there is no vertex -2"),
        ("v 0 0 0\nf 1 1\n", "line 2: a face has three corners or more, not 2"),
        ("v 0 0 0\nf a 1 1\n", "line 2: `a` is no corner"),
        ("v 0 0 0\n", "it has no faces"),
        ("v 0 0 0\nf 1 1 1\n", "no area"),
        ("v 0 0 0\nv 9e9 0 0\nv 0 9e9 0\nf 1 2 3\n", "the maximum is 100000000"),
    ] {
        let error = mesh(text, &[]).expect_err(words).to_string();
        assert!(error.contains(words) && error.contains("wall"), "`{error}` does not say `{words}`");
    }
}

#[test]
fn slivers_cost_what_they_have() {
    // 1000 long, and a millionth high: two edges' worth of samples, in no time.
    let sliver = "v 0 0 0\nv 1000 0 0\nv 0 1e-6 0\nf 1 2 3\n";
    let start = std::time::Instant::now();
    let places = mesh(sliver, &[("scale", number(1.0)), ("spacing", number(0.2))]).expect("a sliver");
    assert!((5000..6100).contains(&places.len()), "{}", places.len());
    assert!(start.elapsed().as_secs() < 10, "{:?}", start.elapsed());
    let error = mesh(sliver, &[("scale", number(1.0)), ("spacing", number(1e-5))]).expect_err("too fine").to_string();
    assert!(error.contains("would be sampled at 8.8e8 points, and the maximum is 2e8"), "{error}");
}

const SCENE: &str = "[simulation]\ndt = 1\nsteps = 1\n[[particles]]\nshape = \"wall\"\nsurface = \"mesh\"\nmesh = \"NAME\"\nspacing = 0.25\n";
static EMBEDDED: Builtin = Builtin {
    name: "pyramid",
    text: "[simulation]\ndt = 1\nsteps = 1\n[[particles]]\nshape = \"wall\"\nsurface = \"mesh\"\nmesh = \"pyramid.obj\"\nspacing = 0.25\n",
    files: &[("pyramid.obj", include_str!("pyramid.obj"))],
};

#[test]
fn scenes_name_meshes() {
    let scene = load(&SCENE.replace("NAME", "pyramid.obj")).unwrap_or_else(|faults| panic!("{faults}"));
    let text = include_str!("pyramid.obj");
    let wanted = mesh(text, &[("scale", number(1.0)), ("spacing", number(0.25))]).expect("a pyramid");
    assert_eq!(scene.particles.position(), wanted);
    assert_eq!(scene.particles.held.len(), wanted.len());
    // Written back it names the file, and not what is in it.
    assert!(scene.resolved.contains("pyramid.obj\"") && !scene.resolved.contains("f 1 2"), "{}", scene.resolved);
    let again = Source::Text { name: "b.toml".to_owned(), text: scene.resolved, folder: "/".into() };
    let outside = Options { allow_outside: true, ..Options::default() };
    let again = Scene::load(&again, &[], &outside).unwrap_or_else(|faults| panic!("{faults}"));
    assert_eq!(again.particles, scene.particles);
    let carried = Scene::load(&Source::Builtin(&EMBEDDED), &[], &Options::default());
    assert_eq!(carried.unwrap_or_else(|faults| panic!("{faults}")).particles.position(), wanted);
    let faults = load(&SCENE.replace("NAME", "piramid.obj")).err().expect("no such file");
    assert!(faults.to_string().contains("did you mean \"pyramid.obj\"?") && faults.exit_code() == 4, "{faults}");
    let faults = load(&SCENE.replace("NAME", "../mutants/main.rs")).err().expect("another folder");
    assert!(faults.to_string().contains("leads outside of the scene's folder"), "{faults}");
    let folder = tempfile::tempdir().expect("a folder");
    std::fs::write(folder.path().join("empty.obj"), "\n").expect("a file");
    let text = SCENE.replace("NAME", "empty.obj");
    let empty = Source::Text { name: "a.toml".to_owned(), text, folder: folder.path().to_path_buf() };
    let faults = Scene::load(&empty, &[], &Options::default()).err().expect("nothing in it");
    assert!(faults.to_string().contains("empty.obj is empty: it has no faces"), "{faults}");
    let faults = load(&SCENE.replace("NAME", "dam_break_front.csv")).err().expect("no mesh");
    assert!(faults.to_string().contains("mesh: it has no faces"), "{faults}");
}
