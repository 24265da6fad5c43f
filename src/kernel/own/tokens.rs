//! The words and marks of a WGSL text, comments left out.

/// A name, a number or a single mark.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Token<'a> {
    /// The text.
    pub text: &'a str,
    /// Its start \[bytes\].
    pub at: usize,
}

impl Token<'_> {
    /// Its end \[bytes\].
    pub fn end(&self) -> usize {
        self.at + self.text.len()
    }
}

/// Splits a text. WGSL has no strings and no preprocessor, so comments are all that can hide a word.
pub fn tokens(text: &str) -> Vec<Token<'_>> {
    let mut all = Vec::new();
    let mut at = 0;
    while let Some(rest) = text.get(at..).filter(|rest| !rest.is_empty()) {
        let first = rest.chars().next().unwrap_or(' ');
        if first.is_whitespace() {
            at += first.len_utf8();
        } else if rest.starts_with("//") {
            at += rest.find(is_line_end).unwrap_or(rest.len());
        } else if rest.starts_with("/*") {
            at += comment(rest);
        } else {
            let word = rest.find(|c: char| !(c.is_alphanumeric() || c == '_')).unwrap_or(rest.len());
            let text = &rest[..word.max(first.len_utf8())];
            all.push(Token { text, at });
            at += text.len();
        }
    }
    all
}

/// Line ends, as WGSL defines them.
fn is_line_end(c: char) -> bool {
    matches!(c, '\n' | '\u{b}' | '\u{c}' | '\r' | '\u{85}' | '\u{2028}' | '\u{2029}')
}

/// The length of the block comment at the start; such comments nest.
fn comment(rest: &str) -> usize {
    let (mut depth, mut at) = (0_usize, 0);
    while let Some(left) = rest.get(at..).filter(|left| !left.is_empty()) {
        if left.starts_with("/*") {
            depth += 1;
            at += 2;
        } else if left.starts_with("*/") {
            depth -= 1;
            at += 2;
            if depth == 0 {
                break;
            }
        } else {
            at += left.chars().next().map_or(1, char::len_utf8);
        }
    }
    at
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn comments_hide_words_and_nothing_else_does() {
        let text = "fn a(/* fn b( /* nested */ still */ x: f32) // fn c(\n{ return x*2.5; } /**/ é /* open";
        let words: Vec<_> = tokens(text).iter().map(|token| token.text).collect();
        let want = ["fn", "a", "(", "x", ":", "f32", ")", "{", "return", "x", "*", "2", ".", "5", ";", "}", "é"];
        assert_eq!(words, want);
        for token in tokens(text) {
            assert_eq!(&text[token.at..token.end()], token.text);
        }
    }
}
