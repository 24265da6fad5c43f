//! Users' laws are compiled in a thread with a timeout, because a driver may never finish.

use std::sync::mpsc;
use std::time::Duration;

use super::fault;
use super::pipeline::{Pipeline, make};
use crate::error::Error;
use crate::kernel::{Access, Pass};

/// Makes a pipeline, and forces the driver to finish all work that it defers until the first dispatch.
///
/// # Errors
/// [`Error::Timeout`] if that takes too long, or the error of the driver.
pub fn made(device: &wgpu::Device, queue: &wgpu::Queue, pass: &Pass, patience: Duration) -> Result<Pipeline, Error> {
    let (done, awaited) = mpsc::channel();
    let (device, queue, law) = (device.clone(), queue.clone(), pass.clone());
    let work = move || {
        let pipeline = fault::scoped(&device, || {
            let pipeline = make(&device, &law);
            begin(&device, &queue, &law, &pipeline);
            pipeline
        });
        // After a timeout it is dropped.
        let _ = done.send(pipeline);
    };
    let thread = std::thread::Builder::new().name("compile".to_owned()).spawn(work);
    thread.map_err(|error| Error::Device(format!("no thread can be made to compile in: {error}")))?;
    awaited.recv_timeout(patience).unwrap_or_else(|why| {
        if why == std::sync::mpsc::RecvTimeoutError::Disconnected {
            return Err(Error::Lost("its driver ended the compilation of a law".to_owned()));
        }
        let file = pass.shader.sources().iter().find(|source| source.law).map_or("a law", |source| &source.file);
        let what = format!(
            "the driver compiles {file}; smaller arrays that are indexed by what is computed, fewer calls, or shorter functions are \
             compiled faster"
        );
        Err(Error::Timeout { what, seconds: patience.as_secs() })
    })
}

/// Dispatches no workgroups, on buffers of the minimum size, and waits for completion.
fn begin(device: &wgpu::Device, queue: &wgpu::Queue, law: &Pass, pipeline: &Pipeline) {
    let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
    {
        let descriptor = wgpu::ComputePassDescriptor { label: Some("compile"), timestamp_writes: None };
        let mut pass = encoder.begin_compute_pass(&descriptor);
        pass.set_pipeline(&pipeline.pipeline);
        for (index, layout) in &pipeline.groups {
            let bindings = law.shader.reflection().bindings.iter().filter(|binding| binding.group == *index);
            let buffers: Vec<_> = bindings
                .map(|binding| {
                    let usage = match binding.access {
                        Access::Uniform => wgpu::BufferUsages::UNIFORM,
                        _ => wgpu::BufferUsages::STORAGE,
                    };
                    let size = binding.stride.next_multiple_of(16).max(16);
                    let descriptor = wgpu::BufferDescriptor { label: None, size, usage, mapped_at_creation: false };
                    (binding.binding, device.create_buffer(&descriptor))
                })
                .collect();
            let entries: Vec<_> = buffers
                .iter()
                .map(|(binding, buffer)| wgpu::BindGroupEntry {
                    binding: *binding,
                    resource: buffer.as_entire_binding(),
                })
                .collect();
            let group = device.create_bind_group(&wgpu::BindGroupDescriptor { label: None, layout, entries: &entries });
            pass.set_bind_group(*index, &group, &[]);
        }
        pass.dispatch_workgroups(0, 1, 1);
    }
    let index = queue.submit([encoder.finish()]);
    // A fault of the device is detected at its next use.
    let _ = device.poll(wgpu::PollType::Wait { submission_index: Some(index), timeout: None });
}
