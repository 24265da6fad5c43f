//! The dispatches that draw a picture on a device, by subject.

mod fluid;
mod particles;
mod surfaces;
mod tones;

pub use fluid::fluid;
pub use particles::{absent, color, histogram, lights, prepare};
pub use surfaces::{hide, surfaces};
pub use tones::tones;

use super::Exposure;
use super::frame::Frame;
use crate::error::Error;
use crate::kernel::{Kernel, Pass, Scalar, Shader, Source, Threads};

impl Frame {
    /// A dispatch of files joined with `world.wgsl` and `frame.wgsl`; `each` is about what one invocation does.
    pub(super) fn pass(&self, files: &[Source], threads: Threads, each: u64) -> Result<Pass, Error> {
        let mut all = vec![crate::shader!("world.wgsl"), crate::shader!("render/frame.wgsl")];
        all.extend_from_slice(files);
        let shader = Shader::join(&all)?;
        let packed = shader.reflection().binding("frame").map(|b| b.packed.pack("frame", &self.values()));
        let uniforms = packed.transpose()?.map(|bytes| ("frame", bytes)).into_iter().collect();
        let work = u64::from(threads.count) * u64::from(threads.layers) * each;
        Ok(Pass { uniforms, threads, work, ..Pass::new(shader, threads.count) })
    }
    /// Passes under a name. They have no reference: a machine without a device draws by [`super::plain`].
    pub(super) fn kernel(&self, name: &str, passes: Vec<Pass>) -> Kernel {
        let sizes = self.sizes().into_iter().map(|(name, elements)| (name.into(), elements)).collect();
        Kernel { name: name.to_owned(), passes, reference: None, sizes, scratch: Vec::new(), tables: Vec::new() }
    }
    /// A kernel of one dispatch of one layer.
    pub(super) fn simple(&self, name: &str, files: &[Source], count: u32, each: u64) -> Result<Kernel, Error> {
        Ok(self.kernel(name, vec![self.pass(files, Threads::new(count), each)?]))
    }
}

/// Fills the uniform block `exposure` of a pass, where it has one.
pub fn expose(pass: &mut Pass, frame: &Frame, exposure: Exposure) -> Result<(), Error> {
    if let Some(binding) = pass.shader.reflection().binding("exposure") {
        let values = [("knee", exposure.knee), ("slope", exposure.slope()), ("body", exposure.body(frame))];
        let named = |name: &str| binding.packed.members.iter().any(|member| member.name == name);
        let values: Vec<_> = values.into_iter().filter(|(name, _)| named(name)).collect();
        let values: Vec<_> = values.into_iter().map(|(name, x)| (name, Scalar::Float(x))).collect();
        pass.uniforms.push(("exposure", binding.packed.pack("exposure", &values)?));
    }
    Ok(())
}
