//! The tags of an XML file, one after another: the part of XML that VTK files need, since their raw data is not XML.

/// A tag.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Tag<'a> {
    /// Its name; that of an end begins with `/`.
    pub name: &'a str,
    attributes: &'a str,
    /// Whether it is self-closing.
    pub empty: bool,
    /// Its start and its end \[bytes\].
    pub from: usize,
    pub to: usize,
}

impl<'a> Tag<'a> {
    /// The next tag from this byte on; comments and declarations are skipped. `None` where there is none.
    ///
    /// # Errors
    /// The byte of a tag without an end.
    pub fn next(bytes: &'a [u8], mut at: usize) -> Result<Option<Self>, String> {
        loop {
            let Some(from) = find(bytes, at, b"<") else { return Ok(None) };
            let rest = &bytes[from..];
            if rest.starts_with(b"<!--") {
                at = find(bytes, from, b"-->").ok_or_else(|| format!("byte {from}: a comment does not end"))? + 3;
                continue;
            }
            let to = end(bytes, from).ok_or_else(|| format!("byte {from}: a tag does not end"))?;
            if matches!(rest.get(1), Some(b'?' | b'!')) {
                at = to;
                continue;
            }
            let inner =
                std::str::from_utf8(&bytes[from + 1..to - 1]).map_err(|_| format!("byte {from}: a tag is no text"))?;
            let empty = inner.ends_with('/');
            let inner = inner.strip_suffix('/').unwrap_or(inner);
            let (name, attributes) = inner.split_once(char::is_whitespace).unwrap_or((inner, ""));
            return Ok(Some(Self { name, attributes, empty, from, to }));
        }
    }
    /// The value of an attribute.
    pub fn get(&self, key: &str) -> Option<&'a str> {
        let mut rest = self.attributes;
        while let Some((name, after)) = rest.split_once('=') {
            let after = after.trim_start();
            let quote = after.chars().next().filter(|c| matches!(c, '"' | '\''))?;
            let (value, next) = after[1..].split_once(quote)?;
            if name.trim() == key {
                return Some(value);
            }
            rest = next;
        }
        None
    }
}

/// The end of a tag that begins here: a `>` in quotes does not count.
fn end(bytes: &[u8], from: usize) -> Option<usize> {
    let mut quote = None;
    for (place, byte) in bytes.iter().enumerate().skip(from + 1) {
        match (quote, byte) {
            (None, b'"' | b'\'') => quote = Some(*byte),
            (Some(open), byte) if open == *byte => quote = None,
            (None, b'>') => return Some(place + 1),
            _ => {}
        }
    }
    None
}

fn find(bytes: &[u8], from: usize, word: &[u8]) -> Option<usize> {
    bytes.get(from..)?.windows(word.len()).position(|part| part == word).map(|place| from + place)
}

/// The bytes of a text in base 64 (RFC 4648); `None` if it is invalid. Each padded part is decoded separately.
pub(super) fn base64(text: &[u8]) -> Option<Vec<u8>> {
    let mut out = Vec::with_capacity(text.len() / 4 * 3);
    let mut four = [0_u8; 4];
    let mut there = 0;
    let mut padding = 0;
    for byte in text.iter().filter(|byte| !byte.is_ascii_whitespace()) {
        let value = match byte {
            b'A'..=b'Z' => byte - b'A',
            b'a'..=b'z' => byte - b'a' + 26,
            b'0'..=b'9' => byte - b'0' + 52,
            b'+' => 62,
            b'/' => 63,
            b'=' if there >= 2 => {
                padding += 1;
                0
            }
            _ => return None,
        };
        if padding > 0 && *byte != b'=' {
            return None;
        }
        four[there] = value;
        there += 1;
        if there == 4 {
            let [a, b, c, d] = four;
            let three = [a << 2 | b >> 4, b << 4 | c >> 2, c << 6 | d];
            out.extend_from_slice(&three[..3 - padding]);
            (there, padding) = (0, 0);
        }
    }
    (there == 0).then_some(out)
}

#[cfg(test)]
mod tests {
    use super::{Tag, base64};

    #[test]
    fn tags_are_found_in_order() {
        let text = b"<?xml version=\"1.0\"?><!-- <no> --><A b=\"1 > 0\" c='x'><B/></A>";
        let first = Tag::next(text, 0).expect("tags").expect("one");
        assert_eq!((first.name, first.get("b"), first.get("c"), first.get("d")), ("A", Some("1 > 0"), Some("x"), None));
        let second = Tag::next(text, first.to).expect("tags").expect("one");
        assert_eq!((second.name, second.empty), ("B", true));
        let third = Tag::next(text, second.to).expect("tags").expect("one");
        assert_eq!(third.name, "/A");
        assert_eq!(Tag::next(text, third.to), Ok(None));
        assert!(Tag::next(b"<A b=\"", 0).is_err());
    }

    #[test]
    fn base64_is_that_of_the_standard() {
        for (text, bytes) in [("", ""), ("Zg==", "f"), ("Zm8=", "fo"), ("Zm9v", "foo"), ("Zm9v\nYmFy", "foobar")] {
            assert_eq!(base64(text.as_bytes()).as_deref(), Some(bytes.as_bytes()), "{text}");
        }
        for text in ["Z", "Zg=", "====", "Z!==", "Zg==Zg="] {
            assert_eq!(base64(text.as_bytes()), None, "{text}");
        }
    }
}
