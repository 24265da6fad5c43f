//! Many mutants in one text. Each stands beside what it changes, and a number in a buffer chooses one of them, so that a driver compiles
//! all of them at once: `a + b` becomes `select(a + b, a - b, mutant_chosen == 3u)`.

use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;

use naga::Statement;
use naga::valid::{Capabilities, GlobalUse, ValidationFlags, Validator};

use motes::kernel::{Access, Plan, Shader, Source};

use super::Shared;
use super::mutants::Mutant;

/// The functions of a shader that are not called twice: they write storage, or what a pointer of theirs points to, or they call and loop, so that a
/// text with many copies of them would grow from call to call.
pub fn single(module: &naga::Module) -> BTreeSet<String> {
    let mut validator = Validator::new(ValidationFlags::all(), Capabilities::all());
    let info = validator.validate(module).expect("a shader that is valid");
    let writes = |handle: naga::Handle<naga::Function>| {
        let mut globals = module.global_variables.iter();
        globals.any(|(global, _)| info[handle][global].intersects(GlobalUse::WRITE | GlobalUse::ATOMIC))
    };
    let points = |function: &naga::Function| {
        let pointer = |argument: &naga::FunctionArgument| module.types[argument.ty].inner.pointer_space().is_some();
        function.arguments.iter().any(pointer)
    };
    let plain = |body: &naga::Block| {
        !body.iter().any(|s| matches!(s, Statement::Call { .. } | Statement::Loop { .. } | Statement::If { .. }))
    };
    let once = |(handle, function): &(naga::Handle<naga::Function>, &naga::Function)| {
        points(function) || writes(*handle) || !plain(&function.body)
    };
    module.functions.iter().filter(once).filter_map(|(_, function)| function.name.clone()).collect()
}

/// The buffer with the number of the mutant. It is none of uniforms: lavapipe of Mesa 22.2 to 23.0 compiles anew for each value of a uniform on
/// which branches depend, and ends the process where there are several.
pub const BUFFER: &str = "mutant_choice";

/// What functions call the number in it.
const CHOSEN: &str = "mutant_chosen";

/// Mutants that are compiled together at most: texts with many of them are nested deeply, and drivers take longer for them than for several texts.
pub const MOST: usize = 24;

/// Storage buffers of a shader, at most: one more than by the limits of WebGPU, which the shaders themselves keep.
pub const STORAGE: usize = 9;

/// A device of which a shader can have one buffer more than WebGPU promises: the one that chooses a mutant.
pub fn roomy() -> Shared {
    let mut shared = super::open();
    let more = |limits: &mut motes::wgpu::Limits| {
        limits.max_storage_buffers_per_shader_stage = u32::try_from(STORAGE).expect("few");
    };
    (shared.found.device, shared.found.queue) = pollster::block_on(super::limited(&shared, more));
    shared
}

/// Whether such a device can bind the buffer that chooses beside those of a shader.
pub fn has_room(shader: &Shader) -> bool {
    shader.reflection().bindings.iter().filter(|binding| binding.access != Access::Uniform).count() < STORAGE
}

/// The buffer that chooses, at the first binding that a shader leaves free.
pub fn declaration(shader: &Shader) -> Vec<Source> {
    let group = shader.reflection().bindings.iter().filter(|binding| binding.group == 0);
    let free = group.map(|binding| binding.binding + 1).max().unwrap_or(0);
    let text = format!("@group(0) @binding({free}) var<storage, read> {BUFFER}: array<u32>;\n");
    vec![Source::theirs(BUFFER.into(), text)]
}

/// The plan with one word for the choice.
pub fn with_buffer(mut plan: Plan) -> Plan {
    for kernel in &mut plan.kernels {
        if kernel.passes.iter().any(|pass| pass.shader.reflection().binding(BUFFER).is_some()) {
            kernel.sizes.push((BUFFER.into(), 1));
        }
    }
    plan
}

/// The number that chooses this mutant, or none of them.
pub fn choice(mutant: Option<usize>) -> u32 {
    mutant.map_or(u32::MAX, |mutant| u32::try_from(mutant).expect("few mutants"))
}

/// A part of the text that a mutant changes, as small as can be chosen as a whole.
#[derive(Clone)]
struct Site {
    range: Range<usize>,
    /// A statement, which is chosen by a branch; otherwise an expression.
    statement: bool,
}

/// The sites of mutants, in the order of the text and the longest first among those that begin at one place.
type Sites = BTreeMap<(usize, usize), (Site, Vec<usize>)>;

/// The text with those of the mutants that `wanted` names; the rest of it is as it was. A mutant that cannot be joined is left out.
/// `copied` says whether a function of the shader may be called twice.
pub fn joined(text: &str, mutants: &[Mutant], wanted: &[usize], copied: &dyn Fn(&str) -> bool) -> (String, Vec<usize>) {
    let code = without_comments(text);
    let mut sites = Sites::new();
    let mut inside = Vec::new();
    for &number in wanted {
        let site = site(&code, mutants[number].at, &mutants[number].old);
        if let Some(site) = site.filter(|site| site.statement || twice(&code[site.range.clone()], copied)) {
            enter(&mut sites, site, number);
            inside.push(number);
        }
    }
    let chosen = |site: &Site, numbers: &[usize], part: String| {
        numbers.iter().fold(part, |part, number| {
            let Mutant { at, old, new, .. } = &mutants[*number];
            let changed = [&text[site.range.start..*at], new, &text[at + old.len()..site.range.end]].concat();
            let chosen = format!("{CHOSEN} == {number}u");
            if site.statement {
                format!("if ({chosen}) {{ {changed} }} else {{ {part} }}")
            } else {
                format!("select({part}, {changed}, {chosen})")
            }
        })
    };
    let sites: Vec<_> = sites.into_values().collect();
    (choosing(&render(text, 0..text.len(), &sites, &chosen)), inside)
}

/// The text in which each function that chooses reads the number once: software drivers make a loop of every read of a buffer, and are slow where
/// many of them stand between barriers.
fn choosing(text: &str) -> String {
    let code = without_comments(text);
    let (mut all, mut done, mut at) = (String::new(), 0, 0);
    while let Some(open) = code[at..].find('{').map(|open| at + open + 1) {
        let mut depth = 1;
        let mut inside = |b: u8| {
            depth += i32::from(b == b'{') - i32::from(b == b'}');
            depth > 0
        };
        let end = open + code[open..].bytes().take_while(|b| inside(*b)).count();
        if code[open..end].contains(CHOSEN) {
            all += &text[done..open];
            all += &format!(" let {CHOSEN} = {BUFFER}[0];");
            done = open;
        }
        at = end;
    }
    all + &text[done..]
}

/// The text with brackets around all that can be chosen: where these change what it says, the wrong part would be chosen.
pub fn bracketed(text: &str, mutants: &[Mutant]) -> String {
    let code = without_comments(text);
    let mut sites = Sites::new();
    let all = mutants.iter().filter_map(|mutant| site(&code, mutant.at, &mutant.old));
    all.filter(|site| !site.statement).for_each(|site| enter(&mut sites, site, 0));
    let sites: Vec<_> = sites.into_values().collect();
    render(text, 0..text.len(), &sites, &|_, _, part| format!("({part})"))
}

fn enter(sites: &mut Sites, site: Site, number: usize) {
    let key = (site.range.start, usize::MAX - site.range.end);
    sites.entry(key).or_insert_with(|| (site, Vec::new())).1.push(number);
}

/// The text of a range, with each site in it as `written`.
fn render(
    text: &str,
    range: Range<usize>,
    sites: &[(Site, Vec<usize>)],
    written: &dyn Fn(&Site, &[usize], String) -> String,
) -> String {
    let (mut all, mut done, mut next) = (String::new(), range.start, 0);
    while let Some((site, numbers)) = sites.get(next) {
        let within = sites[next + 1..].iter().take_while(|(inner, _)| inner.range.end <= site.range.end).count();
        all += &text[done..site.range.start];
        let inner = &sites[next + 1..=next + within];
        all += &written(site, numbers, render(text, site.range.clone(), inner, written));
        done = site.range.end;
        next += 1 + within;
    }
    all + &text[done..range.end]
}

/// Comments as spaces.
pub fn without_comments(text: &str) -> String {
    let blank = |line: &str| {
        let code = line.split("//").next().unwrap_or_default();
        let rest = line[code.len()..].bytes().map(|b| if b == b'\n' { '\n' } else { ' ' });
        code.chars().chain(rest).collect::<String>()
    };
    text.split_inclusive('\n').map(blank).collect()
}

/// Whether a part of a text may be evaluated twice.
fn twice(code: &str, copied: &dyn Fn(&str) -> bool) -> bool {
    code.match_indices('(').all(|(at, _)| {
        let start = code[..at].bytes().rposition(|b| !name(b)).map_or(0, |last| last + 1);
        let function = &code[start..at];
        function.is_empty()
            || !["atomic", "workgroup"].iter().any(|word| function.starts_with(word)) && copied(function)
    })
}

pub fn name(b: u8) -> bool {
    b.is_ascii_alphanumeric() || b == b'_'
}

/// What is chosen instead of the token at a place.
fn site(code: &str, at: usize, old: &str) -> Option<Site> {
    let end = at + old.len();
    if old.starts_with("atomic") {
        return None;
    }
    let begun = code[..at].rfind(['{', '}', ';']).map_or(0, |last| last + 1);
    let depth = code[..at].bytes().fold(0, |open, b| open + i32::from(b == b'{') - i32::from(b == b'}'));
    if depth == 0 || code[begun..].trim_start().starts_with("const ") {
        return None;
    }
    let expression = |range| Some(Site { range, statement: false });
    if old.starts_with(|c: char| c.is_ascii_digit()) || old == "true" || old == "false" {
        return expression(at..end);
    }
    if old.starts_with(|c: char| c.is_ascii_alphabetic()) {
        return expression(at..closed(code, end)?);
    }
    let spaced = code[..at].ends_with(' ') && code[end..].starts_with([' ', '\n']);
    if !spaced {
        return expression(at..operand(code, end)?);
    }
    if old.ends_with('=') && precedence(old).is_none() {
        let start = begun + code[begun..].len() - code[begun..].trim_start().len();
        let end = end + code[end..].find(';')? + 1;
        let whole = code[start..end].bytes().fold(0, |open, b| open + i32::from(b == b'(') - i32::from(b == b')')) == 0;
        return whole.then_some(Site { range: start..end, statement: true });
    }
    let own = precedence(old)?;
    expression(left(code, at, own)..right(code, end, own))
}

/// How strongly an operator binds; none for what assigns.
fn precedence(operator: &str) -> Option<u32> {
    Some(match operator {
        "||" => 0,
        "&&" => 1,
        "&" | "|" | "^" => 2,
        "<" | "<=" | ">" | ">=" | "==" | "!=" => 3,
        "<<" | ">>" => 4,
        "+" | "-" => 5,
        "*" | "/" | "%" => 6,
        _ => return None,
    })
}

/// The operator between spaces that begins here.
fn operator(code: &str, at: usize) -> Option<&str> {
    let length = code[at..].bytes().take_while(|b| b"+-*/%<>=!&|^".contains(b)).count();
    let spaced = at > 0 && code.as_bytes()[at - 1] == b' ' && code[at + length..].starts_with([' ', '\n']);
    (length > 0 && spaced).then(|| &code[at..at + length])
}

/// Where the left operand of an operator begins.
fn left(code: &str, at: usize, own: u32) -> usize {
    let bytes = code.as_bytes();
    let (mut open, mut start, mut place) = (0, at, at);
    while place > 0 {
        place -= 1;
        match bytes[place] {
            b')' | b']' => open += 1,
            b'(' | b'[' | b',' | b';' | b'{' | b'}' if open == 0 => break,
            b'(' | b'[' => open -= 1,
            b if open == 0 && name(b) => {
                let from = bytes[..place].iter().rposition(|b| !name(*b)).map_or(0, |last| last + 1);
                if ["return", "if", "while", "switch", "case", "else", "in"].contains(&&code[from..=place]) {
                    break;
                }
                place = from;
            }
            b' ' | b'\n' => continue,
            _ if open == 0 => {
                let from = bytes[..place].iter().rposition(|b| !b"+-*/%<>=!&|^".contains(b)).map_or(0, |last| last + 1);
                if let Some(operator) = operator(code, from)
                    && precedence(operator).is_none_or(|other| other < own)
                {
                    break;
                }
                place = from.min(place);
            }
            _ => {}
        }
        start = place;
    }
    start
}

/// Where the right operand of an operator ends.
fn right(code: &str, from: usize, own: u32) -> usize {
    let bytes = code.as_bytes();
    let (mut open, mut end, mut place) = (0, from, from);
    while place < bytes.len() {
        match bytes[place] {
            b'(' | b'[' => open += 1,
            b')' | b']' | b',' | b';' | b'{' | b'}' if open == 0 => break,
            b')' | b']' => open -= 1,
            b' ' | b'\n' => {
                place += 1;
                continue;
            }
            _ if open == 0 => {
                if let Some(operator) = operator(code, place) {
                    if precedence(operator).is_none_or(|other| other <= own) {
                        break;
                    }
                    place += operator.len();
                    end = place;
                    continue;
                }
            }
            _ => {}
        }
        place += 1;
        end = place;
    }
    end
}

/// Where the operand of a sign ends: a number, a name or a bracket, with members, indices and arguments.
fn operand(code: &str, from: usize) -> Option<usize> {
    let bytes = code.as_bytes();
    let mut at = from;
    while bytes.get(at).is_some_and(|b| b"-!~*".contains(b)) {
        at += 1;
    }
    loop {
        match bytes.get(at)? {
            b'(' | b'[' => at = closed(code, at)?,
            b if name(*b) || *b == b'.' => at += 1,
            _ => return (at > from).then_some(at),
        }
    }
}

/// Where the bracket that opens here is closed.
fn closed(code: &str, from: usize) -> Option<usize> {
    if !code[from..].starts_with(['(', '[']) {
        return None;
    }
    let mut open = 0;
    for (place, b) in code.bytes().enumerate().skip(from) {
        match b {
            b'(' | b'[' => open += 1,
            b')' | b']' => open -= 1,
            _ => {}
        }
        if open == 0 {
            return Some(place + 1);
        }
    }
    None
}
