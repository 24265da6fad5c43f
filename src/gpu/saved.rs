//! Copies of fields on the device, from which a batch of steps is repeated.

use std::collections::BTreeMap;

use super::buffers::{Buffers, missing};
use super::fault;
use super::submit::Queue;
use crate::error::Error;

/// Copies by the names of their fields.
#[derive(Default)]
pub struct Saved(BTreeMap<String, wgpu::Buffer>);

impl Saved {
    /// Copies fields as they are after all submitted work, and replaces earlier copies.
    pub fn save(
        &mut self,
        device: &wgpu::Device,
        queue: &mut Queue,
        buffers: &Buffers,
        fields: &[String],
    ) -> Result<(), Error> {
        self.0.retain(|name, _| fields.contains(name));
        for name in fields {
            let size = buffers.get(name).ok_or_else(|| missing(name))?.size();
            if self.0.get(name).is_some_and(|copy| copy.size() == size) {
                continue;
            }
            let usage = wgpu::BufferUsages::COPY_SRC | wgpu::BufferUsages::COPY_DST;
            let descriptor = wgpu::BufferDescriptor { label: Some("saved"), size, usage, mapped_at_creation: false };
            match fault::scoped(device, || device.create_buffer(&descriptor)) {
                Ok(copy) => self.0.insert(name.clone(), copy),
                Err(why) => {
                    // An incomplete set of copies is useless, and occupies memory.
                    self.0.clear();
                    return Err(why);
                }
            };
        }
        self.copy(device, queue, buffers, |field, copy| (field, copy))
    }
    /// Restores the copies.
    pub fn restore(&self, device: &wgpu::Device, queue: &mut Queue, buffers: &Buffers) -> Result<(), Error> {
        self.copy(device, queue, buffers, |field, copy| (copy, field))
    }
    /// Copies between fields and their copies, in the direction given by `way`: from the first to the second.
    fn copy(
        &self,
        device: &wgpu::Device,
        queue: &mut Queue,
        buffers: &Buffers,
        way: impl for<'a> Fn(&'a wgpu::Buffer, &'a wgpu::Buffer) -> (&'a wgpu::Buffer, &'a wgpu::Buffer),
    ) -> Result<(), Error> {
        let commands = fault::scoped(device, || {
            let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
            for (name, copy) in &self.0 {
                let Some(field) = buffers.get(name) else { continue };
                let (from, to) = way(field, copy);
                encoder.copy_buffer_to_buffer(from, 0, to, 0, copy.size().min(field.size()));
            }
            encoder.finish()
        })?;
        queue.submit_commands(commands).map(drop)
    }
}
