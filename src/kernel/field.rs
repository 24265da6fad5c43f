//! Fields: named arrays, one element per particle unless said otherwise. The name here is the name in WGSL.

use std::marker::PhantomData;

use glam::{DVec3, DVec4, Vec4};

/// Positions and masses: `xyz` position \[length\], `w` mass \[mass\].
pub const POSITION: Field<Vec4> = Field::new("position");
/// Velocities and the radii in pictures: `xyz` velocity \[length / time\], `w` radius \[length\].
pub const VELOCITY: Field<Vec4> = Field::new("velocity");
/// Accelerations and potential energies: `xyz` acceleration \[length / time²\]; `w` the particle's share of the potential energy, per unit mass
/// \[length² / time²\], so that the sum of mass × w over all particles is the potential energy (each of a pair holds half).
pub const ACCELERATION: Field<Vec4> = Field::new("acceleration");
/// The species of a particle, such as predator or prey: a number by which laws distinguish particles.
pub const SPECIES: Field<u32> = Field::new("species");
/// The life of a particle, as in [`Life::word`](crate::life::Life::word): 0 pending, 1 active, 2 removed. The field
/// exists if particles may be spawned or removed.
pub const LIFE: Field<u32> = Field::new("life");
/// The id of a particle. The field exists if rows are reused for other particles; otherwise ids equal rows.
pub const ID: Field<u32> = Field::new("id");
/// The target positions of kinematic particles, by id: `xyz` the position \[length\], `w` the time at which it is reached \[time\].
/// Particles move there at constant velocity, and then stay there; a target in the past is reached in the next step. At the start it is
/// their initial position. Write it with [`Simulation::write`](crate::simulation::Simulation::write). The field exists if a particle has
/// [`Hold::Target`](crate::motion::Hold::Target). (`target` is a reserved word of WGSL.)
pub const TARGET: Field<Vec4> = Field::new("kinematic_target");
/// The positions of fixed particles at the start, in the order of [`Problem::held`](super::Problem::held).
pub const HOME: Field<Vec4> = Field::new("home");
/// Failures that kernels detect, word by word; `u32::MAX` in the first five and the last six while there are none.
///
/// 0 and 1: after how many steps a particle is first seen not to be finite, and the lowest id of those; 2: the lowest id
/// of a particle with more neighbours than a search can visit; 3 and 4: after how many steps a runaway of speeds is
/// detected, and the lowest id of such particles. Then its criterion, with the bits of speeds as `f32`: 5: the maximum of the
/// current 16 steps; 6: that of the previous 16; 7: how many times in a row it has more than doubled. 8: the mark of a user's law
/// with loops that the driver has ended early; 9: that of one with loops without end; 10: the driver folds compensated sums; 11: the complement
/// of the highest word of a pair's history that a law names beyond its slots; 12 and 13: after how many steps a bond is first seen to be longer than its law admits, and the lowest
/// particle with one then. 14: the lowest id of a body that has grown beyond the range in which its collisions are searched.
pub const ALARM: Field<u32> = Field::new("alarm");
/// The words of the alarm.
pub const ALARM_WORDS: usize = 15;
/// The alarm without any failure.
pub const QUIET: [u32; ALARM_WORDS] = [
    u32::MAX,
    u32::MAX,
    u32::MAX,
    u32::MAX,
    u32::MAX,
    0,
    0,
    0,
    u32::MAX,
    u32::MAX,
    u32::MAX,
    u32::MAX,
    u32::MAX,
    u32::MAX,
    u32::MAX,
];
/// The constant of a shader that holds the mark of a user's law, by which an alarm names it.
pub const LAW: &str = "LAW";

/// A named array of `T`.
#[derive(Debug)]
pub struct Field<T> {
    /// Its name, in Rust and in WGSL.
    pub name: &'static str,
    element: PhantomData<fn() -> T>,
}

impl<T> Field<T> {
    /// Names a field.
    #[must_use]
    pub const fn new(name: &'static str) -> Self {
        Self { name, element: PhantomData }
    }
}

impl<T> Clone for Field<T> {
    fn clone(&self) -> Self {
        *self
    }
}
impl<T> Copy for Field<T> {}

/// An array as the host holds it: wide enough that every value of the device fits without rounding.
#[derive(Debug, Clone, PartialEq)]
pub enum Array {
    /// `array<vec4f>`
    Vec4(Vec<DVec4>),
    /// `array<vec4f>` with fourth numbers that are 0
    Vec3(Vec<DVec3>),
    /// `array<f32>`
    Float(Vec<f64>),
    /// `array<u32>`, atomic or not
    Uint(Vec<u32>),
}

impl Array {
    /// Number of elements.
    #[must_use]
    pub fn len(&self) -> usize {
        match self {
            Self::Vec4(a) => a.len(),
            Self::Vec3(a) => a.len(),
            Self::Float(a) => a.len(),
            Self::Uint(a) => a.len(),
        }
    }
    /// Whether it is empty.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
    /// The memory of its elements \[bytes\].
    #[must_use]
    pub fn bytes(&self) -> usize {
        match self {
            Self::Vec4(a) => size_of_val(&**a),
            Self::Vec3(a) => size_of_val(&**a),
            Self::Float(a) => size_of_val(&**a),
            Self::Uint(a) => size_of_val(&**a),
        }
    }
    /// The first element that does not fit single precision: NaN, infinite or too large.
    #[must_use]
    pub fn unfit(&self) -> Option<usize> {
        let fits = |x: &f64| x.abs() <= f64::from(f32::MAX);
        match self {
            Self::Vec4(a) => a.iter().position(|v| !v.to_array().iter().all(fits)),
            Self::Vec3(a) => a.iter().position(|v| !v.to_array().iter().all(fits)),
            Self::Float(a) => a.iter().position(|x| !fits(x)),
            Self::Uint(_) => None,
        }
    }
    /// Changes its length; new elements hold this value.
    pub fn resize(&mut self, len: usize, [x, y, z, w]: [f64; 4]) {
        match self {
            Self::Vec4(a) => a.resize(len, DVec4::new(x, y, z, w)),
            Self::Vec3(a) => a.resize(len, DVec3::new(x, y, z)),
            Self::Float(a) => a.resize(len, x),
            #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "declared as a whole number")]
            Self::Uint(a) => a.resize(len, x as u32),
        }
    }
    /// Appends an array of the same kind; does nothing for another kind.
    pub fn extend(&mut self, other: &Self) {
        match (self, other) {
            (Self::Vec4(a), Self::Vec4(b)) => a.extend_from_slice(b),
            (Self::Vec3(a), Self::Vec3(b)) => a.extend_from_slice(b),
            (Self::Float(a), Self::Float(b)) => a.extend_from_slice(b),
            (Self::Uint(a), Self::Uint(b)) => a.extend_from_slice(b),
            _ => {}
        }
    }
    /// Replaces elements from `first` on by those of an array of the same kind; those beyond the end are left out.
    pub fn replace(&mut self, first: usize, other: &Self) {
        match (self, other) {
            (Self::Vec4(a), Self::Vec4(b)) => a.iter_mut().skip(first).zip(b).for_each(|(a, b)| *a = *b),
            (Self::Vec3(a), Self::Vec3(b)) => a.iter_mut().skip(first).zip(b).for_each(|(a, b)| *a = *b),
            (Self::Float(a), Self::Float(b)) => a.iter_mut().skip(first).zip(b).for_each(|(a, b)| *a = *b),
            (Self::Uint(a), Self::Uint(b)) => a.iter_mut().skip(first).zip(b).for_each(|(a, b)| *a = *b),
            _ => {}
        }
    }
    /// Groups of `group` elements, in this order.
    #[must_use]
    pub fn picked(&self, order: &[usize], group: usize) -> Self {
        let places = order.iter().flat_map(|n| n * group..(n + 1) * group);
        match self {
            Self::Vec4(a) => Self::Vec4(places.map(|n| a[n]).collect()),
            Self::Vec3(a) => Self::Vec3(places.map(|n| a[n]).collect()),
            Self::Float(a) => Self::Float(places.map(|n| a[n]).collect()),
            Self::Uint(a) => Self::Uint(places.map(|n| a[n]).collect()),
        }
    }
    /// The bytes a device holds for it (f64 rounded to f32).
    #[must_use]
    pub fn to_bytes(&self) -> Vec<u8> {
        match self {
            Self::Vec4(a) => bytemuck::cast_slice(&a.iter().map(|v| v.as_vec4()).collect::<Vec<_>>()).to_vec(),
            Self::Vec3(a) => {
                bytemuck::cast_slice(&a.iter().map(|v| v.as_vec3().extend(0.0)).collect::<Vec<_>>()).to_vec()
            }
            Self::Float(a) => bytemuck::cast_slice(&a.iter().map(|x| narrow(*x)).collect::<Vec<_>>()).to_vec(),
            Self::Uint(a) => bytemuck::cast_slice(a).to_vec(),
        }
    }
    /// The array with these bytes, of the same kind as `self`.
    #[must_use]
    pub fn like(&self, bytes: &[u8]) -> Self {
        match self {
            Self::Vec4(_) => Vec4::array(words::<Vec4>(bytes).into_iter().map(Vec4::widen).collect()),
            Self::Vec3(_) => Self::Vec3(words::<Vec4>(bytes).into_iter().map(|v| v.as_dvec4().truncate()).collect()),
            Self::Float(_) => f32::array(words::<f32>(bytes).into_iter().map(f32::widen).collect()),
            Self::Uint(_) => Self::Uint(words(bytes)),
        }
    }
    /// An array of zeros of the same kind.
    #[must_use]
    pub fn zeros(&self, len: usize) -> Self {
        match self {
            Self::Vec4(_) => Self::Vec4(vec![DVec4::ZERO; len]),
            Self::Vec3(_) => Self::Vec3(vec![DVec3::ZERO; len]),
            Self::Float(_) => Self::Float(vec![0.0; len]),
            Self::Uint(_) => Self::Uint(vec![0; len]),
        }
    }
}

#[expect(clippy::cast_possible_truncation, reason = "rounding to f32 is what the device does")]
fn narrow(x: f64) -> f32 {
    x as f32
}

fn words<T: bytemuck::AnyBitPattern>(bytes: &[u8]) -> Vec<T> {
    bytes.chunks_exact(size_of::<T>()).map(bytemuck::pod_read_unaligned).collect()
}

/// The type of a field's elements, and of their reference.
pub trait Element: bytemuck::Pod + Send + Sync {
    /// The same in f64.
    type Reference: Copy + Send + Sync;
    /// Without loss.
    fn widen(self) -> Self::Reference;
    /// Rounded to the type of the device.
    fn narrow(reference: Self::Reference) -> Self;
    /// Wraps a vector of references.
    fn array(values: Vec<Self::Reference>) -> Array;
    /// The vector inside, if the array is of this kind.
    fn view(array: &Array) -> Option<&Vec<Self::Reference>>;
    /// The same, to write.
    fn view_mut(array: &mut Array) -> Option<&mut Vec<Self::Reference>>;
}

macro_rules! element {
    ($device:ty, $reference:ty, $variant:ident, $widen:expr, $narrow:expr) => {
        impl Element for $device {
            type Reference = $reference;
            fn widen(self) -> $reference {
                $widen(self)
            }
            fn narrow(reference: $reference) -> Self {
                $narrow(reference)
            }
            fn array(values: Vec<$reference>) -> Array {
                Array::$variant(values)
            }
            fn view(array: &Array) -> Option<&Vec<$reference>> {
                if let Array::$variant(values) = array { Some(values) } else { None }
            }
            fn view_mut(array: &mut Array) -> Option<&mut Vec<$reference>> {
                if let Array::$variant(values) = array { Some(values) } else { None }
            }
        }
    };
}
element!(Vec4, DVec4, Vec4, |v: Vec4| v.as_dvec4(), |v: DVec4| v.as_vec4());
element!(f32, f64, Float, f64::from, narrow);
element!(u32, u32, Uint, |x| x, |x| x);
