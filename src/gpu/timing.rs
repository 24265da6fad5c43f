//! Time on the device's own clock.

use super::program::Program;
use super::submit::Queue;
use super::{fault, read};
use crate::error::Error;

/// Runs a program a number of times in one submission, and gives the seconds that took by the device's clock; `None`
/// when the device was opened without timestamps.
pub async fn timed(
    device: &wgpu::Device,
    queue: &mut Queue,
    program: &Program,
    times: u32,
) -> Result<Option<f64>, Error> {
    if !device.features().contains(wgpu::Features::TIMESTAMP_QUERY) {
        return Ok(None);
    }
    let (resolved, commands) = fault::scoped(device, || {
        let set = device.create_query_set(&wgpu::QuerySetDescriptor {
            label: None,
            ty: wgpu::QueryType::Timestamp,
            count: 2,
        });
        let usage = wgpu::BufferUsages::QUERY_RESOLVE | wgpu::BufferUsages::COPY_SRC;
        let resolved =
            device.create_buffer(&wgpu::BufferDescriptor { label: None, size: 16, usage, mapped_at_creation: false });
        let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        {
            let writes = wgpu::ComputePassTimestampWrites {
                query_set: &set,
                beginning_of_pass_write_index: Some(0),
                end_of_pass_write_index: Some(1),
            };
            let descriptor = wgpu::ComputePassDescriptor { label: Some("timed"), timestamp_writes: Some(writes) };
            let mut pass = encoder.begin_compute_pass(&descriptor);
            program.encode(times, &mut pass);
        }
        encoder.resolve_query_set(&set, 0..2, &resolved, 0);
        (resolved, encoder.finish())
    })?;
    queue.submit_commands(commands)?;
    let bytes = read::bytes(device, queue, &resolved, 0, 16).await?;
    let tick = |i: usize| bytes.get(8 * i..8 * i + 8).and_then(|b| b.try_into().ok()).map_or(0, u64::from_le_bytes);
    Ok(Some(tick(1).saturating_sub(tick(0)) as f64 * f64::from(queue.period()) * 1e-9))
}
