//! Asynchronous readback of values to the host.

use std::future::Future;
use std::marker::PhantomData;
use std::pin::Pin;
use std::task::{Context, Poll};

use crate::error::Error;
use crate::kernel::{Arrival, Element};

/// The values of a field that [`Simulation::request`](super::Simulation::request) requested. [`Readback::look`] returns them once they
/// have arrived; `.await` waits for them, while the simulation and its device continue. It may be sent to another thread.
#[must_use = "the values are in it"]
pub struct Readback<T> {
    /// `None` once its values have been returned.
    arrival: Option<Box<dyn Arrival>>,
    element: PhantomData<fn() -> T>,
}

impl<T: Element> Readback<T> {
    pub(super) fn new(arrival: Box<dyn Arrival>) -> Self {
        Self { arrival: Some(arrival), element: PhantomData }
    }
    /// The values, once they have arrived; `None` before. Returns immediately.
    ///
    /// # Errors
    /// [`Error::Lost`] when the device is lost, [`Error::Timeout`] when it does not respond in time, and [`Error::Scene`] when the values
    /// were returned already.
    pub fn look(&mut self) -> Option<Result<Vec<T>, Error>> {
        let Some(arrival) = &mut self.arrival else {
            return Some(Err(Error::Scene("these values were returned already: request the field again".to_owned())));
        };
        let answer = arrival.look()?;
        self.arrival = None;
        Some(answer.map(|array| {
            T::view(&array).map_or_else(Vec::new, |values| values.iter().map(|v| T::narrow(*v)).collect())
        }))
    }
}

impl<T: Element> Future for Readback<T> {
    type Output = Result<Vec<T>, Error>;

    fn poll(mut self: Pin<&mut Self>, context: &mut Context<'_>) -> Poll<Self::Output> {
        if let Some(answer) = self.look() {
            return Poll::Ready(answer);
        }
        if let Some(arrival) = &mut self.arrival {
            arrival.wake(context.waker());
        }
        Poll::Pending
    }
}
