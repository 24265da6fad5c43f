//! Reading back. A request waits for nothing: it is looked at, or awaited while a thread of its own looks at the device.

use std::future::poll_fn;
use std::sync::{Arc, Mutex};
use std::task::{Poll, Waker};
use std::time::Duration;

use web_time::Instant;

use super::fault;
use super::submit::Queue;
use crate::error::Error;
use crate::kernel::{Array, Arrival};

/// How long one look at the device may take, before the executor gets its turn.
pub const LOOK: Duration = Duration::from_millis(2);
/// From one look of a thread that watches a request to the next.
#[cfg(not(target_arch = "wasm32"))]
const WATCH: Duration = Duration::from_millis(1);

/// Where the device says that a copy is there, and which task it wakes then.
#[derive(Default)]
struct Slot {
    answer: Option<Result<(), String>>,
    waker: Option<Waker>,
}

/// A copy of part of a buffer that is under way to the host.
pub struct Request {
    device: wgpu::Device,
    /// None where nothing is asked for.
    stage: Option<wgpu::Buffer>,
    index: Option<wgpu::SubmissionIndex>,
    slot: Arc<Mutex<Slot>>,
    len: u64,
    deadline: Instant,
    patience: Duration,
    watched: bool,
}

/// Asks for part of a buffer, as it is behind all that was submitted.
pub fn request(
    device: &wgpu::Device,
    queue: &mut Queue,
    buffer: &wgpu::Buffer,
    from: u64,
    len: u64,
) -> Result<Request, Error> {
    if from + len > buffer.size() {
        return Err(Error::Device(format!("{len} bytes from {from} on are asked of a field of {}", buffer.size())));
    }
    let slot = Arc::new(Mutex::new(Slot::default()));
    let mut request = Request {
        device: device.clone(),
        stage: None,
        index: None,
        slot: slot.clone(),
        len,
        deadline: Instant::now() + queue.patience(),
        patience: queue.patience(),
        watched: false,
    };
    if len == 0 {
        return Ok(request);
    }
    let usage = wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST;
    let size = len.next_multiple_of(4);
    let descriptor = wgpu::BufferDescriptor { label: Some("read"), size, usage, mapped_at_creation: false };
    let (stage, commands) = fault::scoped(device, || {
        let stage = device.create_buffer(&descriptor);
        let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        encoder.copy_buffer_to_buffer(buffer, from, &stage, 0, size);
        (stage, encoder.finish())
    })?;
    request.index = Some(queue.submit_commands(commands)?);
    let answer = move |result: Result<(), wgpu::BufferAsyncError>| {
        if let Ok(mut slot) = slot.lock() {
            slot.answer = Some(result.map_err(|why| why.to_string()));
            slot.waker.take().into_iter().for_each(Waker::wake);
        }
    };
    // A device that is lost makes invalid buffers, and says nothing: the first complaint is of their use.
    let map = || stage.slice(..).map_async(wgpu::MapMode::Read, answer);
    fault::scoped(device, map).map_err(|e| Error::Lost(format!("a field cannot be read: {e}")))?;
    request.stage = Some(stage);
    Ok(request)
}

impl Request {
    /// The bytes, once they are there; waits for them so long at most, and not at all without a time.
    pub fn look(&mut self, time: Option<Duration>) -> Option<Result<Vec<u8>, Error>> {
        let Some(stage) = &self.stage else { return Some(Ok(Vec::new())) };
        // A browser maps while its own loop runs; elsewhere it must be polled.
        let poll = match (&self.index, time) {
            (Some(index), Some(time)) => {
                wgpu::PollType::Wait { submission_index: Some(index.clone()), timeout: Some(time) }
            }
            _ => wgpu::PollType::Poll,
        };
        if let Err(why) = self.device.poll(poll)
            && !matches!(why, wgpu::PollError::Timeout)
        {
            return Some(Err(Error::Lost(why.to_string())));
        }
        let answer = self
            .slot
            .lock()
            .map_or_else(|_| Some(Err("its callback failed".to_owned())), |mut slot| slot.answer.take());
        match answer {
            Some(Ok(())) => Some(copied(stage, self.len)),
            Some(Err(why)) => Some(Err(Error::Lost(format!("a field cannot be read: {why}")))),
            None if Instant::now() > self.deadline => {
                Some(Err(Error::Timeout { what: "a read".to_owned(), seconds: self.patience.as_secs() }))
            }
            None => None,
        }
    }
    /// Wakes a task once there is something to look at.
    fn wake(&mut self, waker: &Waker) {
        let Ok(mut slot) = self.slot.lock() else { return waker.wake_by_ref() };
        if slot.answer.is_some() {
            return waker.wake_by_ref();
        }
        slot.waker = Some(waker.clone());
        drop(slot);
        if !self.watched {
            self.watched = true;
            self.watch(waker);
        }
    }
    /// A browser wakes by itself.
    #[cfg(target_arch = "wasm32")]
    fn watch(&self, _: &Waker) {}
    /// Looks at the device from a thread, until there is an answer, the time is over, or the request is dropped.
    #[cfg(not(target_arch = "wasm32"))]
    fn watch(&self, waker: &Waker) {
        let (device, slot, deadline) = (self.device.clone(), Arc::downgrade(&self.slot), self.deadline);
        let work = move || {
            while let Some(slot) = slot.upgrade() {
                let polled = device.poll(wgpu::PollType::Poll);
                let Ok(mut slot) = slot.lock() else { return };
                if slot.answer.is_some() || polled.is_err() || Instant::now() > deadline {
                    slot.waker.take().into_iter().for_each(Waker::wake);
                    return;
                }
                drop(slot);
                std::thread::sleep(WATCH);
            }
        };
        // Without a thread the executor asks again and again.
        if std::thread::Builder::new().name("read".to_owned()).spawn(work).is_err() {
            waker.wake_by_ref();
        }
    }
}

fn copied(stage: &wgpu::Buffer, len: u64) -> Result<Vec<u8>, Error> {
    // Nothing else has the buffer: it is gone with its device.
    let view = stage.slice(..len).get_mapped_range();
    let view = view.map_err(|why| Error::Lost(format!("a field cannot be read: {why}")))?;
    let copy = view.to_vec();
    drop(view);
    stage.unmap();
    Ok(copy)
}

/// Copies part of a buffer to the host, behind all that was submitted. No poll of it takes much longer than [`LOOK`].
pub async fn bytes(
    device: &wgpu::Device,
    queue: &mut Queue,
    buffer: &wgpu::Buffer,
    from: u64,
    len: u64,
) -> Result<Vec<u8>, Error> {
    queue.idle().await?;
    let mut request = request(device, queue, buffer, from, len)?;
    poll_fn(|context| {
        let answer = request.look(Some(LOOK));
        if answer.is_none() {
            context.waker().wake_by_ref();
        }
        answer.map_or(Poll::Pending, Poll::Ready)
    })
    .await
}

/// An array that is on its way.
pub struct Incoming {
    request: Request,
    like: Array,
}

impl Incoming {
    /// The elements of `like` that a request asks for.
    pub fn new(request: Request, like: Array) -> Self {
        Self { request, like }
    }
}

impl Arrival for Incoming {
    fn look(&mut self) -> Option<Result<Array, Error>> {
        self.request.look(None).map(|answer| answer.map(|bytes| self.like.like(&bytes)))
    }
    fn wake(&mut self, waker: &Waker) {
        self.request.wake(waker);
    }
}
