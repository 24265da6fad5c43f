//! Loops on the device: each iteration is dispatched indirectly, with arguments written by the previous one.
//!
//! Every iteration but the first has arguments of its own, zero before the loop begins. [`proceed`] runs at the end of an iteration,
//! dispatched like the rest of it, and sets the workgroups of the next one unless the flag is set. So the next iteration dispatches
//! nothing, nor does any later one. [`reset`] runs after the loop, and sets all arguments to zero again.

use std::sync::Arc;

use super::{Flag, Host, Kernel, Shader};
use crate::error::Error;

/// The workgroup counts of the dispatches of an iteration.
pub const WORKGROUPS: &str = "workgroups";
/// The arguments of the iterations that [`proceed`] writes.
pub const ARGUMENTS: &str = "arguments";
/// The number of completed iterations.
pub const ITERATIONS: &str = "iterations";
/// The arguments of the iterations 1, 3, 5 …
pub const ODD: &str = "odd";
/// The arguments of the iterations 2, 4, 6 …
pub const EVEN: &str = "even";

/// Sets the arguments of the next iteration, `words` words among those of `slots` iterations, unless a flag is set.
///
/// # Errors
/// When the shader does not compile.
pub fn proceed(flag: &Flag, words: u32, slots: u32) -> Result<Kernel, Error> {
    let own = flag.clone();
    let reference = move |host: &Host| {
        let mut iterations = host.writing::<u32>(ITERATIONS)?;
        let first = (iterations[0] / 2 * words) as usize;
        iterations[0] += 1;
        let flag = host.reading::<u32>(&own.field)?[own.word as usize];
        if flag == 0 {
            let workgroups = host.reading::<u32>(WORKGROUPS)?;
            host.writing::<u32>(ARGUMENTS)?[first..first + words as usize].copy_from_slice(&workgroups);
        }
        Ok(())
    };
    let shader = Shader::join(&[crate::shader!("repeat/proceed.wgsl")])?;
    let constants = vec![("WORD", f64::from(flag.word)), ("WORDS", f64::from(words))];
    let mut kernel = Kernel::new("proceed", shader, constants, 1, Arc::new(reference));
    kernel.passes[0].fields.push(("flag".into(), flag.field.clone()));
    let words = u64::from(words);
    kernel.sizes = vec![
        (flag.field.clone(), u64::from(flag.word) + 1),
        (WORKGROUPS.into(), words),
        (ARGUMENTS.into(), words * u64::from(slots)),
        (ITERATIONS.into(), 1),
    ];
    Ok(kernel)
}

/// Sets the arguments of all iterations to zero: `words` words of odd ones, and of even ones.
///
/// # Errors
/// When the shader does not compile.
pub fn reset(words: u32) -> Result<Kernel, Error> {
    let reference = |host: &Host| {
        host.writing::<u32>(ODD)?.fill(0);
        host.writing::<u32>(EVEN)?.fill(0);
        host.writing::<u32>(ITERATIONS)?.fill(0);
        Ok(())
    };
    let shader = Shader::join(&[crate::shader!("world.wgsl"), crate::shader!("repeat/reset.wgsl")])?;
    let constants = vec![("WORDS", f64::from(words))];
    let mut kernel = Kernel::new("reset", shader, constants, words, Arc::new(reference));
    kernel.sizes = vec![(ODD.into(), words.into()), (EVEN.into(), words.into()), (ITERATIONS.into(), 1)];
    Ok(kernel)
}
