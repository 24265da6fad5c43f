//! What is not TOML, and what a terminal should not see. Each text is what a user reads, whole.

use crate::scenes::assert_report;

#[test]
fn no_quotes() {
    assert_report(
        "[simulation]\ndt = 0.1\nsteps = 10\nintegrator = rk4\n[[particles]]\nbodies = [{ position = [0, 0, 0] }]\n",
        &[],
        r#"error: text must be in quotes: "rk4"
  --> a.toml:4:14
   |
 4 | integrator = rk4
   |              ^^^

a.toml: 1 error"#,
    );
}

#[test]
fn no_value() {
    assert_report(
        "[simulation]\ndt =\nsteps = 10\n[[particles]]\nbodies = [{ position = [0, 0, 0] }]\n",
        &[],
        "error: the value is missing
  --> a.toml:2:5
   |
 2 | dt =
   |     ^

a.toml: 1 error",
    );
}

#[test]
fn no_equals() {
    assert_report(
        "[simulation]\ndt 0.1\nsteps = 10\n[[particles]]\nbodies = [{ position = [0, 0, 0] }]\n",
        &[],
        "error: this is not TOML: key with no value, expected `=`
  --> a.toml:2:4
   |
 2 | dt 0.1
   |    ^

a.toml: 1 error",
    );
}

#[test]
fn decimal_comma() {
    assert_report(
        "[simulation]\ndt = 0,1\nsteps = 10\n[[particles]]\nbodies = [{ position = [0, 0, 0] }]\n",
        &[],
        "error: a number has a point, not a comma
  --> a.toml:2:7
   |
 2 | dt = 0,1
   |       ^ write a point

a.toml: 1 error",
    );
}

#[test]
fn open_list() {
    assert_report(
        "[simulation]\ndt = 0.1\nsteps = 10\n[[particles]]\nbodies = [{ position = [0, 0, 0] }\n",
        &[],
        "error: this is not TOML: unclosed array, expected `]`
  --> a.toml:5:35
   |
 5 | bodies = [{ position = [0, 0, 0] }
   |                                   ^

a.toml: 1 error",
    );
}

#[test]
fn duplicate_key() {
    assert_report(
        "[simulation]\ndt = 0.1\nsteps = 10\ndt = 0.2\n[[particles]]\nbodies = [{ position = [0, 0, 0] }]\n",
        &[],
        "error: `dt` is given twice
  --> a.toml:4:1
   |
 4 | dt = 0.2
   | ^^ remove one of them

a.toml: 1 error",
    );
}

#[test]
fn duplicate_section() {
    assert_report(
        "[simulation]\ndt = 0.1\nsteps = 10\n[[particles]]\nbodies = [{ position = [0, 0, 0] }]\n[simulation]\ndt = 0.2\n",
        &[],
        "error: `simulation` is given twice
  --> a.toml:6:2
   |
 6 | [simulation]
   |  ^^^^^^^^^^ remove one of them

error: `dt` is given twice
  --> a.toml:7:1
   |
 7 | dt = 0.2
   | ^^ remove one of them

a.toml: 2 errors",
    );
}

#[test]
fn open_quote() {
    assert_report(
        "[simulation]\ndt = 0.1\nsteps = 10\nintegrator = \"rk4\n[[particles]]\nbodies = [{ position = [0, 0, 0] }]\n",
        &[],
        r#"error: this text has no closing quote
  --> a.toml:4:18
   |
 4 | integrator = "rk4
   |                  ^

a.toml: 1 error"#,
    );
}

#[test]
fn two_slips_and_an_unknown_key() {
    assert_report(
        "[simulation]\ndt = \nsteps = 10\n[[particles]]\nbodies = [{ position = [0, 0, 0] }]\ncolour = \"red\"\n[output]\nevery == 3\n",
        &[],
        r#"error: the value is missing
  --> a.toml:2:6
   |
 2 | dt = 
   |      ^

error: unknown key `colour` in [[particles]] bodies
  --> a.toml:6:1
   |
 6 | colour = "red"
   | ^^^^^^ did you mean `color`?
   = known here: `bodies`, `color`, `species`, `fixed`, `motion`, `copies`, `room`, `arrangement`, `separation`, `temperature`, `seed`, `center`, `velocity`, `velocity_factor`

error: this is not TOML: extra `=`, expected nothing
  --> a.toml:8:8
   |
 8 | every == 3
   |        ^

a.toml: 3 errors"#,
    );
}

#[test]
fn deep_nesting() {
    assert_report(
        "[simulation]\ndt = 0.1\nsteps = 10\n[[particles]]\nbodies = [{ position = [0, 0, 0] }]\n[output]\nformats = [[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]\n",
        &[],
        "error: this is nested too deeply
  --> a.toml:7:91
   |
 7 | …[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]…
   |                                                    ^ no scene needs more than 6 levels

a.toml: 1 error",
    );
}

#[test]
fn many_dots() {
    let faulty = format!("{}[output]\na{} = 1\n", crate::scenes::SMALL, ".a".repeat(20));
    assert_report(
        &faulty,
        &[],
        "error: this is nested too deeply
  --> a.toml:7:31
   |
 7 | a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a = 1
   |                               ^ no scene needs more than 6 levels

a.toml: 1 error",
    );
    // The parser's own limit is reported in the same words.
    let worse = crate::scenes::report(&faulty.replace("a = 1", &format!("a{} = 1", ".a".repeat(100))), &[]).to_string();
    assert_eq!(worse, "error: this is nested too deeply\n  --> a.toml\n\na.toml: 1 error");
}

#[test]
fn tabs_wide_letters_and_escapes() {
    assert_report(
        "[simulation]\ndt = 0.1\nsteps = 10\n[[particles]]\nbodies = [{ position = [0, 0, 0] }]\n\tcolor = \"日本\"\n[[force]]\nkind = \"\\u001b[31mred\"\n",
        &[],
        r##"error: `color` must be a colour such as "#ffcc88" or "gold", not "日本"
  --> a.toml:6:10
   |
 6 |     color = "日本"
   |             ^^^^^^

error: unknown force "�[31mred"
  --> a.toml:8:8
   |
 8 | kind = "\u001b[31mred"
   |        ^^^^^^^^^^^^^^^
   = known: {forces}

a.toml: 2 errors"##,
    );
}
