//! Readback. A request does not wait: it is polled, or awaited while a thread of its own polls the device. The only module that uses
//! futures-intrusive.

use std::future::poll_fn;
use std::pin::Pin;
use std::sync::{Arc, Mutex, PoisonError};
use std::task::{Context, Poll, Waker};
use std::time::Duration;

#[cfg(not(target_arch = "wasm32"))]
use futures_intrusive::channel::shared::OneshotSender;
use futures_intrusive::channel::shared::oneshot_channel;
use web_time::Instant;

#[cfg(not(target_arch = "wasm32"))]
use super::done::polled;
use super::done::wait_until;
use super::fault;
use super::submit::Queue;
use crate::error::Error;
use crate::kernel::{Array, Arrival};

/// The maximum duration of one poll of the device, before the executor continues.
#[cfg(not(target_arch = "wasm32"))]
pub const LOOK: Duration = Duration::from_millis(2);
/// The interval between two polls of a thread that watches a request.
#[cfg(not(target_arch = "wasm32"))]
const WATCH: Duration = Duration::from_millis(1);

/// The number of owners of a sender after the device has dropped its own: the request, and the thread that watches it.
#[cfg(not(target_arch = "wasm32"))]
const ALONE: usize = 2;

/// Whether a copy has arrived, or the reason of its failure.
type Answer = Result<(), Error>;

/// A copy of part of a buffer that is being transferred to the host.
pub struct Request {
    device: wgpu::Device,
    /// `None` for an empty range.
    stage: Option<wgpu::Buffer>,
    /// The device sends the answer, or a watching thread after a timeout. The first one counts.
    #[cfg(not(target_arch = "wasm32"))]
    sender: Arc<OneshotSender<Answer>>,
    /// Never locked: the mutex only makes a request `Sync`.
    coming: Mutex<Pin<Box<dyn Future<Output = Option<Answer>> + Send>>>,
    /// An answer that has arrived but was not taken yet.
    answer: Option<Answer>,
    len: u64,
    deadline: Instant,
    patience: Duration,
    watched: bool,
}

/// Requests part of a buffer, as it is after all submitted work.
pub fn request(
    device: &wgpu::Device,
    queue: &mut Queue,
    buffer: &wgpu::Buffer,
    from: u64,
    len: u64,
) -> Result<Request, Error> {
    if from.checked_add(len).is_none_or(|end| end > buffer.size()) {
        return Err(Error::Device(format!("{len} bytes from {from} on are asked of a field of {}", buffer.size())));
    }
    let (sender, receiver) = oneshot_channel();
    let sender = Arc::new(sender);
    let mut request = Request {
        device: device.clone(),
        stage: None,
        #[cfg(not(target_arch = "wasm32"))]
        sender: sender.clone(),
        coming: Mutex::new(Box::pin(async move { receiver.receive().await })),
        answer: None,
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
    queue.submit_commands(commands)?;
    let answer = move |result: Result<(), wgpu::BufferAsyncError>| {
        let unread = |why: wgpu::BufferAsyncError| Error::Lost(format!("a field cannot be read: {why}"));
        // After a timeout nothing listens any more.
        let _ = sender.send(result.map_err(unread));
    };
    // A lost device creates invalid buffers without an error: the first error is that of their use.
    let map = || stage.slice(..).map_async(wgpu::MapMode::Read, answer);
    fault::scoped(device, map)?;
    request.stage = Some(stage);
    Ok(request)
}

impl Request {
    /// The bytes, once they have arrived; waits for them for at most `time`, and not at all without a time.
    pub fn look(&mut self, time: Option<Duration>) -> Option<Result<Vec<u8>, Error>> {
        if self.stage.is_none() {
            return Some(Ok(Vec::new()));
        }
        // A browser maps in its own event loop; elsewhere the device must be polled.
        let device = self.device.clone();
        let looked = wait_until(&device, time.unwrap_or_default(), || {
            self.answer = self.come(Waker::noop());
            self.answer.is_some()
        });
        if let Err(why) = looked {
            return Some(Err(why));
        }
        self.arrived(Waker::noop())
    }
    /// The bytes, once they have arrived; the task of this waker is woken then.
    fn arrived(&mut self, waker: &Waker) -> Option<Result<Vec<u8>, Error>> {
        let Some(stage) = self.stage.clone() else { return Some(Ok(Vec::new())) };
        match self.come(waker) {
            Some(Ok(())) => Some(copied(&stage, self.len)),
            Some(Err(why)) => Some(Err(why)),
            None if Instant::now() > self.deadline => Some(Err(late(self.patience))),
            None => None,
        }
    }
    /// The answer, if it has arrived; otherwise the task of this waker is woken when it arrives.
    fn come(&mut self, waker: &Waker) -> Option<Answer> {
        if let Some(answer) = self.answer.take() {
            return Some(answer);
        }
        let coming = self.coming.get_mut().unwrap_or_else(PoisonError::into_inner);
        match coming.as_mut().poll(&mut Context::from_waker(waker)) {
            Poll::Ready(answer) => Some(answer.unwrap_or_else(|| {
                Err(Error::Lost("a field cannot be read: the device dropped the request".to_owned()))
            })),
            Poll::Pending => None,
        }
    }
    /// Wakes a task once the answer has arrived.
    fn wake(&mut self, waker: &Waker) {
        self.answer = self.come(waker);
        if self.answer.is_some() {
            return waker.wake_by_ref();
        }
        if !self.watched {
            self.watched = self.watch(waker);
        }
    }
    /// A browser wakes by itself.
    #[cfg(target_arch = "wasm32")]
    #[expect(clippy::unused_self, reason = "elsewhere a thread watches")]
    fn watch(&self, _: &Waker) -> bool {
        true
    }
    /// Polls the device from a thread, if one can be started, until there is an answer, a timeout, or the request is dropped.
    #[cfg(not(target_arch = "wasm32"))]
    fn watch(&self, waker: &Waker) -> bool {
        let (device, sender) = (self.device.clone(), Arc::downgrade(&self.sender));
        let (deadline, patience) = (self.deadline, self.patience);
        let work = move || {
            // The device drops its own when it has answered.
            while let Some(sender) = sender.upgrade().filter(|sender| Arc::strong_count(sender) > ALONE) {
                let over = match polled(&device, wgpu::PollType::Poll) {
                    Err(why) => Some(why),
                    Ok(()) => (Instant::now() > deadline).then(|| late(patience)),
                };
                if let Some(why) = over {
                    let _ = sender.send(Err(why));
                    return;
                }
                drop(sender);
                std::thread::sleep(WATCH);
            }
        };
        // Without a thread the executor polls repeatedly.
        let watched = std::thread::Builder::new().name("read".to_owned()).spawn(work).is_ok();
        if !watched {
            waker.wake_by_ref();
        }
        watched
    }
}

fn late(patience: Duration) -> Error {
    Error::Timeout { what: "a read".to_owned(), seconds: patience.as_secs() }
}

fn copied(stage: &wgpu::Buffer, len: u64) -> Result<Vec<u8>, Error> {
    // The buffer has no other owner: it is invalid because its device is lost.
    let view = stage.slice(..len).get_mapped_range();
    let view = view.map_err(|why| Error::Lost(format!("a field cannot be read: {why}")))?;
    let copy = view.to_vec();
    drop(view);
    stage.unmap();
    Ok(copy)
}

/// Copies part of a buffer to the host, after all submitted work. No poll takes much longer than [`LOOK`].
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
        // A browser maps while nothing polls, and wakes the task then.
        #[cfg(target_arch = "wasm32")]
        let answer = request.arrived(context.waker());
        #[cfg(not(target_arch = "wasm32"))]
        let answer = request.look(Some(LOOK));
        if answer.is_none() && cfg!(not(target_arch = "wasm32")) {
            context.waker().wake_by_ref();
        }
        answer.map_or(Poll::Pending, Poll::Ready)
    })
    .await
}

/// An array that is being transferred.
pub struct Incoming {
    request: Request,
    like: Array,
}

impl Incoming {
    /// The elements of the kind of `like` in a request.
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
