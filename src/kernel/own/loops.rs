//! Loops in a user's law. Some drivers end the loops of an invocation after 65 535 iterations, and none ends an infinite loop: a law with
//! loops is joined with shaders/own/turns.wgsl, which detects the first and ends the second.

use super::tokens::{Token, tokens};
use crate::kernel::Source;

/// The maximum number of iterations of a loop that is not counted: its text gives its number of iterations.
const SHORT: u32 = 64;

/// A loop of a text.
struct Loop {
    /// The start of its body, after the brace \[bytes\].
    body: usize,
    /// The return type of the function around it, as written; empty if it returns nothing.
    returns: String,
    /// Its number of iterations, if its text gives it and its body has no loops or calls of its own.
    turns: Option<u32>,
}

/// Whether a text has loops. `for`, `while` and `loop` are reserved words.
pub fn has_loops(text: &str) -> bool {
    tokens(text).iter().any(|token| is_loop(token.text))
}

fn is_loop(word: &str) -> bool {
    ["for", "while", "loop"].contains(&word)
}

/// Sources with counters in users' loops.
pub fn watched_sources(sources: &[Source]) -> Vec<Source> {
    let watch = |source: &Source| match watched(&source.text) {
        Some(text) if source.law => Source { text: text.into(), ..source.clone() },
        _ => source.clone(),
    };
    sources.iter().map(watch).collect()
}

/// The text with a check of the iteration counter at the start of each loop of unknown length; line numbers are unchanged. `None` where the
/// text gives the length of every loop, or has none.
fn watched(text: &str) -> Option<String> {
    let loops: Vec<Loop> = loops(text).into_iter().filter(|one| one.turns.is_none()).collect();
    if loops.is_empty() {
        return None;
    }
    let (mut out, mut from) = (String::new(), 0);
    for one in loops {
        out.push_str(text.get(from..one.body)?);
        let value = if one.returns.is_empty() { String::new() } else { format!(" {}()", one.returns) };
        out.push_str(&format!(" if own_loop_ends() {{ return{value}; }} "));
        from = one.body;
    }
    out.push_str(text.get(from..)?);
    Some(out)
}

fn loops(text: &str) -> Vec<Loop> {
    let tokens = tokens(text);
    let functions: Vec<&str> = tokens.windows(2).filter(|pair| pair[0].text == "fn").map(|pair| pair[1].text).collect();
    let (mut all, mut returns) = (Vec::new(), String::new());
    for (at, token) in tokens.iter().enumerate() {
        let rest = &tokens[at..];
        let Some(brace) = rest.iter().position(|token| token.text == "{") else { break };
        if token.text == "fn" {
            returns = returned(text, &rest[..=brace]);
        }
        if is_loop(token.text) {
            let body = &rest[brace..];
            let body = &body[..matching(body)];
            all.push(Loop {
                body: rest[brace].end(),
                returns: returns.clone(),
                turns: counted(&rest[..brace], body, &functions),
            });
        }
    }
    all
}

/// The text between the arrow and the brace of a function's head.
fn returned(text: &str, head: &[Token]) -> String {
    let arrow = head.windows(2).position(|pair| pair[0].text == "-" && pair[1].text == ">");
    let ends = arrow.and_then(|arrow| Some((head.get(arrow + 1)?.end(), head.last()?.at)));
    ends.and_then(|(from, to)| text.get(from..to)).unwrap_or_default().trim().to_owned()
}

/// The number of words up to the brace that closes the first.
fn matching(tokens: &[Token]) -> usize {
    let mut depth = 0_usize;
    for (at, token) in tokens.iter().enumerate() {
        match token.text {
            "{" => depth += 1,
            "}" if depth <= 1 => return at,
            "}" => depth -= 1,
            _ => {}
        }
    }
    tokens.len()
}

/// The number of iterations of `for (var i = 0u; i < 8u; i++)` and similar loops, if the body does not change i, has no loop and calls no
/// function of the file.
fn counted(head: &[Token], body: &[Token], functions: &[&str]) -> Option<u32> {
    let words: Vec<&str> = head.iter().map(|token| token.text).collect();
    let ["for", "(", "var", name, rest @ ..] = words.as_slice() else { return None };
    let rest = match rest {
        [":", "u32" | "i32", rest @ ..] | rest => rest,
    };
    let ["=", first, ";", left, rest @ ..] = rest else { return None };
    let (more, rest) = match rest {
        ["<", "=", bound, ";", rest @ ..] => (number(bound)?.checked_add(1)?, rest),
        ["<", bound, ";", rest @ ..] => (number(bound)?, rest),
        _ => return None,
    };
    let ([stepped, "+", "+", ")"] | [stepped, "+", "=", "1" | "1u" | "1i", ")"]) = rest else { return None };
    let turns = more.saturating_sub(number(first)?);
    let same = left == name && stepped == name;
    let changed = (0..body.len()).filter(|at| body[*at].text == *name).any(|at| changes(body, at));
    let plain = !body.iter().any(|token| is_loop(token.text) || functions.contains(&token.text));
    (same && !changed && plain && turns <= SHORT).then_some(turns)
}

/// Whether the name at a position is assigned to, or passed to something that may.
fn changes(body: &[Token], at: usize) -> bool {
    let before: Vec<&str> = body[..at].iter().rev().map(|token| token.text).take(2).collect();
    let lent = before.first() == Some(&"&") && before.last() != before.first() || before == ["&"];
    // There may be brackets around the target of an assignment.
    let after: Vec<&str> =
        body[at + 1..].iter().map(|token| token.text).skip_while(|word| *word == ")").take(3).collect();
    let written = match after.as_slice() {
        ["=", second, ..] => *second != "=",
        ["+", "+", ..] | ["-", "-", ..] | ["<", "<", "="] | [">", ">", "="] => true,
        [mark, "=", ..] => "+-*/%&|^".contains(mark),
        _ => false,
    };
    lent || written
}

/// An integer in WGSL notation.
fn number(word: &str) -> Option<u32> {
    word.strip_suffix(['u', 'i']).unwrap_or(word).parse().ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn body(text: &str) -> String {
        format!("fn f(n: u32) -> vec4f {{ var x = 0u; {text} return vec4f(f32(x)); }} fn g() {{}}")
    }

    #[test]
    fn a_loop_that_says_its_turns_is_left_as_it_is() {
        let loops = [
            "for (var i = 0u; i < 8u; i++) { x += i; }",
            "for (var i: i32 = 2; i <= 65; i += 1) { if i == 3 { x += 1u; } }",
            "for (var i = 0; i < 64; i++) { if i >= 3 && i <= 5 && i << 1 == 4 { continue; } x = x * 2u + u32(i); /* i = 0 */ }",
        ];
        for text in loops {
            assert!(has_loops(text));
            assert_eq!(watched(&body(text)), None, "{text}");
        }
        assert!(!has_loops(&body("let forest = 1; // for")));
        assert_eq!(watched(&body("")), None);
    }

    #[test]
    fn any_other_looks_at_the_turns() {
        let loops = [
            "loop { }",
            "while x < 5u { x += 1u; }",
            "for (;;) { }",
            "for (var i = 0u; i < n; i++) { }",
            "for (var i = 0u; i < 65u; i++) { }",
            "for (var i = 8u; i < 9u; i--) { }",
            "for (var i = 0u; i < 9u; i += 0u) { }",
            "for (var i = 0u; x < 9u; i++) { }",
            "for (var i = 0u; i < 9u; x++) { }",
            "for (var i = 0u; i < 9u; i++) { i = 0u; }",
            "for (var i = 0u; i < 9u; i++) { i -= 1u; }",
            "for (var i = 0u; i < 9u; i++) { i--; }",
            "for (var i = 0u; i < 9u; i++) { (i) = 0u; }",
            "for (var i = 0u; i < 9u; i++) { i >>= 1u; }",
            "for (var i = 0u; i < 9u; i++) { h(&i); }",
            "for (var i = 0u; i < 9u; i++) { g(); }",
        ];
        for text in loops {
            let out = watched(&body(text)).unwrap_or_else(|| panic!("{text} is not watched"));
            assert_eq!(out.matches("{ if own_loop_ends() { return vec4f(); }").count(), 1, "{out}");
            assert_eq!(out.replace(" if own_loop_ends() { return vec4f(); } ", ""), body(text));
        }
        let nested = "for (var i = 0u; i < 9u; i++) { for (var k = 0u; k < 9u; k++) { } }";
        assert_eq!(watched(&body(nested)).expect("the outer").matches("own_loop_ends").count(), 1);
        let mute = watched("fn f() { loop /* { */ { } }").expect("one");
        assert_eq!(mute, "fn f() { loop /* { */ { if own_loop_ends() { return; }  } }");
        let list = watched("fn f() -> array<vec4<f32>, 3> { loop { } }").expect("one");
        assert!(list.contains("return array<vec4<f32>, 3>();"), "{list}");
    }
}
