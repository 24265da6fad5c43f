//! The groups of a DXF: a line with a code, and a line with a value.

/// A group, and the line of its code, counted from 1.
#[derive(Debug, Clone, Copy)]
pub struct Group<'a> {
    pub code: i32,
    pub value: &'a str,
    pub line: usize,
}

/// An entity, or another object: what begins with the code 0.
#[derive(Debug, Clone)]
pub struct Object<'a> {
    /// What it is, as in LINE.
    pub kind: &'a str,
    /// The line of its beginning.
    pub line: usize,
    pub groups: Vec<Group<'a>>,
}

impl Group<'_> {
    pub fn number(&self) -> Result<f64, String> {
        let number = self.value.parse::<f64>().ok().filter(|x| x.abs() <= 1e15);
        number.ok_or_else(|| {
            let value = super::super::super::shortened(self.value);
            format!("line {} is \"{value}\", and the code {} before it has a number", self.line + 1, self.code)
        })
    }
}

impl<'a> Object<'a> {
    /// The first value of a code.
    pub fn text(&self, code: i32) -> Option<&'a str> {
        self.groups.iter().find(|group| group.code == code).map(|group| group.value)
    }
    /// The first number of a code, or another one.
    pub fn number_or(&self, code: i32, other: f64) -> Result<f64, String> {
        self.groups.iter().find(|group| group.code == code).map_or(Ok(other), Group::number)
    }
    /// The first number of a code.
    pub fn number(&self, code: i32) -> Result<f64, String> {
        let group = self.groups.iter().find(|group| group.code == code);
        let lacks = || format!("the {} in line {} has no group {code}, a number", self.kind, self.line);
        group.ok_or_else(lacks)?.number()
    }
    /// Whether a bit of a number is set.
    pub fn has_bit(&self, code: i32, bit: i32) -> bool {
        self.text(code).and_then(|value| value.parse::<i32>().ok()).is_some_and(|bits| bits & bit != 0)
    }
}

/// All objects of a file, in order.
pub fn objects(text: &str) -> Result<Vec<Object<'_>>, String> {
    let mut objects: Vec<Object<'_>> = Vec::new();
    let mut lines = text.lines().map(str::trim).zip(1..);
    while let Some((code, line)) = lines.next() {
        let Ok(code) = code.parse::<i32>() else {
            // Blank lines after the end are none of it.
            if code.is_empty() && lines.all(|(rest, _)| rest.is_empty()) {
                break;
            }
            let code = super::super::super::shortened(code);
            return Err(format!(
                "line {line} is \"{code}\", and a DXF has a code there, a whole number: it is no DXF in ASCII, or damaged"
            ));
        };
        let Some((value, _)) = lines.next() else {
            return Err(format!("it ends after the code {code} in line {line}: it is cut off"));
        };
        match (code, objects.last_mut()) {
            (0, _) => objects.push(Object { kind: value, line, groups: Vec::new() }),
            (999, _) | (_, None) => {}
            (_, Some(last)) => last.groups.push(Group { code, value, line }),
        }
    }
    if objects.last().is_none_or(|last| last.kind != "EOF") {
        return Err(format!("it has no EOF at its end, in line {}: it is cut off", text.lines().count()));
    }
    Ok(objects)
}
