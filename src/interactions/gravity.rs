//! Newton's law of gravity, softened.

use std::borrow::Cow;
use std::sync::Arc;

use glam::{DVec3, DVec4};

use super::{Component, Law, Over, Problem, Properties, Stage, evaluate, numbered, params};
use crate::component::{Expands, Largest};
use crate::cosmology::{Cosmology, Expansion, scale_factor};
use crate::error::Error;
use crate::ewald::{self, FITTED, LEAST, Split};
use crate::kernel::{Bounds, Column, Kind as Element, Plan, Scalar, Side, Source, World};
use crate::settings::{Key, Kind, Settings, Value};
use crate::tree::Opening;
use crate::visit::{Particle, Group};

/// The keys in a scene.
pub const KEYS: &[Key] = &[
    Key::new("g", Kind::Number, Value::Number(1.0), "the gravitational constant [length³ / mass / time²]").shared(),
    Key::new("softening", Kind::NotNegative, Value::Number(0.0), "the Plummer softening ε; the spline ends at 2.8 ε, so for PKDGRAV's own ε (whose spline ends at 2 ε) set 2/2.8 of it [length]"),
    Key::new("kernel", Kind::Choice(&["plummer", "spline"]), Value::Text(Cow::Borrowed("plummer")), "the softening kernel"),
    Key::new("individual_softening", Kind::Flag, Value::Flag(false), "whether each particle has a softening of its own, the column `softening_length`: the larger one of a pair counts, and `softening` is the largest there may be"),
    Key::new("over", Kind::Choice(&["pairs", "tree", "auto"]), Value::Text(Cow::Borrowed("pairs")), "which pairs are evaluated: all (direct summation), or far groups approximated by a tree; \"auto\": whichever is faster"),
    Key::new("theta", Kind::Fraction, Value::Number(0.5), "the opening angle θ of the tree, at most 1: a group of size l is approximated beyond the distance l / θ"),
    Key::new("alpha", Kind::NotNegative, Value::Number(0.0), "above 0: the relative opening criterion (GADGET): a group of mass M and size l is approximated where G M l² / d⁴ is below α times the last acceleration"),
    Key::new("images", Kind::Choice(&["nearest", "ewald"]), Value::Text(Cow::Borrowed("nearest")), "in a periodic box: nearest images only, or Ewald sums over all images on a neutralizing background, in a cube (Ewald 1921)"),
    Key::new("accuracy", Kind::Positive, Value::Number(FITTED), "with images = \"ewald\": the error of the force of a mass M, root mean square over the cube, 1e-10 or more; more than 1.5e-4 changes nothing, rounding on a device adds some 1e-5, and a tree the error of its groups [G M / side²]"),
    Key::new("multipoles", Kind::Choice(&["quadrupole", "monopole"]), Value::Text(Cow::Borrowed("quadrupole")), "the multipole order of far groups"),
    Key::new("hubble", Kind::NotNegative, Value::Number(0.0), "above 0: space expands, with Hubble's constant H₀ of today; positions are comoving and time is supercomoving (Martel & Shapiro 1998): velocities are a² dx/dT of the physical time T [1 / time]").shared(),
    Key::new("omega_matter", Kind::Positive, Value::Number(0.3), "where space expands: the density of matter today, of the critical one").shared(),
    Key::new("omega_lambda", Kind::NotNegative, Value::Number(0.7), "where space expands: that of the cosmological constant; what both lack of 1 is curvature").shared(),
    Key::new("redshift", Kind::NotNegative, Value::Number(49.0), "where space expands: the redshift z = 1 / a − 1 at the time 0").shared(),
];

/// `gravity`: a = G m r / (r² + ε²)^(3/2), or the spline of GADGET, which is exact beyond 2.8 ε
/// (PKDGRAV has the same spline, and calls half of its support ε). With softenings of particles the larger one of a pair counts, as in GADGET.
#[derive(Clone)]
pub struct Gravity(Settings, Option<Result<Arc<Expansion>, String>>);

/// The expansion of space by settings that have its keys; none where it does not expand.
///
/// # Errors
/// As [`Cosmology::new`] and [`Expansion::new`].
pub fn expansion(settings: &Settings) -> Result<Option<Expansion>, Error> {
    let [hubble, matter, lambda, redshift] = EXPANSION.map(|key| settings.number(key));
    if hubble <= 0.0 {
        return Ok(None);
    }
    Ok(Some(Expansion::new(Cosmology::new(hubble, matter, lambda)?, scale_factor(redshift))?))
}

/// The keys of the expansion of space.
const EXPANSION: [&str; 4] = ["hubble", "omega_matter", "omega_lambda", "redshift"];

impl Gravity {
    /// From checked settings.
    #[must_use]
    pub fn new(settings: &Settings) -> Self {
        Self(settings.clone(), expansion(settings).map(|all| all.map(Arc::new)).map_err(|why| why.to_string()).transpose())
    }
    /// The expansion of space, where it expands.
    fn expansion(&self) -> Option<&Arc<Expansion>> {
        self.1.as_ref()?.as_ref().ok()
    }
    /// The visit, where groups nearer than `core` must not be approximated.
    fn over(&self, core: f64) -> Over {
        let (theta, alpha, g) = (self.0.number("theta"), self.0.number("alpha"), self.0.number("g"));
        let opening = if alpha > 0.0 {
            Opening::Relative { alpha, g: g.abs(), theta }
        } else {
            Opening::Geometric { theta }
        };
        match self.0.text("over") {
            "pairs" => Over::Pairs,
            word => Over::Tree { opening, core, auto: word == "auto" },
        }
    }
    fn all_images(&self) -> bool {
        self.0.text("images") == "ewald"
    }
    /// The law between two and the waves of all images.
    fn split(&self) -> Split {
        Split::new(self.0.number("accuracy"))
    }
    /// Whether there is such a law in the box of a problem.
    fn fits(&self, problem: &Problem) -> Result<(), Error> {
        self.check_expansion()?;
        let accuracy = self.0.number("accuracy");
        if accuracy < LEAST {
            return Err(Error::Scene(format!(
                "gravity has an accuracy of {accuracy:e} for images = \"ewald\": sums in double precision reach {LEAST:e}; give that or more"
            )));
        }
        if self.all_images() {
            if self.0.text("kernel") == "spline" {
                return Err(Error::Scene(
                    "gravity with images = \"ewald\" is softened by kernel = \"plummer\" alone: leave out \"spline\"".to_owned(),
                ));
            }
            return ewald::fits(problem, self.0.number("softening"));
        }
        if self.0.text("over") == "tree" && problem.bounds.has(Side::Periodic) {
            let all = "images = \"ewald\" in a cube that is periodic on all sides, or ";
            let all = if self.is_individual() { "" } else { all };
            return Err(Error::Scene(format!(
                "gravity over = \"tree\" in a periodic box ({}) cannot use nearest images alone: their force jumps half a box \
                 away, within a group. Say {all}over = \"pairs\"",
                problem.bounds
            )));
        }
        Ok(())
    }
    /// Whether there is a law where space expands as it is set.
    fn check_expansion(&self) -> Result<(), Error> {
        let Some(expansion) = &self.1 else { return Ok(()) };
        if let Err(why) = expansion {
            return Err(Error::Setting { key: "hubble", why: format!("gravity where space expands: {why}") });
        }
        if !self.all_images() {
            let why = format!(
                "gravity has hubble = {}, an expanding space, and images = \"nearest\", which do not take the mean density off: set images = \"ewald\", in a \
                 periodic cube, or hubble = 0",
                self.0.number("hubble")
            );
            return Err(Error::Setting { key: "hubble", why });
        }
        if self.0.number("alpha") > 0.0 {
            let why = "gravity has alpha above 0 beside hubble: where space expands, the last acceleration has another factor; leave alpha out and choose theta"
                .to_owned();
            return Err(Error::Setting { key: "alpha", why });
        }
        Ok(())
    }
    /// Whether particles have softenings of their own.
    fn is_individual(&self) -> bool {
        self.0.flag("individual_softening")
    }
    /// The law with softenings of particles, whose larger one is that of a pair (as in GADGET).
    fn individual(&self) -> Law {
        let (g, largest) = (self.0.number("g"), self.0.number("softening"));
        let values = params(&self.0, &["g"]);
        let of = |me: &Particle, you: &Particle| own(me).max(own(you));
        if self.0.text("kernel") == "plummer" {
            let files = (crate::shader!("interactions/gravity_individual.wgsl"), None);
            let rule = move |me: &Particle, you: &Particle, r, _: &World| plummer(g * you.mass, of(me, you), r);
            // Over all pairs alone.
            let far = |_: &Particle, _: &Group, _, _: &World| DVec4::ZERO;
            return Law::attracting("gravity_individual", self.over(0.0), files, values, rule, far);
        }
        let quadrupole = self.0.text("multipoles") == "quadrupole";
        let distant = if quadrupole {
            crate::shader!("interactions/gravity_distant.wgsl")
        } else {
            // A group has no index to find a softening by.
            crate::shader!("interactions/gravity_distant_mass.wgsl")
        };
        let files = (crate::shader!("interactions/gravity_spline.wgsl"), Some(distant));
        let rule = move |me: &Particle, you: &Particle, r, _: &World| spline(g * you.mass, SUPPORT * of(me, you), r);
        let far = move |_: &Particle, you: &Group, r, _: &World| multipole(g, you, 0.0, r, quadrupole);
        let law = Law::attracting("gravity_spline", self.over(SUPPORT * largest), files, values, rule, far);
        Law { beside: vec![crate::shader!("interactions/gravity_softenings.wgsl")], ..law }
    }
    /// The law of far groups; none where they are evaluated as one particle.
    fn distant(&self, law: Source) -> Option<Source> {
        (self.0.text("multipoles") == "quadrupole").then_some(law)
    }
}

/// The support of the spline \[softenings\]: with it a potential in the middle is that of Plummer's law.
const SUPPORT: f64 = 2.8;

/// The column of softenings of particles.
pub(crate) const SOFTENING_LENGTH: &str = "softening_length";

/// The softening of a particle.
fn own(particle: &Particle) -> f64 {
    particle.scalar(SOFTENING_LENGTH).unwrap_or_default()
}

impl Component for Gravity {
    fn columns(&self) -> Vec<Column> {
        let softening = Column::new(SOFTENING_LENGTH, Element::Scalar, "length", "its own gravitational softening").required();
        if self.is_individual() { vec![softening] } else { Vec::new() }
    }
    fn check(&self, _: &Bounds) -> Result<(), Error> {
        self.check_expansion()?;
        if !self.is_individual() {
            return Ok(());
        }
        let refuse = |why: &str| Err(Error::Setting { key: "individual_softening", why: why.to_owned() });
        if self.all_images() {
            return refuse(
                "individual_softening beside images = \"ewald\", which is softened by one length: leave out either, or take nearest images over = \"pairs\"",
            );
        }
        if self.0.number("softening") <= 0.0 {
            return refuse("individual_softening with softening = 0: give the largest softening of a particle as `softening`");
        }
        if self.0.text("kernel") == "plummer" && self.0.text("over") != "pairs" {
            return refuse(
                "individual_softening over a tree with kernel = \"plummer\", by which a far group would need one softening: set kernel = \"spline\", which is \
                 Newton's law beyond 2.8 softenings, or over = \"pairs\"",
            );
        }
        Ok(())
    }
    fn laws(&self) -> Vec<Law> {
        if self.is_individual() {
            return vec![self.individual()];
        }
        let mut values = params(&self.0, &["g", "softening"]);
        let (g, softening) = (self.0.number("g"), self.0.number("softening"));
        let quadrupole = self.0.text("multipoles") == "quadrupole";
        vec![if self.all_images() {
            let split = Arc::new(self.split());
            let beyond = Arc::clone(&split);
            let files = if split.softens {
                let distant = self.distant(crate::shader!("interactions/gravity_ewald_distant.wgsl"));
                (crate::shader!("interactions/gravity_ewald.wgsl"), distant)
            } else {
                let vectors = split.vectors().into_iter().enumerate();
                values.extend(vectors.map(|(n, four)| (format!("taper_{n}"), Scalar::Vector4(four))));
                let distant = self.distant(crate::shader!("interactions/gravity_ewald_accurate_distant.wgsl"));
                (crate::shader!("interactions/gravity_ewald_accurate.wgsl"), distant)
            };
            let frequency = |world: &World| world.bounds.frequency().x;
            let (grows, constants) = ewald::growing(self.expansion());
            let (near, distant) = (self.expansion().cloned(), self.expansion().cloned());
            let rule = move |_: &Particle, you: &Particle, r, world: &World| {
                let g = ewald::grown(g, near.as_deref(), world);
                ewald::pair(&split, g * you.mass, softening, r, frequency(world))
            };
            let far = move |_: &Particle, you: &Group, r, world: &World| {
                let g = ewald::grown(g, distant.as_deref(), world);
                if quadrupole {
                    ewald::group(&beyond, g, you, softening, r, frequency(world))
                } else {
                    ewald::pair(&beyond, g * you.mass, softening, r, frequency(world))
                }
            };
            let law = Law::attracting("gravity_ewald", self.over(0.0), files, values, rule, far).of_all_images();
            Law { beside: vec![grows], constants, ..law }
        } else if self.0.text("kernel") == "spline" {
            let h = SUPPORT * softening;
            let files = (
                crate::shader!("interactions/gravity_spline.wgsl"),
                self.distant(crate::shader!("interactions/gravity_distant.wgsl")),
            );
            let rule = move |_: &Particle, you: &Particle, r, _: &World| spline(g * you.mass, h, r);
            // Beyond its support the spline is Newton's law.
            let far = move |_: &Particle, you: &Group, r, _: &World| multipole(g, you, 0.0, r, quadrupole);
            let law = Law::attracting("gravity_spline", self.over(h), files, values, rule, far);
            Law { beside: vec![crate::shader!("interactions/gravity_softening.wgsl")], ..law }
        } else {
            let files =
                (crate::shader!("interactions/gravity.wgsl"), self.distant(crate::shader!("interactions/gravity_distant.wgsl")));
            let rule = move |_: &Particle, you: &Particle, r, _: &World| plummer(g * you.mass, softening, r);
            let far = move |_: &Particle, you: &Group, r, _: &World| multipole(g, you, softening, r, quadrupole);
            Law::attracting("gravity", self.over(0.0), files, values, rule, far)
        }]
    }
    fn properties(&self) -> Properties {
        let limit = Largest {
            column: SOFTENING_LENGTH,
            value: self.0.number("softening"),
            why: "it is the key `softening` of the force, which must be as large",
        };
        let largest = if self.is_individual() { vec![limit] } else { Vec::new() };
        let dissipates = if self.1.is_some() { vec!["expansion"] } else { Vec::new() };
        let expands = self.expansion().map(|expansion| Expands {
            expansion: Arc::clone(expansion),
            density: expansion.cosmology.mean_density(self.0.number("g")),
        });
        let softening = Some(self.0.number("softening"));
        Properties { ignores_massless: true, largest, dissipates, expands, softening, ..Properties::default() }
    }
    fn stage(&self, stage: Stage, plan: &mut Plan, problem: &Problem) -> Result<(), Error> {
        let Stage::Evaluate { earlier } = stage else { return Ok(()) };
        self.fits(problem)?;
        evaluate(self.laws(), earlier, plan, problem)?;
        if self.all_images() {
            let [structure, images] = ewald::kernels(&self.split(), self.0.number("g"), self.expansion(), problem)?;
            let mine = structure.tables.iter().find(|(name, _)| name == "gravity_wave").map(|(_, words)| words);
            let first = plan.table("gravity_wave");
            if let (Some(mine), Some(first)) = (mine, first)
                && mine != first
            {
                return Err(Error::Scene(format!(
                    "a second gravity with images = \"ewald\" has an accuracy of {:e}, with {} waves, and the first has {}: give both the same accuracy",
                    self.0.number("accuracy"),
                    mine.len() / 4 - 1,
                    first.len() / 4 - 1
                )));
            }
            plan.push(&numbered("gravity structure", earlier), || Ok(structure))?;
            plan.push(&numbered("gravity images", earlier), || Ok(images))?;
        }
        Ok(())
    }
}

/// A far group: its mass at its centre, and its second moments about that (after McMillan & Aarseth 1993, softened).
fn multipole(g: f64, you: &Group, softening: f64, r: DVec3, quadrupole: bool) -> DVec4 {
    let point = plummer(g * you.mass, softening, r);
    if !quadrupole {
        return point;
    }
    let square = r.length_squared() + softening * softening;
    let (trace, q) = (you.moments.x_axis.x + you.moments.y_axis.y + you.moments.z_axis.z, you.moments * r);
    let (fifth, twist) = (square.powf(-2.5), r.dot(q));
    let acceleration = r * (7.5 * twist / square - 1.5 * trace) - 3.0 * q;
    point + g * (acceleration * fifth).extend(0.5 * trace * square.powf(-1.5) - 1.5 * twist * fifth)
}

/// Plummer (1911).
fn plummer(gm: f64, softening: f64, r: DVec3) -> DVec4 {
    let inverse = 1.0 / (r.length_squared() + softening * softening).sqrt();
    let potential = gm * inverse;
    (r * (potential * inverse * inverse)).extend(-potential)
}

/// The potential of a cubic spline of support h (Monaghan & Lattanzio 1985; Springel, Yoshida & White 2001, appendix A).
fn spline(gm: f64, h: f64, r: DVec3) -> DVec4 {
    let distance = r.length();
    if distance >= h {
        return (r * (gm / distance.powi(3))).extend(-gm / distance);
    }
    let u = distance / h;
    let (force, potential) = if u < 0.5 {
        (
            32.0 / 3.0 + u * u * (32.0 * u - 38.4),
            -2.8 + u * u * (16.0 / 3.0 + u * u * (6.4 * u - 9.6)),
        )
    } else {
        (
            64.0 / 3.0 + u * (-48.0 + u * (38.4 - 32.0 / 3.0 * u)) - 1.0 / (15.0 * u.powi(3)),
            -3.2 + 1.0 / (15.0 * u) + u * u * (32.0 / 3.0 + u * (-16.0 + u * (9.6 - 32.0 / 15.0 * u))),
        )
    };
    (r * (gm * force / h.powi(3))).extend(gm * potential / h)
}
