//! Reading back, without blocking for ever and without `block_on`. The only place that knows futures-intrusive.

use std::future::poll_fn;
use std::task::Poll;
use std::time::Duration;

use futures_intrusive::channel::shared::oneshot_channel;
use web_time::Instant;

use super::fault;
use super::submit::Queue;
use crate::error::Error;

/// How long one look at the device may take, before the executor gets its turn.
const LOOK: Duration = Duration::from_millis(2);

/// Copies part of a buffer to the host, behind all that was submitted.
pub async fn bytes(
    device: &wgpu::Device,
    queue: &mut Queue,
    buffer: &wgpu::Buffer,
    from: u64,
    len: u64,
) -> Result<Vec<u8>, Error> {
    if from + len > buffer.size() {
        return Err(Error::Device(format!("{len} bytes from {from} on are asked of a field of {}", buffer.size())));
    }
    if len == 0 {
        return Ok(Vec::new());
    }
    queue.wait()?;
    let usage = wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST;
    let size = len.next_multiple_of(4);
    let descriptor = wgpu::BufferDescriptor { label: Some("read"), size, usage, mapped_at_creation: false };
    let (stage, commands) = fault::scoped(device, || {
        let stage = device.create_buffer(&descriptor);
        let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        encoder.copy_buffer_to_buffer(buffer, from, &stage, 0, size);
        (stage, encoder.finish())
    })?;
    let index = queue.submit_commands(commands)?;

    let (sender, receiver) = oneshot_channel();
    // A device that is lost makes invalid buffers, and says nothing: the first complaint is of their use.
    let map = || stage.slice(..).map_async(wgpu::MapMode::Read, move |result| drop(sender.send(result)));
    fault::scoped(device, map).map_err(|e| Error::Lost(format!("a field cannot be read: {e}")))?;
    let deadline = Instant::now() + queue.patience();
    let mut mapped = std::pin::pin!(receiver.receive());
    let answer = poll_fn(|context| {
        if let Poll::Ready(answer) = mapped.as_mut().poll(context) {
            return Poll::Ready(Ok(answer));
        }
        // A browser maps while its own loop runs; elsewhere it must be polled.
        match device.poll(wgpu::PollType::Wait { submission_index: Some(index.clone()), timeout: Some(LOOK) }) {
            Ok(_) | Err(wgpu::PollError::Timeout) if Instant::now() > deadline => {
                Poll::Ready(Err(queue.timeout("a read")))
            }
            Ok(_) | Err(wgpu::PollError::Timeout) => {
                context.waker().wake_by_ref();
                Poll::Pending
            }
            Err(error) => Poll::Ready(Err(Error::Lost(error.to_string()))),
        }
    })
    .await?;
    match answer {
        Some(Ok(())) => {}
        Some(Err(error)) => return Err(Error::Lost(format!("a field cannot be read: {error}"))),
        None => {
            return Err(Error::Lost("a field cannot be read: the device dropped the request".to_owned()));
        }
    }
    let view = stage.slice(..len).get_mapped_range().map_err(|e| Error::Device(e.to_string()))?;
    let copy = view.to_vec();
    drop(view);
    stage.unmap();
    Ok(copy)
}
