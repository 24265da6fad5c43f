//! `enable`, `requires` and `diagnostic` at the top of a user's file: WGSL requires them before all else, so they are moved to the front of
//! the joined text.

use super::tokens::{Token, tokens};
use crate::error::Error;
use crate::kernel::Source;

/// Splits a file in two: its directives, and the rest at its old position, after as many spaces and line ends as the directives had, so
/// that messages give the lines of the file.
pub fn parted(source: &Source) -> Option<(Source, Source)> {
    let end = end(&tokens(&source.text))?;
    let head = source.text.get(..end)?;
    let blank = |c: char| if c == '\n' { "\n".to_owned() } else { " ".repeat(c.len_utf8()) };
    let rest: String = head.chars().map(blank).collect::<String>() + source.text.get(end..)?;
    let part = |text: String| Source { text: text.into(), ..source.clone() };
    Some((part(head.to_owned()), part(rest)))
}

/// The end of the last directive, if there is one.
fn end(tokens: &[Token]) -> Option<usize> {
    let (mut end, mut rest) = (None, tokens);
    while rest.first().is_some_and(|word| ["enable", "requires", "diagnostic"].contains(&word.text)) {
        let length = rest.iter().position(|word| word.text == ";")? + 1;
        end = rest.get(length - 1).map(Token::end);
        rest = &rest[length..];
    }
    end
}

/// Refuses features that not every device has.
pub fn check(sources: &[Source]) -> Result<(), Error> {
    for source in sources.iter().filter(|source| source.law) {
        let words = tokens(&source.text);
        if let Some(at) = words.iter().position(|word| word.text == "enable").filter(|_| end(&words).is_some()) {
            let what = words.get(at + 1).map_or("", |word| word.text);
            let message = format!(
                "{}: `enable {what}` is not supported: motes requests no optional features, so that laws run on all devices",
                source.file
            );
            return Err(Error::Shader { message });
        }
    }
    Ok(())
}

/// Sources in the order in which they are joined: directives first.
pub fn hoisted(sources: &[Source]) -> Vec<Source> {
    let (mut first, mut rest) = (Vec::new(), Vec::new());
    for source in sources {
        match source.law.then(|| parted(source)).flatten() {
            Some((head, tail)) => {
                first.push(head);
                rest.push(tail);
            }
            None => rest.push(source.clone()),
        }
    }
    first.extend(rest);
    first
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn directives_come_first_and_lines_stay_where_they_are() {
        let text = "// é: a law\nenable f16; requires a,\n b;\nfn f() {} enable;";
        let ours = Source::ours("ours.wgsl", "fn g() {}");
        let all = hoisted(&[ours.clone(), Source::law("l.wgsl".into(), text.into())]);
        assert_eq!(all.len(), 3);
        assert_eq!(all[0].text, "// é: a law\nenable f16; requires a,\n b;");
        assert_eq!(all[1], ours);
        assert_eq!(all[2].text.len(), text.len());
        assert_eq!(all[2].text.trim_start(), "fn f() {} enable;");
        assert_eq!(all[2].text.matches('\n').count(), 3);
        assert_eq!(hoisted(std::slice::from_ref(&ours)), [ours]);
    }
}
