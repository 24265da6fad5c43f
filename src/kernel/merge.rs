//! Shaders merged into one that runs them one after another in each invocation. Fields are bound once, whichever of them use it; uniform
//! blocks are kept apart; constants have the values of their passes.

use naga::{
    AddressSpace, Arena, ArraySize, Block, BuiltIn, Constant, EntryPoint, Expression, Function, FunctionArgument,
    FunctionResult, GlobalVariable, Handle, Literal, Module, Override, ResourceBinding, Scalar, ShaderStage, Span,
    Statement, Type, TypeInner, VectorSize,
};

use super::Pass;

/// What the entry points of kernels may ask for.
const ARGUMENTS: [BuiltIn; 3] = [BuiltIn::WorkGroupId, BuiltIn::NumWorkGroups, BuiltIn::LocalInvocationIndex];

/// The names of the uniform blocks that passes give contents, in order.
const BLOCKS: [&str; 8] = ["block_0", "block_1", "block_2", "block_3", "block_4", "block_5", "block_6", "block_7"];

/// A shader that is being merged.
pub struct Merged {
    module: Module,
    /// The entry points so far, as functions, with the place in [`ARGUMENTS`] of each of their arguments.
    calls: Vec<(Handle<Function>, Vec<usize>)>,
    uniforms: Vec<(&'static str, Vec<u8>)>,
}

/// The places in the merged module of what a module holds.
struct Places {
    types: Vec<Handle<Type>>,
    expressions: Vec<Handle<Expression>>,
    constants: Vec<Option<Handle<Constant>>>,
    overrides: Vec<Handle<Constant>>,
    variables: Vec<Handle<GlobalVariable>>,
    functions: Vec<Handle<Function>>,
}

impl Merged {
    pub fn new() -> Self {
        Self { module: Module::default(), calls: Vec::new(), uniforms: Vec::new() }
    }
    /// The contents of all uniform blocks.
    pub fn take_uniforms(&mut self) -> Vec<(&'static str, Vec<u8>)> {
        std::mem::take(&mut self.uniforms)
    }
    /// The module; its entry point calls those of all passes in order.
    pub fn module(self, workgroup: u32) -> Module {
        let Self { mut module, calls, .. } = self;
        let mut function = Function::default();
        let scalar = module.types.insert(inner(TypeInner::Scalar(Scalar::U32)), Span::UNDEFINED);
        let vector = TypeInner::Vector { size: VectorSize::Tri, scalar: Scalar::U32 };
        let vector = module.types.insert(inner(vector), Span::UNDEFINED);
        let mut given = Vec::new();
        for (place, (builtin, ty)) in (0..).zip(ARGUMENTS.into_iter().zip([vector, vector, scalar])) {
            let binding = Some(naga::Binding::BuiltIn(builtin));
            function.arguments.push(FunctionArgument { name: None, ty, binding });
            given.push(function.expressions.append(Expression::FunctionArgument(place), Span::UNDEFINED));
        }
        for (callee, wanted) in calls {
            let arguments = wanted.into_iter().map(|place| given[place]).collect();
            function.body.push(Statement::Call { function: callee, arguments, result: None }, Span::UNDEFINED);
        }
        function.body.push(Statement::Return { value: None }, Span::UNDEFINED);
        module.entry_points.push(EntryPoint {
            name: "fused".to_owned(),
            stage: ShaderStage::Compute,
            early_depth_test: None,
            workgroup_size: [workgroup, 1, 1],
            workgroup_size_overrides: None,
            function,
            mesh_info: None,
            task_payload: None,
            incoming_ray_payload: None,
        });
        module
    }
    /// Adds the shader of a pass, to run after those before it; `None` where it has something that no kernel of particles has.
    pub fn add(&mut self, pass: &Pass) -> Option<()> {
        let from = pass.shader.module();
        let [entry] = from.entry_points.as_slice() else { return None };
        if entry.workgroup_size_overrides.is_some() || !from.special_types.predeclared_types.is_empty() {
            return None;
        }
        let mut places = Places {
            types: Vec::new(),
            expressions: Vec::new(),
            constants: vec![None; from.constants.len()],
            overrides: Vec::new(),
            variables: Vec::new(),
            functions: Vec::new(),
        };
        for (_, ty) in from.types.iter() {
            let ty = places.moved_type(ty)?;
            places.types.push(self.module.types.insert(ty, Span::UNDEFINED));
        }
        for (_, item) in from.overrides.iter() {
            let literal = value(pass, from, item)?;
            let init = self.module.global_expressions.append(Expression::Literal(literal), Span::UNDEFINED);
            let constant = Constant { name: item.name.clone(), ty: places.types[item.ty.index()], init };
            places.overrides.push(self.module.constants.append(constant, Span::UNDEFINED));
        }
        for (_, expression) in from.global_expressions.iter() {
            let moved = self.moved_global(from, &mut places, expression)?;
            places.expressions.push(self.module.global_expressions.append(moved, Span::UNDEFINED));
        }
        for (constant, _) in from.constants.iter() {
            self.constant(from, &mut places, constant)?;
        }
        for (_, variable) in from.global_variables.iter() {
            let moved = self.variable(pass, &places, variable)?;
            places.variables.push(moved);
        }
        for (_, function) in from.functions.iter() {
            let moved = places.moved_function(function)?;
            places.functions.push(self.module.functions.append(moved, Span::UNDEFINED));
        }
        let mut main = places.moved_function(&entry.function)?;
        main.name = Some(entry.name.clone());
        let mut wanted = Vec::new();
        for argument in &mut main.arguments {
            let Some(naga::Binding::BuiltIn(builtin)) = argument.binding.take() else { return None };
            wanted.push(ARGUMENTS.iter().position(|known| *known == builtin)?);
        }
        self.calls.push((self.module.functions.append(main, Span::UNDEFINED), wanted));
        Some(())
    }

    /// A constant, after the expression that it is.
    fn constant(&mut self, from: &Module, places: &mut Places, handle: Handle<Constant>) -> Option<Handle<Constant>> {
        if let Some(known) = places.constants[handle.index()] {
            return Some(known);
        }
        let constant = &from.constants[handle];
        let init = *places.expressions.get(constant.init.index())?;
        let constant = Constant { name: constant.name.clone(), ty: places.types[constant.ty.index()], init };
        let moved = self.module.constants.append(constant, Span::UNDEFINED);
        places.constants[handle.index()] = Some(moved);
        Some(moved)
    }
    fn moved_global(&mut self, from: &Module, places: &mut Places, expression: &Expression) -> Option<Expression> {
        let at = |places: &Places, handle: Handle<Expression>| places.expressions.get(handle.index()).copied();
        Some(match expression {
            Expression::Literal(literal) => Expression::Literal(*literal),
            Expression::Constant(handle) => Expression::Constant(self.constant(from, places, *handle)?),
            Expression::Override(handle) => Expression::Constant(places.overrides[handle.index()]),
            Expression::ZeroValue(ty) => Expression::ZeroValue(places.types[ty.index()]),
            Expression::Splat { size, value } => Expression::Splat { size: *size, value: at(places, *value)? },
            Expression::Compose { ty, components } => {
                let components: Option<Vec<_>> = components.iter().map(|part| at(places, *part)).collect();
                Expression::Compose { ty: places.types[ty.index()], components: components? }
            }
            _ => return None,
        })
    }
    /// A variable: a field that is bound already stays the one that it is, and can be written if any shader writes it.
    fn variable(&mut self, pass: &Pass, places: &Places, variable: &GlobalVariable) -> Option<Handle<GlobalVariable>> {
        let mut moved = GlobalVariable {
            ty: places.types[variable.ty.index()],
            init: variable.init.map(|init| places.expressions[init.index()]),
            ..variable.clone()
        };
        let Some(binding) = &variable.binding else {
            return Some(self.module.global_variables.append(moved, Span::UNDEFINED));
        };
        let name = variable.name.as_deref()?;
        let contents = pass.uniforms.iter().find(|(known, _)| *known == name);
        let name = match contents {
            Some((_, bytes)) => {
                let own = *BLOCKS.get(self.uniforms.len())?;
                self.uniforms.push((own, bytes.clone()));
                own
            }
            None => pass.field(name),
        };
        let known =
            self.module.global_variables.iter().find(|(_, v)| v.name.as_deref() == Some(name) && v.binding.is_some());
        if let Some((handle, known)) = known.map(|(handle, known)| (handle, known.clone())) {
            let space = match (known.space, moved.space) {
                (AddressSpace::Storage { access }, AddressSpace::Storage { access: other }) => {
                    AddressSpace::Storage { access: access | other }
                }
                (one, other) if one == other => one,
                _ => return None,
            };
            if known.ty != moved.ty {
                return None;
            }
            self.module.global_variables[handle].space = space;
            return Some(handle);
        }
        let free = self.module.global_variables.iter().filter_map(|(_, v)| v.binding.as_ref());
        let free = free.filter(|known| known.group == binding.group).count();
        moved.binding = Some(ResourceBinding { group: binding.group, binding: u32::try_from(free).ok()? });
        moved.name = Some(name.to_owned());
        Some(self.module.global_variables.append(moved, Span::UNDEFINED))
    }
}

impl Places {
    fn moved_type(&self, ty: &Type) -> Option<Type> {
        let at = |handle: &Handle<Type>| self.types.get(handle.index()).copied();
        let inner = match &ty.inner {
            TypeInner::Scalar(_) | TypeInner::Vector { .. } | TypeInner::Matrix { .. } | TypeInner::Atomic(_) => {
                ty.inner.clone()
            }
            TypeInner::Pointer { base, space } => TypeInner::Pointer { base: at(base)?, space: *space },
            TypeInner::Array { base, size, stride } if !matches!(size, ArraySize::Pending(_)) => {
                TypeInner::Array { base: at(base)?, size: *size, stride: *stride }
            }
            TypeInner::Struct { members, span } => {
                let mut members = members.clone();
                for member in &mut members {
                    member.ty = at(&member.ty)?;
                }
                TypeInner::Struct { members, span: *span }
            }
            _ => return None,
        };
        // An alias is what it stands for.
        let name = ty.name.clone().filter(|_| matches!(inner, TypeInner::Struct { .. }));
        Some(Type { name, inner })
    }
    /// A function: its own expressions keep their handles.
    fn moved_function(&self, function: &Function) -> Option<Function> {
        let mut moved = Function { diagnostic_filter_leaf: None, ..function.clone() };
        moved.arguments.iter_mut().for_each(|argument| argument.ty = self.types[argument.ty.index()]);
        moved.result = moved.result.map(|result| FunctionResult { ty: self.types[result.ty.index()], ..result });
        for (_, local) in moved.local_variables.iter_mut() {
            local.ty = self.types[local.ty.index()];
        }
        moved.expressions = Arena::new();
        for (handle, expression) in function.expressions.iter() {
            let expression = self.moved_local(expression.clone())?;
            moved.expressions.append(expression, function.expressions.get_span(handle));
        }
        self.move_calls(&mut moved.body);
        Some(moved)
    }
    fn moved_local(&self, mut expression: Expression) -> Option<Expression> {
        match &mut expression {
            Expression::Constant(handle) => *handle = self.constants[handle.index()]?,
            Expression::Override(handle) => expression = Expression::Constant(self.overrides[handle.index()]),
            Expression::ZeroValue(ty)
            | Expression::Compose { ty, .. }
            | Expression::AtomicResult { ty, .. }
            | Expression::WorkGroupUniformLoadResult { ty }
            | Expression::SubgroupOperationResult { ty } => *ty = self.types[ty.index()],
            Expression::GlobalVariable(handle) => *handle = self.variables[handle.index()],
            Expression::CallResult(function) => *function = self.functions[function.index()],
            Expression::RayQueryVertexPositions { .. }
            | Expression::RayQueryProceedResult
            | Expression::RayQueryGetIntersection { .. }
            | Expression::CooperativeLoad { .. }
            | Expression::CooperativeMultiplyAdd { .. } => return None,
            _ => {}
        }
        Some(expression)
    }
    fn move_calls(&self, block: &mut Block) {
        for statement in block.iter_mut() {
            match statement {
                Statement::Call { function, .. } => *function = self.functions[function.index()],
                Statement::Block(body) => self.move_calls(body),
                Statement::If { accept, reject, .. } => {
                    self.move_calls(accept);
                    self.move_calls(reject);
                }
                Statement::Switch { cases, .. } => cases.iter_mut().for_each(|case| self.move_calls(&mut case.body)),
                Statement::Loop { body, continuing, .. } => {
                    self.move_calls(body);
                    self.move_calls(continuing);
                }
                _ => {}
            }
        }
    }
}

fn inner(inner: TypeInner) -> Type {
    Type { name: None, inner }
}

/// The value of an `override` in a pass.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "as the device holds it")]
fn value(pass: &Pass, module: &Module, item: &Override) -> Option<Literal> {
    let given =
        pass.constants.iter().rev().find(|(name, _)| item.name.as_deref() == Some(name)).map(|(_, value)| *value);
    match (given, &module.types[item.ty].inner) {
        (Some(x), TypeInner::Scalar(Scalar::F32)) => Some(Literal::F32(x as f32)),
        (Some(x), TypeInner::Scalar(Scalar::U32)) => Some(Literal::U32(x as u32)),
        (Some(x), TypeInner::Scalar(Scalar::I32)) => Some(Literal::I32(x as i32)),
        (Some(x), TypeInner::Scalar(Scalar::BOOL)) => Some(Literal::Bool(x != 0.0)),
        (Some(_), _) => None,
        (None, _) => match module.global_expressions[item.init?] {
            Expression::Literal(literal) => Some(literal),
            _ => None,
        },
    }
}
