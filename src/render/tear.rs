//! Which facets are torn.

use super::frame::{Frame, NONE, SLOT, TORN};
use super::scenery::{Facets, LINK};
use crate::error::Error;
use crate::kernel::{Host, Kernel, Threads};
use crate::links::{Half, WORDS};

/// The kernel.
pub fn kernel(frame: &Frame, facets: &Facets) -> Result<Kernel, Error> {
    let pass = frame.pass(&[crate::shader!("render/tear.wgsl")], Threads::new(frame.facets), 3)?;
    let reference = |host: &Host| {
        let (slot, link) = (host.read(SLOT)?, host.reading::<u32>(LINK)?);
        let broken = |slot: &u32| {
            let at = *slot as usize * WORDS;
            *slot != NONE && link.get(at..at + WORDS).is_some_and(|words| Half::new(words).is_broken())
        };
        for (torn, slots) in host.write(TORN)?.iter_mut().zip(slot.chunks_exact(3)) {
            *torn = u32::from(slots.iter().any(broken));
        }
        Ok(())
    };
    Ok(facets.bind(frame.kernel("tear", vec![pass], reference), frame))
}
