//! Pictures of a running simulation, which stay on the device.

use std::collections::BTreeMap;

use super::draw::on_device;
use super::frame::FIELDS;
use super::{Exposure, Picture};
use crate::error::Error;
use crate::kernel::Backend;

/// The part by which each picture approaches its own exposure.
const FOLLOW: f64 = 0.15;

/// A picture that is drawn again and again, with an exposure that follows the light slowly.
#[derive(Debug, Clone)]
pub struct Live {
    /// The picture. Its number of particles is that of the simulation.
    pub picture: Picture,
    exposure: Option<Exposure>,
    /// Whether the last one had its own exposure, within a hundredth of an f-stop.
    settled: bool,
    /// The sizes of the fields of the last one.
    fields: BTreeMap<String, u64>,
}

impl Live {
    /// Pictures that begin with this one.
    #[must_use]
    pub fn new(picture: Picture) -> Self {
        Self { picture, exposure: None, settled: false, fields: BTreeMap::new() }
    }
    /// Goes on with another picture, at its own exposure.
    pub fn change(&mut self, picture: Picture) {
        self.picture = picture;
        self.exposure = None;
    }
    /// Whether the last picture had its own exposure, so that another one of the same state would be the same.
    #[must_use]
    pub fn is_settled(&self) -> bool {
        self.settled
    }
    /// Draws the current state into the field [`PIXELS`](super::PIXELS): a word for each pixel, red first, row by row from the top.
    ///
    /// # Errors
    /// When the picture does not fit the device, or the device is lost, out of memory or does not answer in time.
    pub async fn draw<B: Backend>(&mut self, backend: &mut B) -> Result<(), Error> {
        let fields = self.picture.plan()?.fields(self.picture.frame.count);
        if fields != self.fields {
            FIELDS.iter().for_each(|field| backend.forget(field));
            self.fields = fields;
        }
        let (last, settled) = (&mut self.exposure, &mut self.settled);
        let follow = |metered: Exposure| {
            let now = *last.insert(last.map_or(metered, |last| last.toward(metered, FOLLOW)));
            *settled = now.stops_from(metered) < 0.01;
            now
        };
        on_device(backend, &self.picture, follow).await
    }
}
