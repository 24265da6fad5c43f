//! OBJ: the text that is written, vertices of other programs, and what is wrong with a file.

use glam::DVec3;
use motes::State;
use motes::formats::{self, Options, obj};
use motes::links::Link;

use super::{folder, put, read, refused};

/// Three particles, a spring, and the triangle of all.
fn state() -> State {
    let mut state = State::default();
    for x in [0.0, 0.1, 1e-20] {
        state.push(DVec3::new(x, 1.0, -2.5), DVec3::X, 1.0, 0.0);
    }
    state.links.springs = vec![Link { ends: [0, 2], rest: 1.0, stiffness: 1.0, damping: 0.0, rope: false }];
    state.links.triangles = vec![[2, 0, 1]];
    (state.time, state.step) = (0.1 + 0.2, 40);
    state
}

fn text(state: &State) -> String {
    let mut bytes = Vec::new();
    obj::write_obj(&mut bytes, state, &Options::default()).expect("memory");
    String::from_utf8(bytes).expect("text")
}

#[test]
fn a_mesh_is_the_shortest_text() {
    let version = env!("CARGO_PKG_VERSION");
    let wanted = format!(
        "# motes {version}: 3 vertices, step 40, time 0.30000000000000004\nv 0.0 1.0 -2.5\nv 0.1 1.0 -2.5\n\
         v 1e-20 1.0 -2.5\nl 1 3\nf 3 1 2\n# end\n"
    );
    assert_eq!(text(&state()), wanted);
    let folder = folder();
    let path = put(&folder, "a.obj", &wanted);
    let back = read(&path).expect("a mesh");
    assert_eq!((back.time.to_bits(), back.step, back.len()), (state().time.to_bits(), 40, 3));
    let contents = formats::contents(&path).expect("contents");
    assert_eq!((contents.rows, contents.left_out), (3, vec!["1 line".to_owned(), "1 face".to_owned()]));
}

#[test]
fn what_it_does_not_hold_is_said() {
    let format = formats::format("obj").expect("OBJ");
    let left_out = format.left_out.expect("something");
    let mut state = state();
    assert_eq!(left_out(&state), ["vx", "vy", "vz", "mass"]);
    state.set_ids(vec![0, 1, 5]).expect("ids");
    assert_eq!(left_out(&state).last().map(String::as_str), Some("id"));
}

#[test]
fn vertices_of_other_programs_are_read() {
    let folder = folder();
    // Blender's, with a colour behind a vertex and CRLF.
    let blender = "# Blender 4.5.0\r\nmtllib a.mtl\r\no Cube\r\nv 1.0 1.5 -1 0.5 0.5 0.5\r\nv -1 2 3e0 # here\r\n\
                   vn 0 1 0\r\nvt 0 0\r\ns 0\r\nf 1//1 2//1 1//1\r\n";
    for name in ["a.obj", "a.OBJ"] {
        let state = read(&put(&folder, name, blender)).expect("a mesh");
        assert_eq!(state.position(), [DVec3::new(1.0, 1.5, -1.0), DVec3::new(-1.0, 2.0, 3.0)]);
    }
}

#[test]
fn faults_are_reported_with_their_lines() {
    refused(
        "a.obj",
        "v 1 2\nv 1 2 x\nv nan 0 0\n",
        &["line 1: the vertex has no z", "line 2: z is `x`, which is no finite number", "line 3: x is `nan`"],
    );
    refused("a.obj", "f 1 2 3\n", &["has no vertices"]);
    refused("a.obj", b"v 1 2 3\n\xff", &["byte 8: is no text"]);
    let whole = text(&state());
    let without = whole.replace("v 0.1 1.0 -2.5\n", "");
    refused("a.obj", without, &["line 1: 3 vertices are announced, and 2 are there"]);
    refused("a.obj", whole.replace("# end\n", ""), &["ends without `# end`"]);
    refused("a.obj", whole.replace("step 40", "step -1"), &["line 1: vertices, step and time are announced"]);
}
