//! Time on the device's own clock.

use super::program::{Dispatch, Program};
use super::submit::Queue;
use super::{fault, read};
use crate::error::Error;

/// Passes that are timed in one submission, at most: a query set has no more than 4096 entries.
const PASSES: usize = 1024;

/// Runs a program a number of times in one submission, and returns the seconds that it took by the device's clock; `None` when the device
/// was opened without timestamps.
pub async fn timed(
    device: &wgpu::Device,
    queue: &mut Queue,
    program: &Program,
    times: u32,
) -> Result<Option<f64>, Error> {
    let all: Vec<_> = (0..times).flat_map(|_| &program.dispatches).collect();
    let seconds = passes(device, queue, program, &[all]).await?;
    Ok(seconds.and_then(|seconds| seconds.first().copied()))
}

/// Runs a program once, and gives the seconds of each dispatch by the device's clock; `None` when the device was opened without
/// timestamps.
pub async fn each(device: &wgpu::Device, queue: &mut Queue, program: &Program) -> Result<Option<Vec<f64>>, Error> {
    let alone: Vec<Vec<&Dispatch>> = program.dispatches.iter().map(|dispatch| vec![dispatch]).collect();
    let mut all = Vec::new();
    for some in alone.chunks(PASSES) {
        let Some(seconds) = passes(device, queue, program, some).await? else { return Ok(None) };
        all.extend(seconds);
    }
    Ok(Some(all))
}

/// Runs passes of some dispatches each in one submission, and gives the seconds of each.
async fn passes(
    device: &wgpu::Device,
    queue: &mut Queue,
    program: &Program,
    all: &[Vec<&Dispatch>],
) -> Result<Option<Vec<f64>>, Error> {
    if !device.features().contains(wgpu::Features::TIMESTAMP_QUERY) {
        return Ok(None);
    }
    let count = u32::try_from(2 * all.len()).map_err(|_| Error::Device("too many passes to time".to_owned()))?;
    let size = 8 * u64::from(count);
    let (resolved, commands) = fault::scoped(device, || {
        let set =
            device.create_query_set(&wgpu::QuerySetDescriptor { label: None, ty: wgpu::QueryType::Timestamp, count });
        let usage = wgpu::BufferUsages::QUERY_RESOLVE | wgpu::BufferUsages::COPY_SRC;
        let resolved =
            device.create_buffer(&wgpu::BufferDescriptor { label: None, size, usage, mapped_at_creation: false });
        let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        for (dispatches, first) in all.iter().zip((0..count).step_by(2)) {
            let writes = wgpu::ComputePassTimestampWrites {
                query_set: &set,
                beginning_of_pass_write_index: Some(first),
                end_of_pass_write_index: Some(first + 1),
            };
            let descriptor = wgpu::ComputePassDescriptor { label: Some("timed"), timestamp_writes: Some(writes) };
            let mut pass = encoder.begin_compute_pass(&descriptor);
            program.encode_some(dispatches.iter().copied(), &mut pass);
        }
        encoder.resolve_query_set(&set, 0..count, &resolved, 0);
        (resolved, encoder.finish())
    })?;
    queue.submit_commands(commands)?;
    let bytes = read::bytes(device, queue, &resolved, 0, size).await?;
    let ticks: Vec<u64> = bytes.chunks_exact(8).filter_map(|b| Some(u64::from_le_bytes(b.try_into().ok()?))).collect();
    let seconds = |from: u64, to: u64| to.saturating_sub(from) as f64 * f64::from(queue.period()) * 1e-9;
    Ok(Some(ticks.chunks_exact(2).map(|pair| seconds(pair[0], pair[1])).collect()))
}
