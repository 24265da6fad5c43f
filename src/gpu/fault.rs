//! Errors of a device, as typed errors.

#[cfg(not(target_arch = "wasm32"))]
use std::pin::pin;
use std::sync::{Arc, Mutex};
#[cfg(not(target_arch = "wasm32"))]
use std::task::{Context, Poll, Waker};

use crate::error::Error;

/// The first error of a device that was reported outside of our calls: a loss, or a validation error.
#[derive(Debug, Clone, Default)]
pub struct Faults(Arc<Mutex<Option<String>>>);

impl Faults {
    /// Registers callbacks at a device of our own; the owner of another device has its own.
    pub(super) fn listen(device: &wgpu::Device) -> Self {
        let faults = Self::default();
        let (lost, refused) = (faults.clone(), faults.clone());
        device.set_device_lost_callback(move |reason, message| {
            if reason != wgpu::DeviceLostReason::Destroyed {
                lost.note(format!("lost: {message}"));
            }
        });
        device.on_uncaptured_error(Arc::new(move |error: wgpu::Error| refused.note(error.to_string())));
        faults
    }
    fn note(&self, message: String) {
        if let Ok(mut first) = self.0.lock() {
            first.get_or_insert(message);
        }
    }
    /// The first reported error.
    ///
    /// # Errors
    /// The reported error, if there was one.
    pub fn check(&self) -> Result<(), Error> {
        match self.0.lock().ok().and_then(|first| first.clone()) {
            Some(message) => Err(sort(message)),
            None => Ok(()),
        }
    }
}

/// Calls a function with error scopes open, whose futures are ready at once.
#[cfg(not(target_arch = "wasm32"))]
pub fn scoped<T>(device: &wgpu::Device, call: impl FnOnce() -> T) -> Result<T, Error> {
    let memory = device.push_error_scope(wgpu::ErrorFilter::OutOfMemory);
    let internal = device.push_error_scope(wgpu::ErrorFilter::Internal);
    let validation = device.push_error_scope(wgpu::ErrorFilter::Validation);
    let result = call();
    let complaints = [ready(validation.pop()), ready(internal.pop()), ready(memory.pop())];
    match complaints.into_iter().flatten().flatten().next() {
        None => Ok(result),
        Some(wgpu::Error::OutOfMemory { source }) => Err(Error::OutOfMemory(source.to_string())),
        Some(_) if is_lost(device) => Err(Error::Lost("it was lost or destroyed".to_owned())),
        Some(error) => Err(sort(error.to_string())),
    }
}

/// Calls a function. A browser reports errors later, whatever waits for them: they go to the owner of the device, as [`Faults`] of ours.
#[cfg(target_arch = "wasm32")]
#[expect(clippy::unnecessary_wraps, reason = "other devices report errors at once")]
pub fn scoped<T>(_: &wgpu::Device, call: impl FnOnce() -> T) -> Result<T, Error> {
    Ok(call())
}

/// A lost device, or one that its owner has destroyed, silently creates invalid buffers: their use is refused.
#[cfg(not(target_arch = "wasm32"))]
fn is_lost(device: &wgpu::Device) -> bool {
    let usage = wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST;
    let descriptor = wgpu::BufferDescriptor { label: Some("probe"), size: 4, usage, mapped_at_creation: false };
    let refused = device.push_error_scope(wgpu::ErrorFilter::Validation);
    device.create_buffer(&descriptor).slice(..).map_async(wgpu::MapMode::Read, |_| ());
    ready(refused.pop()).flatten().is_some()
}

/// The loss of a device is only given in the message.
fn sort(message: String) -> Error {
    let words = message.to_lowercase();
    if words.contains("lost") {
        Error::Lost(message)
    } else if words.contains("out of memory") {
        Error::OutOfMemory(message)
    } else {
        Error::Device(message)
    }
}

#[cfg(not(target_arch = "wasm32"))]
fn ready<T>(future: impl Future<Output = T>) -> Option<T> {
    match pin!(future).poll(&mut Context::from_waker(Waker::noop())) {
        Poll::Ready(value) => Some(value),
        Poll::Pending => None,
    }
}
