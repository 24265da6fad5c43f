//! Every operator and every literal of a WGSL text, changed once.

/// A change of one token.
#[derive(Debug, Clone)]
pub struct Mutant {
    /// The line that is changed, without the space around it.
    pub line: String,
    /// The place in the line, in characters: of several equal tokens each is another mutant.
    pub column: usize,
    /// The place in the text, in bytes.
    pub at: usize,
    /// What was there.
    pub old: String,
    /// What is there now.
    pub new: String,
    /// The whole text with the change.
    pub text: String,
}

/// Binary operators, which the house writes between spaces; what has none around is a sign, a pointer or a template.
const OPERATORS: &[(&str, &str)] = &[
    ("+", "-"),
    ("-", "+"),
    ("*", "/"),
    ("/", "*"),
    ("<", "<="),
    ("<=", "<"),
    (">", ">="),
    (">=", ">"),
    ("==", "!="),
    ("!=", "=="),
    ("&&", "||"),
    ("||", "&&"),
    ("&", "|"),
    ("|", "&"),
    ("+=", "-="),
    ("-=", "+="),
    ("*=", "/="),
    ("/=", "*="),
];
/// The other direction of a comparison, beside its edge.
const TURNED: &[(&str, &str)] = &[("<", ">"), ("<=", ">="), (">", "<"), (">=", "<=")];

const WORDS: &[(&str, &str)] = &[
    ("min", "max"),
    ("max", "min"),
    ("atomicMin", "atomicMax"),
    ("any", "all"),
    ("sin", "cos"),
    ("sqrt", "inverseSqrt"),
    ("inverseSqrt", "sqrt"),
    ("log", "log2"),
    ("fract", "floor"),
    ("cross", "max"),
    ("true", "false"),
    ("false", "true"),
];

/// All mutants of a text. Attributes are left alone: their numbers are names, which reflection reads. So are comments.
pub fn mutants(text: &str) -> Vec<Mutant> {
    let mut all = Vec::new();
    let mut start = 0;
    for line in text.split_inclusive('\n') {
        let code = line.split("//").next().unwrap_or_default();
        for (from, to) in tokens(code) {
            let old = &code[from..to];
            let spaced = code[..from].ends_with(' ') && (code[to..].starts_with(' ') || code[to..].starts_with('\n'));
            for new in changes(old, spaced) {
                let text = [&text[..start + from], &new, &text[start + to..]].concat();
                let column = code[..from].chars().count();
                let (line, old, at) = (line.trim().to_owned(), old.to_owned(), start + from);
                all.push(Mutant { line, column, at, old, new, text });
            }
        }
        start += line.len();
    }
    all
}

/// The byte ranges of words, numbers and operators, without attributes and what stands in their parentheses.
fn tokens(code: &str) -> Vec<(usize, usize)> {
    let bytes = code.as_bytes();
    let word = |b: u8| b.is_ascii_alphanumeric() || b == b'_';
    let mut list = Vec::new();
    let mut at = 0;
    while at < bytes.len() {
        let from = at;
        match bytes[at] {
            b'@' => {
                at += 1 + bytes[at + 1..].iter().take_while(|b| word(**b)).count();
                if bytes.get(at) == Some(&b'(') {
                    at += code[at..].find(')').map_or(1, |close| close + 1);
                }
                continue;
            }
            // A number may have a point, and an exponent with its sign.
            b if b.is_ascii_digit() => {
                let part = |at: usize| bytes[at..].iter().take_while(|b| word(**b) || **b == b'.').count();
                at += part(at);
                if code[from..at].ends_with('e') && !code[from..].starts_with("0x") && bytes.get(at) == Some(&b'-') {
                    at += 1 + part(at + 1);
                }
            }
            b if word(b) => at += bytes[at..].iter().take_while(|b| word(**b)).count(),
            b if b"+-*/<>=!&|".contains(&b) => {
                at += bytes[at..].iter().take_while(|b| b"+-*/<>=!&|".contains(b)).count();
            }
            _ => {
                at += code[at..].chars().next().map_or(1, char::len_utf8);
                continue;
            }
        }
        list.push((from, at));
    }
    list
}

fn changes(old: &str, spaced: bool) -> Vec<String> {
    if old.starts_with(|c: char| c.is_ascii_digit()) {
        return vec![number(old)];
    }
    let swapped = |pairs: &[(&str, &str)]| -> Vec<String> {
        pairs.iter().filter(|(from, _)| *from == old).map(|(_, to)| (*to).to_owned()).collect()
    };
    if spaced {
        return [swapped(OPERATORS), swapped(TURNED), swapped(WORDS)].concat();
    }
    // A sign falls away.
    if old == "-" { vec![" ".to_owned()] } else { swapped(WORDS) }
}

/// Half as much again, or one more; nothing becomes something.
fn number(old: &str) -> String {
    if let Some(digits) = old.strip_prefix("0x").and_then(|d| d.strip_suffix('u')) {
        return format!("0x{:x}u", u32::from_str_radix(digits, 16).expect("hexadecimal digits").wrapping_add(1));
    }
    if old.contains('.') || old.contains('e') {
        let x: f64 = old.parse().expect("a number");
        return format!("{:?}", if x == 0.0 { 1.0 } else { x * 1.5 });
    }
    let digits = old.trim_end_matches(['u', 'i']);
    format!("{}{}", digits.parse::<u64>().expect("a whole number") + 1, &old[digits.len()..])
}
