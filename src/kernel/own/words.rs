//! The words of the history of pairs that a law names.

use naga::{Block, Expression, Function, Handle, Literal, Module, Statement};

/// The words that a law recalls or remembers.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Words {
    /// The highest that it names by a number.
    pub highest: Option<u32>,
    /// Whether it computes others.
    pub computed: bool,
}

/// The words that the functions of a module name.
pub fn words(module: &Module) -> Words {
    let mut words = Words::default();
    for (_, function) in module.functions.iter() {
        look(module, function, &function.body, &mut words);
    }
    words
}

fn look(module: &Module, function: &Function, block: &Block, words: &mut Words) {
    for statement in block {
        match statement {
            Statement::Block(inner) => look(module, function, inner, words),
            Statement::If { accept, reject, .. } => {
                look(module, function, accept, words);
                look(module, function, reject, words);
            }
            Statement::Switch { cases, .. } => cases.iter().for_each(|case| look(module, function, &case.body, words)),
            Statement::Loop { body, continuing, .. } => {
                look(module, function, body, words);
                look(module, function, continuing, words);
            }
            Statement::Call { function: called, arguments, .. } => {
                let name = module.functions[*called].name.as_deref();
                let word = arguments.get(1).filter(|_| matches!(name, Some("recall" | "remember")));
                match word.map(|word| number(module, function, *word)) {
                    Some(Some(number)) => words.highest = words.highest.max(Some(number)),
                    Some(None) => words.computed = true,
                    None => {}
                }
            }
            _ => {}
        }
    }
}

/// A whole number that is known before a shader runs.
fn number(module: &Module, function: &Function, expression: Handle<Expression>) -> Option<u32> {
    let known = match &function.expressions[expression] {
        Expression::Constant(constant) => &module.global_expressions[module.constants[*constant].init],
        other => other,
    };
    match known {
        Expression::Literal(Literal::U32(number)) => Some(*number),
        _ => None,
    }
}
