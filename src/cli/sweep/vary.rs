//! Varied keys of the scene, and their values.

use motes::Error;

/// Characters of values in the name of a folder.
const LONGEST: usize = 120;

/// A key and its values, as given.
#[derive(Debug, Clone, PartialEq)]
pub struct Varied {
    /// The key, such as `simulation.dt`.
    pub key: String,
    /// The values, such as `0.1` and `0.05`.
    pub values: Vec<String>,
}

impl Varied {
    /// Parses `key=value,value,…`; commas in brackets and quotes are part of a value.
    ///
    /// # Errors
    /// [`Error::Scene`] if there is no key, no value, or a value twice.
    pub fn parse(text: &str) -> Result<Self, Error> {
        let wrong = |why: &str| {
            Error::Scene(format!(
                "--vary {text}: {why}; write a key and its values, as in --vary simulation.dt=0.1,0.05"
            ))
        };
        let (key, values) = text.split_once('=').ok_or_else(|| wrong("there is no `=`"))?;
        let (key, values) = (key.trim(), split(values));
        if key.is_empty() {
            return Err(wrong("there is no key before `=`"));
        }
        if values.iter().any(String::is_empty) {
            return Err(wrong("a value is empty"));
        }
        let same = |a: &String, b: &String| {
            let number = |text: &String| text.parse::<f64>().ok().map(f64::to_bits);
            a == b || number(a).is_some() && number(a) == number(b)
        };
        let twice = |(place, value): &(usize, &String)| values[..*place].iter().any(|other| same(other, value));
        if let Some((_, twice)) = values.iter().enumerate().find(twice) {
            return Err(wrong(&format!("{twice} is there twice")));
        }
        Ok(Self { key: key.to_owned(), values })
    }
    /// Its values as numbers, if all of them are numbers.
    pub fn numbers(&self) -> Option<Vec<f64>> {
        let number = |text: &String| text.parse().ok().filter(|x: &f64| x.is_finite());
        self.values.iter().map(number).collect()
    }
}

fn split(text: &str) -> Vec<String> {
    let (mut parts, mut depth, mut quoted) = (vec![String::new()], 0_i32, false);
    for c in text.chars() {
        match c {
            '"' => quoted = !quoted,
            '[' | '{' if !quoted => depth += 1,
            ']' | '}' if !quoted => depth -= 1,
            _ => {}
        }
        if c == ',' && depth == 0 && !quoted {
            parts.push(String::new());
        } else if let Some(last) = parts.last_mut() {
            last.push(c);
        }
    }
    parts.into_iter().map(|part| part.trim().to_owned()).collect()
}

/// Refuses a key that is varied twice.
///
/// # Errors
/// [`Error::Scene`] that names it.
pub fn check(all: &[Varied]) -> Result<(), Error> {
    let twice = all.iter().enumerate().find(|(place, one)| all[..*place].iter().any(|other| other.key == one.key));
    twice.map_or(Ok(()), |(_, one)| {
        Err(Error::Scene(format!("--vary names {} twice: give all its values in one list", one.key)))
    })
}

/// All combinations, each as the values that are set; the last key changes fastest.
pub fn combinations(all: &[Varied]) -> Vec<Vec<String>> {
    all.iter().fold(vec![Vec::new()], |some, one| {
        let with = |case: &Vec<String>, value: &String| [&case[..], &[format!("{}={value}", one.key)]].concat();
        some.iter().flat_map(|case| one.values.iter().map(move |value| with(case, value))).collect()
    })
}

/// The name of a folder for a combination: its number and its values, without characters that file systems refuse.
pub fn folder(place: usize, of: usize, case: &[String]) -> String {
    let plain = |c: char| if c.is_ascii_alphanumeric() || "=.-+".contains(c) { c } else { '_' };
    let words = case.iter().map(|set| set.chars().map(plain).collect::<String>());
    let words: String = words.collect::<Vec<_>>().join(",").chars().take(LONGEST).collect();
    format!("{:0width$}_{words}", place + 1, width = of.to_string().len())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lists_are_split_outside_of_brackets() {
        let one = Varied::parse("force.0.direction=[1, 0, 0],[0,1,0]").expect("two values");
        assert_eq!(one.values, ["[1, 0, 0]", "[0,1,0]"]);
        assert_eq!(one.numbers(), None);
        let two = Varied::parse(" a.b = 1,2.5e-3 ").expect("two values");
        assert_eq!((two.key.as_str(), two.numbers()), ("a.b", Some(vec![1.0, 2.5e-3])));
        for wrong in ["a", "=1", "a=", "a=1,,2", "a=1,1", "a=0.1,0.10", "a=1e-1,0.1"] {
            assert!(Varied::parse(wrong).is_err(), "{wrong}");
        }
        assert_eq!(combinations(&[one, two]).len(), 4);
    }
    #[test]
    fn folders_have_plain_names() {
        let case = ["simulation.dt=0.1".to_owned(), "a.b=[1, ../2]".to_owned()];
        assert_eq!(folder(4, 120, &case), "005_simulation.dt=0.1,a.b=_1__.._2_");
        assert!(folder(0, 9, &["x=".to_owned() + &"y".repeat(500)]).len() < 130);
    }
}
