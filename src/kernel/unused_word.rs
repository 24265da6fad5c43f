//! The first word of every uniform block, which is never read.
//!
//! lavapipe of Mesa 22.2 to 23.0 specializes branches that depend on a uniform block on the block's values: it recompiles such a shader at
//! every dispatch, and frees none of the results. It always includes the word at offset 0 of the block. Where no branch depends on that
//! word there is no specialization, and it compiles once.

use std::borrow::Cow;

use super::own::tokens;

/// The name of the word. Reflection leaves it out of a block's members, so that no value is required.
pub const UNUSED_WORD: &str = "unused_word";
/// The text inserted into a user's struct, in the line of its brace.
const MEMBER: &str = " unused_word: u32,";

/// A user's text with the word in front of the members of `params`.
pub fn with_unused_word(text: &str) -> Cow<'_, str> {
    match place(text) {
        Some(at) => Cow::Owned([&text[..at], MEMBER, &text[at..]].concat()),
        None => Cow::Borrowed(text),
    }
}

/// The position in a user's text that corresponds to a position in the compiled text.
pub fn written(text: &str, compiled: usize) -> usize {
    match place(text) {
        Some(at) if compiled > at => compiled.saturating_sub(MEMBER.len()).max(at),
        _ => compiled,
    }
}

/// The position just after the brace of the struct that is the type of `params`. `None` where there is no such struct, where it has the
/// word already, or where values of the struct are constructed member by member.
fn place(text: &str) -> Option<usize> {
    let tokens = tokens(text);
    let find = |wanted: &[&str]| {
        tokens.windows(wanted.len()).position(|w| w.iter().zip(wanted).all(|(token, wanted)| token.text == *wanted))
    };
    let variable = ["var", "<", "uniform", ">", "params", ":"];
    let block = tokens.get(find(&variable)? + variable.len())?.text;
    let brace = find(&["struct", block, "{"])? + 2;
    let first = tokens.get(brace + 1)?.text;
    let complete = first == UNUSED_WORD || first == "}" || find(&[block, "("]).is_some();
    (!complete).then(|| tokens[brace].end())
}

#[cfg(test)]
mod tests {
    use super::{MEMBER, with_unused_word, written};

    const VARIABLE: &str = "var<uniform> params: Params;\n";

    #[test]
    fn the_word_stands_behind_the_brace() {
        for (before, after) in [
            ("struct Params", " n: u32 }\n"),
            ("struct /* a /* { */ b */ Params // {\n", "\n    n: u32,\n}\n"),
            ("/* struct Params { x: f32 } */ struct Params", "x: vec3f}\n"),
        ] {
            let text = format!("{before}{{{after}{VARIABLE}");
            let compiled = with_unused_word(&text);
            assert_eq!(compiled, format!("{before}{{{MEMBER}{after}{VARIABLE}"));
            assert_eq!(compiled.lines().count(), text.lines().count(), "lines keep their numbers");
            let brace = before.len() + 1;
            for (place, _) in text.char_indices() {
                let there = if place <= brace { place } else { place + MEMBER.len() };
                assert_eq!(written(&text, there), place);
            }
            assert!((0..=MEMBER.len()).all(|k| written(&text, brace + k) == brace), "what is put in has one place");
        }
    }

    #[test]
    fn nothing_is_put_where_nothing_belongs() {
        for text in [
            "fn force(me: Particle) -> vec4f { return vec4f(); }".to_owned(),
            "struct Params { n: u32 }".to_owned(),
            format!("struct Params {{ unused_word: u32, n: u32 }}\n{VARIABLE}"),
            format!("struct Params {{ }}\n{VARIABLE}"),
            format!("struct Params {{ n: u32 }}\n{VARIABLE}const P = Params(3u);"),
            format!("struct Other {{ n: u32 }}\n{VARIABLE}/* struct Params {{ n: u32 }}"),
            format!("// {VARIABLE}struct Params {{ n: u32 }}"),
        ] {
            assert_eq!(with_unused_word(&text), text);
        }
    }
}
