//! The functions that a visit calls: their arguments and their return types.

use naga::Span;

use super::tokens::{Token, tokens};
use crate::kernel::{Source, message};

/// The fault of a function of a file, if there is one of that name whose arguments and return type differ from those of `signature`, as
/// `fn name(a: A) -> B`. Names of arguments are free.
pub fn mismatch(source: &Source, signature: &str) -> Option<String> {
    let wanted = tokens(signature);
    let name = wanted.get(1)?;
    let all = tokens(&source.text);
    let at = all.windows(2).position(|pair| pair[0].text == "fn" && pair[1].text == name.text)?;
    let head: Vec<_> = all[at..].iter().take_while(|token| token.text != "{").copied().collect();
    if types(&head, &all) == types(&wanted, &[]) {
        return None;
    }
    let found = head.get(1)?;
    let bytes = |at: usize| u32::try_from(at).unwrap_or(u32::MAX);
    let span = Span::new(bytes(found.at), bytes(found.end()));
    let message = format!("motes calls `{signature}`, and this function has other arguments or another return type");
    // The text as written, without later insertions.
    let plain_text = Source { ours: true, ..source.clone() };
    Some(message::with_place(&message, &[plain_text], span, "here"))
}

/// The types of the arguments, and last the return type; vectors by their short names, and aliases resolved.
fn types(head: &[Token], file: &[Token]) -> Vec<String> {
    let (mut types, mut one, mut depth) = (Vec::new(), Vec::new(), 0_usize);
    // A type begins after a colon or the arrow, and ends at a comma or the last bracket.
    let mut inside = false;
    for (before, token) in std::iter::once("").chain(head.iter().map(|token| token.text)).zip(head) {
        let arrow = before == "-" && token.text == ">";
        match token.text {
            "<" => depth += 1,
            ">" if !arrow => depth = depth.saturating_sub(1),
            _ => {}
        }
        if token.text == ":" || arrow {
            inside = true;
        } else if depth == 0 && (token.text == "," || token.text == ")") {
            types.extend(inside.then(|| plain(&std::mem::take(&mut one), file)));
            inside = false;
        } else if inside {
            one.push(token.text);
        }
    }
    types.push(plain(&one, file));
    types
}

fn plain(words: &[&str], file: &[Token]) -> String {
    let mut words: Vec<&str> = words.to_vec();
    for _ in 0..8 {
        let meaning = |word: &str| {
            let at = file.windows(3).position(|w| w[0].text == "alias" && w[1].text == word && w[2].text == "=")?;
            Some(file[at + 3..].iter().map(|token| token.text).take_while(|word| *word != ";").collect::<Vec<_>>())
        };
        words = words.iter().flat_map(|word| meaning(word).unwrap_or_else(|| vec![word])).collect();
    }
    let mut text = words.concat().replace(",>", ">");
    for size in 2..=4 {
        for (scalar, letter) in [("f32", "f"), ("u32", "u"), ("i32", "i")] {
            text = text.replace(&format!("vec{size}<{scalar}>"), &format!("vec{size}{letter}"));
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    const WANTED: &str = "fn gather(me: Particle, r: vec3f, sum: ptr<function, Sum>) -> vec4f";

    fn wrong(head: &str) -> Option<String> {
        let text = format!("alias V = vec3<f32>; alias P = Particle;\n// fn gather(\n{head} {{ return vec4f(); }}");
        mismatch(&Source::law("l.wgsl".into(), text), WANTED)
    }

    #[test]
    fn the_same_types_by_other_names_are_the_same() {
        for head in [
            WANTED,
            "fn gather(a: Particle, b: vec3<f32>, c: ptr<function,Sum,>,) -> vec4 < f32 >",
            "fn gather(me: P, /* r: */ r: V, sum: ptr<function, Sum>)->vec4f",
            "fn other(me: P) -> f32",
        ] {
            assert_eq!(wrong(head), None, "{head}");
        }
    }

    #[test]
    fn other_types_are_shown_where_they_stand() {
        for head in [
            "fn gather(me: vec3f, r: vec3f, sum: ptr<function, Sum>) -> vec4f",
            "fn gather(me: Particle, r: vec3f) -> vec4f",
            "fn gather(me: Particle, r: vec3f, sum: ptr<function, Sum>, more: f32) -> vec4f",
            "fn gather(me: Particle, r: vec3f, sum: ptr<function, Sum>) -> vec3f",
            "fn gather(me: Particle, r: vec3f, sum: ptr<function, Sum>)",
            "fn gather()",
        ] {
            let text = wrong(head).unwrap_or_else(|| panic!("{head}"));
            assert!(text.contains("l.wgsl:3:4") && text.contains(WANTED) && text.contains("^^^^^^ here"), "{text}");
        }
    }
}
