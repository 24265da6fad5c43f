//! The nesting depth of a user's shader. naga and drivers parse it by recursion, and a stack overflow ends the process: a shader that is
//! nested too deeply is refused before either of them reads it.

use naga::Span;

use super::tokens::{Token, tokens};
use crate::error::Error;
use crate::kernel::Source;
use crate::kernel::message::with_place;

/// The maximum nesting of words and operators of an expression, without numbers: 4000 overflow a stack of 2 MiB.
const LINKS: usize = 1000;
/// The maximum nesting of `else` branches: 2000 overflow it.
const BRANCHES: usize = 200;
/// The maximum number of declarations, each of which may refer to the next: 8000 overflow it, and 2000 functions take minutes to compile.
const DECLARATIONS: usize = 1000;

const DECLARING: [&str; 7] = ["fn", "const", "alias", "struct", "var", "override", "const_assert"];

/// The depth of the text between two brackets: since the last comma, and at most.
#[derive(Clone, Copy, Default)]
struct Bracket {
    since: usize,
    most: usize,
}

/// The open brackets and blocks at a position of a text.
#[derive(Default)]
struct Depth {
    outside: Bracket,
    brackets: Vec<Bracket>,
    /// For each open block, the nesting of branches in it.
    blocks: Vec<usize>,
    branches: usize,
    declarations: usize,
    behind_block: bool,
}

impl Depth {
    /// Reads a word; returns what is nested too deeply after it.
    fn read(&mut self, text: &str) -> Option<String> {
        let behind_block = std::mem::replace(&mut self.behind_block, text == "}");
        if behind_block && text != "else" {
            let done = self.blocks.last_mut().map_or(0, std::mem::take);
            self.branches -= done;
        }
        match text {
            "(" | "[" => self.brackets.push(Bracket::default()),
            ")" | "]" => {
                let inner = self.brackets.pop().unwrap_or_default();
                self.bracket().since += 1 + inner.most.max(inner.since);
            }
            "," => {
                let bracket = self.bracket();
                *bracket = Bracket { since: 0, most: bracket.most.max(bracket.since) };
            }
            "{" | "}" | ";" => {
                self.brackets.clear();
                self.outside = Bracket::default();
                if text == "{" {
                    self.blocks.push(0);
                } else if text == "}" {
                    self.branches -= self.blocks.pop().unwrap_or(0);
                }
            }
            "else" => {
                if let Some(block) = self.blocks.last_mut() {
                    *block += 1;
                    self.branches += 1;
                }
            }
            // A number adds no depth; the operator before it does.
            _ if text.starts_with(|c: char| c == '.' || c.is_ascii_digit()) => {}
            _ => self.bracket().since += 1,
        }
        if self.blocks.is_empty() && DECLARING.contains(&text) {
            self.declarations += 1;
        }
        let way_out = "compilers go down into it by recursion, and end the process where it is too deep";
        if self.bracket().since > LINKS {
            return Some(format!(
                "an expression is nested more than {LINKS} tokens deep; {way_out}: give parts of it names with `let`"
            ));
        }
        if self.branches > BRANCHES {
            return Some(format!(
                "more than {BRANCHES} branches `else` stand in each other; {way_out}: use `switch`, or a function that returns"
            ));
        }
        (self.declarations > DECLARATIONS).then(|| {
            format!("there are more than {DECLARATIONS} functions, constants and types; each may need the next, {way_out}: use fewer")
        })
    }
    fn bracket(&mut self) -> &mut Bracket {
        self.brackets.last_mut().unwrap_or(&mut self.outside)
    }
}

/// Refuses a law that is nested too deeply to be parsed.
pub fn check(sources: &[Source]) -> Result<(), Error> {
    for source in sources.iter().filter(|source| source.law) {
        let mut depth = Depth::default();
        for Token { text, at } in tokens(&source.text) {
            if let Some(message) = depth.read(text) {
                let place = |at: usize| u32::try_from(at).unwrap_or(u32::MAX);
                let span = Span::new(place(at), place(at + text.len()));
                let message = with_place(&message, std::slice::from_ref(source), span, "here");
                return Err(Error::Shader { message });
            }
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn is_refused(text: &str) -> bool {
        check(&[Source::law("l.wgsl".into(), text.into())]).is_err()
    }

    #[test]
    fn what_stands_in_each_other_counts_and_what_follows_does_not() {
        let f = |inside: String| format!("fn f() {{ {inside} }}");
        let chain = |n: usize| format!("x{}", " + y".repeat(n));
        assert!(!is_refused(&f(format!("let a = {};", chain(480)).repeat(20))));
        assert!(is_refused(&f(format!("let a = {};", chain(500)))));
        // Brackets add up where one follows directly on another.
        let mut nested = "x".to_owned();
        for _ in 0..60 {
            nested = format!("({nested} + y * y + y * y)");
        }
        assert!(!is_refused(&f(format!("let a = {nested};"))));
        assert!(is_refused(&f(format!("let a = ({nested}) + ({nested}) + {};", chain(200)))));
        // Lists, numbers and matrices of them are flat.
        let list = vec!["vec4f(1.5, -2.0, 3e-5, 4)"; 3000].join(", ");
        assert!(!is_refused(&format!("const a = array({list});")));
        let elses = |n: usize| f(format!("if a {{ }}{}", " else if b { c(); }".repeat(n)));
        assert!(!is_refused(&elses(200)) && is_refused(&elses(201)));
        // One after another, and one inside another.
        assert!(!is_refused(&f("if a { } else { b(); } c();".repeat(1000))));
        let inner = |n: usize, inside: &str| format!("if a {{ }}{} else {{ {inside} }}", " else if b { }".repeat(n));
        assert!(!is_refused(&f(inner(120, &inner(70, "")))) && is_refused(&f(inner(120, &inner(90, "")))));
        let constants = |n: usize| "const c = 1;\n".repeat(n);
        assert!(!is_refused(&constants(1000)) && is_refused(&constants(1001)));
        assert!(!is_refused(&f("var x = 1;".repeat(2000))));
        assert!(!is_refused(")]}),};else"));
    }
}
