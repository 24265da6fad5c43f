//! What a window shows: a picture that a buffer holds, and controls beside it, which egui paints.

use egui::epaint::ImageDelta;
use egui::{ClippedPrimitive, Context, FullOutput, TextureId};
use egui_wgpu::{Renderer, RendererOptions, ScreenDescriptor};

use super::adapter::Found;
use super::submit::Queue;
use super::{fault, read};
use crate::error::Error;

/// Rows of a copy begin at multiples of so many pixels.
pub const ROW: u32 = 64;

/// Controls, as egui gives them.
pub struct Controls {
    primitives: Vec<ClippedPrimitive>,
    /// Textures that are new, and those that are no longer used.
    new: Vec<(TextureId, ImageDelta)>,
    free: Vec<TextureId>,
    /// Pixels per point.
    scale: f32,
}

impl Controls {
    /// What a pass of egui has made.
    #[must_use]
    pub fn of(context: &Context, output: FullOutput) -> Self {
        let FullOutput { shapes, mut textures_delta, pixels_per_point: scale, .. } = output;
        let set = std::mem::take(&mut textures_delta.set);
        let new = set.into_iter().flat_map(|(id, deltas)| deltas.into_iter().map(move |delta| (id, delta))).collect();
        let free = std::mem::take(&mut textures_delta.free).into_iter().collect();
        Self { primitives: context.tessellate(shapes, scale), new, free, scale }
    }
}

/// A device's means to paint controls and a picture.
pub struct Canvas {
    device: wgpu::Device,
    queue: wgpu::Queue,
    format: wgpu::TextureFormat,
    renderer: Renderer,
    picture: Option<(wgpu::Texture, TextureId)>,
}

impl Canvas {
    pub(super) fn new(found: &Found, format: wgpu::TextureFormat) -> Result<Self, Error> {
        let (device, queue) = (found.device.clone(), found.queue.clone());
        let renderer = fault::scoped(&device, || Renderer::new(&device, format, RendererOptions::default()))?;
        Ok(Self { device, queue, format, renderer, picture: None })
    }
    /// Takes a picture out of a buffer with a word for each pixel, red first; its width is a multiple of [`ROW`].
    ///
    /// # Errors
    /// When the device is lost or out of memory, or the buffer is shorter.
    pub fn take(&mut self, pixels: &wgpu::Buffer, [width, height]: [u32; 2]) -> Result<TextureId, Error> {
        let size = wgpu::Extent3d { width, height, depth_or_array_layers: 1 };
        let (device, queue, renderer) = (&self.device, &self.queue, &mut self.renderer);
        let old = self.picture.take();
        let (texture, id) = match old {
            Some((texture, id)) if texture.size() == size => (texture, id),
            old => fault::scoped(device, || {
                let texture = device.create_texture(&wgpu::TextureDescriptor {
                    label: Some("picture"),
                    size,
                    mip_level_count: 1,
                    sample_count: 1,
                    dimension: wgpu::TextureDimension::D2,
                    // Colours are mixed as they are stored.
                    format: wgpu::TextureFormat::Rgba8Unorm,
                    usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST,
                    view_formats: &[],
                });
                let view = texture.create_view(&wgpu::TextureViewDescriptor::default());
                let filter = wgpu::FilterMode::Linear;
                let id = match old {
                    Some((_, id)) => {
                        renderer.update_egui_texture_from_wgpu_texture(device, &view, filter, id);
                        id
                    }
                    None => renderer.register_native_texture(device, &view, filter),
                };
                (texture, id)
            })?,
        };
        fault::scoped(device, || {
            let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
            let layout =
                wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(4 * width), rows_per_image: None };
            let from = wgpu::TexelCopyBufferInfo { buffer: pixels, layout };
            encoder.copy_buffer_to_texture(from, texture.as_image_copy(), size);
            queue.submit([encoder.finish()]);
        })?;
        self.picture = Some((texture, id));
        Ok(id)
    }
    /// Takes the new textures of controls that are not painted.
    pub(super) fn skip(&mut self, controls: &Controls) -> Result<(), Error> {
        let (device, queue, renderer) = (&self.device, &self.queue, &mut self.renderer);
        fault::scoped(device, || {
            controls.new.iter().for_each(|(id, delta)| renderer.update_texture(device, queue, *id, delta));
            controls.free.iter().for_each(|id| renderer.free_texture(id));
        })
    }
    /// Paints controls on all of a texture, and submits.
    pub(super) fn paint(&mut self, target: &wgpu::Texture, controls: &Controls) -> Result<(), Error> {
        let (device, queue, renderer) = (&self.device, &self.queue, &mut self.renderer);
        let screen =
            ScreenDescriptor { size_in_pixels: [target.width(), target.height()], pixels_per_point: controls.scale };
        fault::scoped(device, || {
            controls.new.iter().for_each(|(id, delta)| renderer.update_texture(device, queue, *id, delta));
            let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
            let mut buffers = renderer.update_buffers(device, queue, &mut encoder, &controls.primitives, &screen);
            let view = target.create_view(&wgpu::TextureViewDescriptor::default());
            let pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
                label: Some("controls"),
                color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                    view: &view,
                    depth_slice: None,
                    resolve_target: None,
                    ops: wgpu::Operations {
                        load: wgpu::LoadOp::Clear(wgpu::Color::BLACK),
                        store: wgpu::StoreOp::Store,
                    },
                })],
                ..Default::default()
            });
            renderer.render(&mut pass.forget_lifetime(), &controls.primitives, &screen);
            buffers.push(encoder.finish());
            queue.submit(buffers);
            controls.free.iter().for_each(|id| renderer.free_texture(id));
        })
    }
}

/// A picture of a window that is on no screen.
pub struct Sheet {
    canvas: Canvas,
    texture: wgpu::Texture,
}

impl Sheet {
    /// A sheet of this size \[pixels\].
    ///
    /// # Errors
    /// When the device is lost or out of memory.
    pub fn new(found: &Found, [width, height]: [u32; 2]) -> Result<Self, Error> {
        let canvas = Canvas::new(found, wgpu::TextureFormat::Rgba8Unorm)?;
        let texture = fault::scoped(&found.device, || {
            found.device.create_texture(&wgpu::TextureDescriptor {
                label: Some("sheet"),
                size: wgpu::Extent3d { width: width.next_multiple_of(ROW), height, depth_or_array_layers: 1 },
                mip_level_count: 1,
                sample_count: 1,
                dimension: wgpu::TextureDimension::D2,
                format: canvas.format,
                usage: wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::COPY_SRC,
                view_formats: &[],
            })
        })?;
        Ok(Self { canvas, texture })
    }
    /// Its canvas.
    pub fn canvas(&mut self) -> &mut Canvas {
        &mut self.canvas
    }
    /// Its pixels, from left to right and from top to bottom.
    #[must_use]
    pub fn size(&self) -> [u32; 2] {
        [self.texture.width(), self.texture.height()]
    }
    /// Paints controls on it.
    ///
    /// # Errors
    /// When the device is lost or out of memory.
    pub fn paint(&mut self, controls: &Controls) -> Result<(), Error> {
        self.canvas.paint(&self.texture, controls)
    }
    /// Reads it: red, green, blue and alpha of each pixel, row by row from the top.
    ///
    /// # Errors
    /// When the device is lost, out of memory or does not answer in time.
    pub async fn read(&self) -> Result<Vec<u8>, Error> {
        let (device, [width, height]) = (&self.canvas.device, self.size());
        let bytes = 4 * u64::from(width) * u64::from(height);
        let buffer = fault::scoped(device, || {
            let usage = wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::COPY_SRC;
            let descriptor =
                wgpu::BufferDescriptor { label: Some("sheet"), size: bytes, usage, mapped_at_creation: false };
            let buffer = device.create_buffer(&descriptor);
            let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
            let layout =
                wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(4 * width), rows_per_image: None };
            let to = wgpu::TexelCopyBufferInfo { buffer: &buffer, layout };
            encoder.copy_texture_to_buffer(self.texture.as_image_copy(), to, self.texture.size());
            self.canvas.queue.submit([encoder.finish()]);
            buffer
        })?;
        let mut queue = Queue::new(device.clone(), self.canvas.queue.clone());
        read::bytes(device, &mut queue, &buffer, 0, bytes).await
    }
}
