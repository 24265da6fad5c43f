//! Laws of each particle alone: whether their kernel may be fused with its neighbours, since it looks at no other particle.

use super::{Law, Over};
use crate::kernel::{Access, Kernel, Source};

/// The ways in which a file of this crate writes the index of the particle that an invocation treats.
const OWN: [&[&str]; 5] = [&["i"], &["id"], &["index"], &["me", ".", "index"], &["particle", ".", "index"]];

impl Law {
    /// Marks the kernel of a law of each particle alone, unless its files might look at another one.
    pub(super) fn mark_alone(&self, kernel: &mut Kernel) {
        let alone = self.over == Over::Each && !self.has_loops() && looks_at_own(kernel);
        kernel.passes.iter_mut().for_each(|pass| pass.alone = alone);
    }
}

/// Whether the files of a kernel use the columns of particles at the index of their own particle alone.
pub(crate) fn looks_at_own(kernel: &Kernel) -> bool {
    let bound = kernel.bindings().filter(|(_, binding)| binding.access != Access::Uniform && binding.array);
    let columns = bound.filter(|(field, _)| kernel.size(field).is_none());
    let columns: Vec<String> = columns.map(|(_, binding)| binding.name.clone()).collect();
    let mut files = kernel.passes.iter().flat_map(|pass| pass.shader.sources());
    files.all(|file| stays_alone(file, &columns))
}

/// Whether a file uses these columns at the index of its own particle alone. A user's file is taken at its words: what might make a
/// particle of another index is refused, whether it does or not.
fn stays_alone(file: &Source, columns: &[String]) -> bool {
    let words = file.words();
    let after = |at: usize, text: &[&str]| words.get(at..at + text.len()).is_some_and(|some| some == text);
    let before = |at: usize, text: &[&str]| at >= text.len() && after(at - text.len(), text);
    let used = |at: usize| {
        // Its declaration, a member or a function's own variable of the same name: those have no index.
        after(at + 1, &[":"])
            || file.ours && !after(at + 1, &["["])
            || before(at, &["."])
            || OWN.iter().any(|own| {
                let theirs = file.ours || own.len() == 3 && own[0] == "me";
                theirs && after(at + 1, &["["]) && after(at + 2, own) && after(at + 2 + own.len(), &["]"])
            })
    };
    let mut places = words.iter().enumerate();
    places.all(|(at, word)| match *word {
        name if columns.iter().any(|column| column == name) => used(at),
        _ if file.ours => true,
        // The parameter of a function, and no variable.
        "Particle" => before(at, &["me", ":"]) && [",", ")"].iter().any(|mark| after(at + 1, &[mark])),
        "particle" | "particle_at" | "particle_of" => false,
        // Read as it is: nothing is added to it, and nothing stored.
        "index" => before(at, &["me", "."]) && ["]", ",", ")"].iter().any(|mark| after(at + 1, &[mark])),
        "id_of" | "is_of" => after(at + 1, &["(", "me", ".", "index"]),
        "me" => !["let", "var", "&", ">", "="].iter().any(|mark| before(at, &[mark])),
        _ => true,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn law(text: &str) -> bool {
        let columns = ["position", "velocity", "charge"].map(str::to_owned);
        stays_alone(&Source::law("own.wgsl".to_owned(), text.to_owned()), &columns)
    }

    #[test]
    fn what_might_reach_another_particle_does_not_stay_alone() {
        let own = "fn force(me: Particle) -> vec4f { let v = velocity[me.index].xyz; return vec4f(-v * charge[me.index], 0.0); }";
        assert!(law(own));
        assert!(law(
            "fn a(me: Particle) -> vec3f { return velocity_of(me); } fn force(me: Particle) -> vec4f { return vec4f(a(me), 0.0); }"
        ));
        // Comments say nothing.
        assert!(law(
            "fn force(me: Particle) -> vec4f { /* position[3] */ return vec4f(me.position, 0.0); } // velocity[0]"
        ));
        for other in [
            own.replace("velocity[me.index]", "velocity[me.index + 1u]"),
            own.replace("velocity[me.index]", "velocity[0]"),
            own.replace("velocity[me.index]", "velocity_of(particle(0u))"),
            own.replace("velocity[me.index]", "velocity_of(Particle(0u, vec3f(), 1.0))"),
            own.replace("let v = velocity[me.index].xyz;", "var you: Particle; let v = velocity_of(you);"),
            own.replace("let v = velocity[me.index].xyz;", "var you = me; you.index = 0u; let v = velocity_of(you);"),
            own.replace("let v = velocity[me.index].xyz;", "let i = me.index; let v = velocity[i ^ 1u].xyz;"),
            own.replace("let v = velocity[me.index].xyz;", "let all = &velocity; let v = all[0].xyz;"),
            own.replace("let v = velocity[me.index].xyz;", "let i = 0u; let v = velocity[i].xyz;"),
            own.replace("let v = velocity[me.index].xyz;", "let v = vec3f(f32(id_of(me.index + 1u)));"),
            own.replace("let v = velocity[me.index].xyz;", "let v = vec3f(f32(is_of(3u, 1u)));"),
            "var<private> me: Particle; fn other() -> vec3f { me.index = 3u; return velocity[me.index].xyz; } \
             fn force(me: Particle) -> vec4f { return vec4f(other(), 0.0); }"
                .to_owned(),
            "var<private> me: Particle; fn other() -> vec3f { return velocity[me.index].xyz; } \
             fn force(at: Particle) -> vec4f { me = at; me.index += 1u; return vec4f(other(), 0.0); }"
                .to_owned(),
        ] {
            assert!(!law(&other), "{other}");
        }
    }
}
