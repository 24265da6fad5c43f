//! Particles that a surface or a line stands for.

use glam::DVec4;

use super::frame::{Frame, PROJECTED, VEIL};
use super::scenery::Facets;
use crate::error::Error;
use crate::kernel::{Host, Kernel, Threads};

/// The kernel.
pub fn kernel(frame: &Frame, facets: &Facets) -> Result<Kernel, Error> {
    let pass = frame.pass(&[crate::shader!("render/hide.wgsl")], Threads::new(frame.count), 1)?;
    let reference = |host: &Host| {
        let veil = host.read(VEIL)?;
        for (p, _) in host.write(PROJECTED)?.iter_mut().zip(&veil[..]).filter(|(_, veil)| **veil == 1) {
            *p = DVec4::new(0.0, 0.0, 0.0, -1.0);
        }
        Ok(())
    };
    Ok(facets.bind(frame.kernel("hide", vec![pass], reference), frame))
}
