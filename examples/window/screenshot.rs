//! Draws a frame into a texture that can be read, for `--screenshot`.

use motes::render::Image;
use motes::{Error, wgpu};

use super::State;

impl State {
    /// The same frame once more, into a texture that can be read.
    pub fn screenshot(&self) -> Result<Image, Error> {
        let (width, height) = (self.config.width, self.config.height);
        let size = wgpu::Extent3d { width, height, depth_or_array_layers: 1 };
        let texture = self.found.device.create_texture(&wgpu::TextureDescriptor {
            label: None,
            size,
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: self.config.format,
            usage: wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::COPY_SRC,
            view_formats: &[],
        });
        let row = (width * 4).next_multiple_of(256);
        let buffer = self.found.device.create_buffer(&wgpu::BufferDescriptor {
            label: None,
            size: u64::from(row) * u64::from(height),
            usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
            mapped_at_creation: false,
        });
        let mut encoder = self.found.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        self.draw(&mut encoder, &texture.create_view(&wgpu::TextureViewDescriptor::default()));
        let layout = wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(row), rows_per_image: None };
        encoder.copy_texture_to_buffer(
            texture.as_image_copy(),
            wgpu::TexelCopyBufferInfo { buffer: &buffer, layout },
            size,
        );
        self.found.queue.submit([encoder.finish()]);
        buffer.map_async(wgpu::MapMode::Read, .., |_| {});
        let failed = |error: String| Error::Device(error);
        let wait = wgpu::PollType::Wait { submission_index: None, timeout: Some(std::time::Duration::from_mins(1)) };
        self.found.device.poll(wait).map_err(|e| failed(e.to_string()))?;
        let bytes = buffer.get_mapped_range(..).map_err(|e| failed(e.to_string()))?.to_vec();
        let blue_first =
            matches!(self.config.format, wgpu::TextureFormat::Bgra8Unorm | wgpu::TextureFormat::Bgra8UnormSrgb);
        let mut rgba = Vec::with_capacity(width as usize * height as usize * 4);
        for line in bytes.chunks(row as usize) {
            for pixel in line.chunks_exact(4).take(width as usize) {
                let (r, b) = if blue_first { (pixel[2], pixel[0]) } else { (pixel[0], pixel[2]) };
                rgba.extend([r, pixel[1], b, 255]);
            }
        }
        Ok(Image { width, height, rgba, outside: 0, broken: 0 })
    }
}
