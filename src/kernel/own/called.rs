//! The way in which a law is called, by the functions of its file.

use super::tokens::{Token, tokens};

/// The word of `over` with which a file can be called that has these functions: `links` or `joints` where its `gather` takes such a thing, `pairs` where it has
/// a `gather`, an `energy` or an `even_energy`, and `each` otherwise.
#[must_use]
pub fn over(text: &str) -> &'static str {
    let all = tokens(text);
    let head = |name: &str| -> Option<&[Token]> {
        let at = all.windows(2).position(|pair| pair[0].text == "fn" && pair[1].text == name)?;
        let rest = &all[at..];
        Some(&rest[..rest.iter().position(|token| token.text == "{").unwrap_or(rest.len())])
    };
    let Some(gather) = head("gather").or_else(|| head("energy")).or_else(|| head("even_energy")) else { return "each" };
    let takes = |kind: &str| gather.iter().any(|token| token.text == kind);
    if takes("Link") {
        "links"
    } else if takes("Corner") {
        "joints"
    } else {
        "pairs"
    }
}

#[cfg(test)]
mod tests {
    use super::over;

    #[test]
    fn functions_say_it_and_comments_do_not() {
        for (text, want) in [
            ("// fn gather(\nfn force (me: Particle) -> vec4f { return vec4f(); }", "each"),
            ("fn update(me: Particle) {}", "each"),
            ("fn gather\n(a: Particle, b: Particle, r: vec3f, s: ptr<function, Sum>) {}", "pairs"),
            ("fn energy(a: Particle, b: Particle, d: f32, i: f32) -> Energy { return Energy(0, 0); }", "pairs"),
            ("fn even_energy(a: Particle, b: Particle, s: f32, i: f32) -> Energy { return Energy(0, 0); }", "pairs"),
            ("fn gather(a: Particle, b: Particle, r: vec3f, l: Link, s: ptr<function, Sum>) {}", "links"),
            ("fn gather(a: Particle, /* Link */ c: Corner, s: ptr<function, Sum>) {}", "joints"),
            ("", "each"),
        ] {
            assert_eq!(over(text), want, "{text}");
        }
    }
}
