//! Packing of uniform blocks, by the member names of the reflection.

use glam::DVec3;

use crate::error::Error;

/// A value of a member of a struct.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Scalar {
    /// `f32`
    Float(f64),
    /// `u32`
    Uint(u32),
    /// `vec3u`
    Uints([u32; 3]),
    /// `vec3f`
    Vector(DVec3),
    /// `vec4f`
    Vector4([f64; 4]),
}

/// A member of a struct: its offset and its type.
#[derive(Debug, Clone, PartialEq)]
pub struct Member {
    /// Its name.
    pub name: String,
    /// Bytes from the start.
    pub offset: usize,
    /// 1 for a number, 3 for a `vec3`; 0 for anything that the host cannot fill.
    pub components: usize,
    /// Whether its numbers are `f32`; otherwise they are integers.
    pub float: bool,
    /// Whether its numbers are signed integers: `i32`.
    pub signed: bool,
}

/// The layout of a struct.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Packed {
    /// Bytes in all.
    pub size: usize,
    /// Its members.
    pub members: Vec<Member>,
}

#[expect(clippy::cast_possible_truncation, reason = "rounding to f32 is what the device does")]
fn bytes(x: f64) -> [u8; 4] {
    (x as f32).to_le_bytes()
}

impl Packed {
    /// Packs values by name. Every member must be given once, with a value of its kind; an integer may be given for a float.
    ///
    /// # Errors
    /// [`Error::Scene`] that names the missing, unknown or mistyped member.
    pub fn pack(&self, owner: &str, values: &[(&str, Scalar)]) -> Result<Vec<u8>, Error> {
        let mut out = vec![0; self.size];
        for (name, _) in values {
            if !self.members.iter().any(|m| m.name == *name) {
                let known: Vec<_> = self.members.iter().map(|m| format!("`{}`", m.name)).collect();
                return Err(Error::Scene(format!("{owner} has no parameter `{name}`; it has {}", list(&known))));
            }
        }
        for member in &self.members {
            let Some((_, value)) = values.iter().find(|(name, _)| *name == member.name) else {
                return Err(Error::Scene(format!("{owner} requires a value for its parameter `{}`", member.name)));
            };
            let words: Vec<[u8; 4]> = match (*value, member.float, member.components) {
                (Scalar::Float(x), true, 1) => vec![bytes(x)],
                (Scalar::Uint(n), true, 1) => vec![bytes(f64::from(n))],
                (Scalar::Uint(n), false, 1) if f64::from(n) <= member.most() => vec![n.to_le_bytes()],
                (Scalar::Float(x), false, 1) if x.fract() == 0.0 && (0.0..=member.most()).contains(&x) => {
                    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "just checked")]
                    let n = x as u32;
                    vec![n.to_le_bytes()]
                }
                (Scalar::Float(x), false, 1)
                    if member.signed && x.fract() == 0.0 && x >= f64::from(i32::MIN) && x < 0.0 =>
                {
                    #[expect(clippy::cast_possible_truncation, reason = "just checked")]
                    let n = x as i32;
                    vec![n.to_le_bytes()]
                }
                (Scalar::Uints(v), false, 3) => v.map(u32::to_le_bytes).to_vec(),
                (Scalar::Vector(v), true, 3) => v.to_array().map(bytes).to_vec(),
                (Scalar::Vector4(v), true, 4) => v.map(bytes).to_vec(),
                _ => {
                    return Err(Error::Scene(format!(
                        "the parameter `{}` of {owner} is {} in the shader, and its value is of another kind",
                        member.name,
                        member.describe()
                    )));
                }
            };
            for (i, word) in words.iter().enumerate() {
                let at = member.offset + 4 * i;
                if let Some(place) = out.get_mut(at..at + 4) {
                    place.copy_from_slice(word);
                }
            }
        }
        Ok(out)
    }
    fn word(&self, bytes: &[u8], name: &str) -> [u8; 4] {
        let offset = self.members.iter().find(|m| m.name == name).map(|m| m.offset);
        offset.and_then(|at| bytes.get(at..at + 4)?.try_into().ok()).unwrap_or_default()
    }
    /// Reads a member of `f32`; zero when there is none.
    #[must_use]
    pub fn float(&self, bytes: &[u8], name: &str) -> f64 {
        f64::from(f32::from_le_bytes(self.word(bytes, name)))
    }
    /// Reads a member of `vec3f`; zero when there is none.
    #[must_use]
    pub fn vector(&self, bytes: &[u8], name: &str) -> glam::Vec3 {
        let offset = self.members.iter().find(|m| m.name == name).map_or(0, |m| m.offset);
        let word = |k: usize| bytes.get(offset + 4 * k..offset + 4 * k + 4).and_then(|word| word.try_into().ok());
        glam::Vec3::from_array([0, 1, 2].map(|k| f32::from_le_bytes(word(k).unwrap_or_default())))
    }
    /// Reads a member of `u32`; zero when there is none.
    #[must_use]
    pub fn uint(&self, bytes: &[u8], name: &str) -> u32 {
        u32::from_le_bytes(self.word(bytes, name))
    }
}

impl Member {
    /// The largest integer that it can hold.
    fn most(&self) -> f64 {
        if self.signed { f64::from(i32::MAX) } else { f64::from(u32::MAX) }
    }
    fn describe(&self) -> String {
        let scalar = match (self.float, self.signed) {
            (true, _) => "f32",
            (false, true) => "i32",
            (false, false) => "u32",
        };
        match self.components {
            0 => "of a type that a scene cannot fill (use f32, u32, vec3f or vec4f)".to_owned(),
            1 => format!("`{scalar}`"),
            n => format!("`vec{n}<{scalar}>`"),
        }
    }
}

fn list(names: &[String]) -> String {
    if names.is_empty() { "none".to_owned() } else { names.join(", ") }
}
