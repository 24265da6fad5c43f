//! Reflection of a shader by naga: bindings, strides of elements, size of a workgroup.
//! It is the only code that uses binding numbers, and it reads them from the WGSL.

use std::collections::BTreeMap;

use naga::valid::{GlobalUse, ModuleInfo};
use naga::{AddressSpace, Expression, Literal, Module, StorageAccess, TypeInner};

use super::Array;
use super::pack::{Member, Packed};
use super::unused_word::UNUSED_WORD;

/// The access of a shader to a binding.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Access {
    /// `var<uniform>`
    Uniform,
    /// `var<storage>`
    Read,
    /// `var<storage, read_write>`
    Write,
}

/// A binding: its name and its numbers.
#[derive(Debug, Clone, PartialEq)]
pub struct Binding {
    /// The field's name.
    pub name: String,
    /// `@group`
    pub group: u32,
    /// `@binding`
    pub binding: u32,
    /// Its access.
    pub access: Access,
    /// Bytes of one element of an array, or of the whole if it is not an array.
    pub stride: u64,
    /// Whether it is a runtime-sized array.
    pub array: bool,
    /// Whether its numbers are `f32`; otherwise they are `u32`, atomic or not.
    pub float: bool,
    /// The members of a struct or of the elements of an array, without the unused word.
    pub packed: Packed,
    /// Vectors or numbers in one element: those of a struct of nothing but `vec4f`, or of nothing but `f32`; else 1.
    pub parts: usize,
}

/// The interface of a shader.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Reflection {
    /// The entry point.
    pub entry: String,
    /// Invocations in a workgroup, all dimensions multiplied.
    pub workgroup: u32,
    /// Bytes of workgroup memory.
    pub workgroup_bytes: u64,
    /// Its bindings.
    pub bindings: Vec<Binding>,
    /// Its `override`s, with their defaults, if any.
    pub overrides: BTreeMap<String, Option<f64>>,
    /// Its integer `const`s.
    pub constants: BTreeMap<String, u32>,
    /// Whether it reads `world.time`.
    pub reads_time: bool,
}

impl Binding {
    /// An array of its kind on the host, with `len` zeros.
    #[must_use]
    pub fn zeros(&self, len: usize) -> Array {
        let parts = self.parts.max(1) as u64;
        let (kind, words) = match (self.float, self.stride / parts) {
            (true, 16) => (Array::Vec4(Vec::new()), self.parts),
            (true, 4) => (Array::Float(Vec::new()), self.parts),
            _ => (Array::Uint(Vec::new()), usize::try_from(self.stride / 4).unwrap_or(1)),
        };
        kind.zeros(len * words)
    }
}

impl Reflection {
    /// Reflects a module, which must have one entry point. Variables that the entry point does not use are not bound.
    #[must_use]
    pub fn of(module: &Module, info: &ModuleInfo) -> Self {
        let entry = module.entry_points.first();
        let used = |handle| entry.is_some() && info.get_entry_point(0)[handle] != GlobalUse::empty();
        let variables = module.global_variables.iter().filter(|(handle, _)| used(*handle));
        Self {
            entry: entry.map(|e| e.name.clone()).unwrap_or_default(),
            workgroup: entry.map_or(1, |e| e.workgroup_size.iter().product()),
            workgroup_bytes: workgroup_bytes(module),
            bindings: variables.filter_map(|(_, v)| binding(module, v)).collect(),
            overrides: module.overrides.iter().filter_map(|(_, o)| default(module, o)).collect(),
            constants: module.constants.iter().filter_map(|(_, c)| constant(module, c)).collect(),
            reads_time: reads(module, "world", "time"),
        }
    }
    /// The binding of a name.
    #[must_use]
    pub fn binding(&self, name: &str) -> Option<&Binding> {
        self.bindings.iter().find(|b| b.name == name)
    }
    /// Those of some constants for which it has an `override`.
    #[must_use]
    pub fn known(&self, constants: &[(&'static str, f64)]) -> Vec<(&'static str, f64)> {
        constants.iter().filter(|(name, _)| self.overrides.contains_key(*name)).copied().collect()
    }
    /// An integer `const`, or 1.
    #[must_use]
    pub fn constant(&self, name: &str) -> u32 {
        self.constants.get(name).copied().unwrap_or(1)
    }
}

fn default(module: &Module, item: &naga::Override) -> Option<(String, Option<f64>)> {
    let value = item.init.and_then(|init| match module.global_expressions[init] {
        Expression::Literal(Literal::F32(x)) => Some(f64::from(x)),
        Expression::Literal(Literal::U32(n)) => Some(f64::from(n)),
        Expression::Literal(Literal::Bool(b)) => Some(f64::from(u8::from(b))),
        _ => None,
    });
    Some((item.name.clone()?, value))
}

/// Whether any function reads this member of this variable.
fn reads(module: &Module, variable: &str, member: &str) -> bool {
    let functions = module.functions.iter().map(|(_, f)| f).chain(module.entry_points.iter().map(|e| &e.function));
    functions.flat_map(|f| f.expressions.iter().map(move |(_, e)| (f, e))).any(|(function, expression)| {
        let Expression::AccessIndex { base, index } = *expression else { return false };
        let Expression::GlobalVariable(global) = function.expressions[base] else { return false };
        let global = &module.global_variables[global];
        let TypeInner::Struct { members, .. } = &module.types[global.ty].inner else { return false };
        let name = members.get(index as usize).and_then(|m| m.name.as_deref());
        global.name.as_deref() == Some(variable) && name == Some(member)
    })
}

fn workgroup_bytes(module: &Module) -> u64 {
    let shared = module.global_variables.iter().filter(|(_, v)| v.space == AddressSpace::WorkGroup);
    shared.map(|(_, v)| u64::from(module.types[v.ty].inner.size(module.to_ctx()))).sum()
}

fn constant(module: &Module, constant: &naga::Constant) -> Option<(String, u32)> {
    let name = constant.name.clone()?;
    match module.global_expressions[constant.init] {
        Expression::Literal(Literal::U32(value)) => Some((name, value)),
        _ => None,
    }
}

fn binding(module: &Module, variable: &naga::GlobalVariable) -> Option<Binding> {
    let place = variable.binding?;
    let access = match variable.space {
        AddressSpace::Uniform => Access::Uniform,
        AddressSpace::Storage { access } if access.contains(StorageAccess::STORE) => Access::Write,
        AddressSpace::Storage { .. } => Access::Read,
        _ => return None,
    };
    let inner = &module.types[variable.ty].inner;
    let (stride, array) = match inner {
        TypeInner::Array { stride, size: naga::ArraySize::Dynamic, .. } => (u64::from(*stride), true),
        other => (u64::from(other.size(module.to_ctx())), false),
    };
    let element = match inner {
        TypeInner::Array { base, .. } => &module.types[*base].inner,
        other => other,
    };
    let same = if array { alike(module, element) } else { None };
    let float = same.is_some() || element.scalar_kind() == Some(naga::ScalarKind::Float);
    let parts = same.unwrap_or(1);
    let packed = match element {
        TypeInner::Struct { members, span } => {
            Packed { size: *span as usize, members: members.iter().filter_map(|m| member(module, m)).collect() }
        }
        _ => Packed::default(),
    };
    let name = variable.name.clone()?;
    Some(Binding { name, group: place.group, binding: place.binding, access, stride, array, float, packed, parts })
}

/// The number of `vec4f`, or of `f32`, in a struct that has members of only one of these types.
fn alike(module: &Module, element: &TypeInner) -> Option<usize> {
    let TypeInner::Struct { members, .. } = element else { return None };
    let all = |wanted: &dyn Fn(&TypeInner) -> bool| members.iter().all(|m| wanted(&module.types[m.ty].inner));
    let float = |scalar: &naga::Scalar| scalar.kind == naga::ScalarKind::Float;
    let vectors = |inner: &TypeInner| matches!(inner, TypeInner::Vector { size: naga::VectorSize::Quad, scalar } if float(scalar));
    let numbers = |inner: &TypeInner| matches!(inner, TypeInner::Scalar(scalar) if float(scalar));
    (all(&vectors) || all(&numbers)).then_some(members.len())
}

fn member(module: &Module, member: &naga::StructMember) -> Option<Member> {
    let (components, kind) = match module.types[member.ty].inner {
        TypeInner::Scalar(s) => (1, s.kind),
        TypeInner::Vector { size, scalar } => (size as usize, scalar.kind),
        _ => (0, naga::ScalarKind::Bool),
    };
    let name = member.name.clone().filter(|name| name != UNUSED_WORD)?;
    Some(Member {
        name,
        offset: member.offset as usize,
        components,
        float: kind == naga::ScalarKind::Float,
        signed: kind == naga::ScalarKind::Sint,
    })
}
