//! Loops that end. A mutant may loop for as long as a driver lets it, once for each particle: tens of thousands of turns, on a processor
//! seconds.

use crate::support::joint::{name, without_comments};

/// Turns of all loops of a text in one invocation, at most: several times those of any stage. Where a stage took more, the shader as it is
/// would not agree with its reference among mutants of which none is chosen, and its mutants that change nothing would count as noticed.
const TURNS: u32 = 8192;

/// The text, of which an invocation leaves a loop after [`TURNS`] turns of loops.
pub fn bounded(text: &str) -> String {
    let code = without_comments(text);
    let begins = |at: usize| !code[..at].bytes().next_back().is_some_and(name);
    let mut bodies: Vec<usize> = ["for (", "while ", "loop {"]
        .iter()
        .flat_map(|word| code.match_indices(word))
        .filter(|(at, _)| begins(*at))
        .filter_map(|(at, _)| code[at..].find('{').map(|open| at + open + 1))
        .collect();
    if bodies.is_empty() {
        return text.to_owned();
    }
    bodies.sort_unstable();
    let mut all = String::from("var<private> mutant_turns: u32;\n");
    let mut done = 0;
    for body in bodies {
        all += &text[done..body];
        all += &format!(" mutant_turns += 1u; if mutant_turns > {TURNS}u {{ break; }}");
        done = body;
    }
    all + &text[done..]
}

#[test]
fn loops_end() {
    let text =
        "fn f() { // for (;;) {\n    for (var i = 0u; i < 3u; i += 1u) { while i > 2u { } }\n    loop { break; }\n}\n";
    let bound = format!(" mutant_turns += 1u; if mutant_turns > {TURNS}u {{ break; }}");
    let want = format!(
        "var<private> mutant_turns: u32;\nfn f() {{ // for (;;) {{\n    for (var i = 0u; i < 3u; i += 1u) {{{bound} while i > 2u {{{bound} }} }}\n    \
         loop {{{bound} break; }}\n}}\n"
    );
    assert_eq!(bounded(text), want);
    assert_eq!(bounded("fn platform (x: u32) { }"), "fn platform (x: u32) { }");
}
