//! Fields as buffers, by name.

use std::collections::{BTreeMap, BTreeSet};

use super::adapter::bindable;
use super::fault;
use crate::error::Error;

pub struct Buffers {
    device: wgpu::Device,
    count: u32,
    padding: u64,
    /// The fields that hold indirect arguments.
    indirect: BTreeSet<String>,
    named: BTreeMap<String, (wgpu::Buffer, u64)>,
}

impl Buffers {
    pub fn new(device: wgpu::Device, count: u32) -> Self {
        Self { device, count, padding: 0, indirect: BTreeSet::new(), named: BTreeMap::new() }
    }
    pub fn resize(&mut self, count: u32) {
        self.count = count;
    }
    pub fn padding(&self) -> u64 {
        self.padding
    }
    pub fn pad(&mut self, elements: u64) {
        self.padding = elements;
    }
    /// Marks a field, before it is created, as one of indirect arguments.
    pub fn dispatches(&mut self, name: &str) {
        self.indirect.insert(name.to_owned());
    }
    pub fn get(&self, name: &str) -> Option<&wgpu::Buffer> {
        self.named.get(name).map(|(buffer, _)| buffer)
    }
    pub fn forget(&mut self, name: &str) {
        self.named.remove(name);
    }
    /// Creates a field of at least `bytes` bytes, unless it exists. Returns whether it is new.
    pub fn require(&mut self, name: &str, bytes: u64) -> Result<bool, Error> {
        if let Some((_, have)) = self.named.get(name) {
            if *have < bytes {
                return Err(Error::Device(format!(
                    "the field `{name}` was made with {have} bytes; a later plan wants {bytes}"
                )));
            }
            return Ok(false);
        }
        let limit = bindable(&self.device.limits());
        if bytes > limit {
            return Err(too_large(name, bytes, limit, self.count));
        }
        // 16 bytes hold one element of any field.
        let size = bytes.next_multiple_of(16).max(16) + self.padding * 16;
        let usage = wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC | wgpu::BufferUsages::COPY_DST;
        let extra = match name {
            "world" => wgpu::BufferUsages::UNIFORM,
            _ if self.indirect.contains(name) => wgpu::BufferUsages::INDIRECT,
            _ => wgpu::BufferUsages::VERTEX,
        };
        let descriptor =
            wgpu::BufferDescriptor { label: Some(name), size, usage: usage | extra, mapped_at_creation: false };
        let buffer = fault::scoped(&self.device, || self.device.create_buffer(&descriptor))
            .map_err(|e| with_size(e, name, size))?;
        self.named.insert(name.to_owned(), (buffer, bytes));
        Ok(true)
    }
}

pub fn missing(name: &str) -> Error {
    Error::Device(format!("there is no field `{name}` on the device"))
}

fn with_size(error: Error, name: &str, size: u64) -> Error {
    match error {
        Error::OutOfMemory(_) => Error::OutOfMemory(format!("no memory for the field `{name}` of {}", mebibytes(size))),
        other => other,
    }
}

fn too_large(name: &str, bytes: u64, limit: u64, count: u32) -> Error {
    let each = (bytes / u64::from(count.max(1))).max(1);
    if each > limit {
        return Error::Limit(format!(
            "the field `{name}` needs {} for each of {count} particles; this device binds {}, so that not even one fits: make its \
             elements smaller",
            mebibytes(each),
            mebibytes(limit)
        ));
    }
    Error::Limit(format!(
        "{count} particles need {} for the field `{name}`; this device binds {}: at most {} particles fit, so choose \
         another adapter with --adapter, or fewer particles",
        mebibytes(bytes),
        mebibytes(limit),
        limit / each,
    ))
}

fn mebibytes(bytes: u64) -> String {
    match bytes {
        0..1_048_576 => format!("{bytes} bytes"),
        1_048_576..1_073_741_824 => {
            format!("{}.{} MiB", bytes >> 20, ((bytes & 0xF_FFFF) * 10) >> 20)
        }
        _ => format!("{}.{} GiB", bytes >> 30, ((bytes & 0x3FFF_FFFF) * 10) >> 30),
    }
}
