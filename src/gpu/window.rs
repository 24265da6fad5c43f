//! The surface of a window.

use super::adapter::{self, Choice, Found};
use super::canvas::{Canvas, Controls};
use super::fault;
use crate::error::Error;

/// A window's surface, and the means to paint on it.
pub struct Window {
    surface: wgpu::Surface<'static>,
    config: wgpu::SurfaceConfiguration,
    canvas: Canvas,
    device: wgpu::Device,
    queue: wgpu::Queue,
}

impl Window {
    /// The surface of a window, and a device that can draw on it.
    ///
    /// # Errors
    /// [`Error::NoAdapter`] when no adapter of that choice can draw on the window.
    pub async fn open(
        target: impl Into<wgpu::SurfaceTarget<'static>>,
        [width, height]: [u32; 2],
        choice: &Choice,
    ) -> Result<(Self, Found), Error> {
        let instance = adapter::instance();
        let surface = instance.create_surface(target).map_err(|error| Error::NoAdapter(error.to_string()))?;
        let mut adapters = adapter::adapters(&instance).await;
        adapters.retain(|adapter| adapter.is_surface_supported(&surface));
        let found = adapter::open(adapter::choose(adapters, choice)?).await?;
        let cannot = || Error::NoAdapter(format!("{} cannot draw on this window", found.describe()));
        let [width, height] = [width.max(1), height.max(1)];
        let mut config = surface.get_default_config(&found.adapter, width, height).ok_or_else(cannot)?;
        // Colours are stored as they are shown.
        let plain = surface.get_capabilities(&found.adapter).formats.into_iter().find(|format| !format.is_srgb());
        config.format = plain.unwrap_or(config.format);
        fault::scoped(&found.device, || surface.configure(&found.device, &config))?;
        let canvas = Canvas::new(&found, config.format)?;
        let (device, queue) = (found.device.clone(), found.queue.clone());
        Ok((Self { surface, config, canvas, device, queue }, found))
    }
    /// Its canvas.
    pub fn canvas(&mut self) -> &mut Canvas {
        &mut self.canvas
    }
    /// Takes another size \[pixels\].
    ///
    /// # Errors
    /// When the device is lost or out of memory.
    pub fn resize(&mut self, [width, height]: [u32; 2]) -> Result<(), Error> {
        (self.config.width, self.config.height) = (width.max(1), height.max(1));
        self.configure()
    }
    fn configure(&mut self) -> Result<(), Error> {
        fault::scoped(&self.device, || self.surface.configure(&self.device, &self.config))
    }
    /// Paints controls, and shows them. A window that is hidden shows nothing.
    ///
    /// # Errors
    /// When the device is lost or out of memory.
    pub fn paint(&mut self, controls: &Controls) -> Result<(), Error> {
        let texture = match self.surface.get_current_texture() {
            wgpu::CurrentSurfaceTexture::Success(texture) => texture,
            other => {
                self.canvas.skip(controls)?;
                let hidden =
                    matches!(other, wgpu::CurrentSurfaceTexture::Timeout | wgpu::CurrentSurfaceTexture::Occluded);
                drop(other);
                return if hidden { Ok(()) } else { self.configure() };
            }
        };
        self.canvas.paint(&texture.texture, controls)?;
        self.queue.present(texture);
        Ok(())
    }
}
