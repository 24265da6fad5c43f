//! A small renderer: a frame encodes steps and a draw call into one encoder, and draws from the simulation's own buffer, into a texture.
//! `cargo run --release --example renderer`; `window` draws on a screen.

use std::error::Error;

use motes::typed::{Gravity, default, plummer};
use motes::{POSITION, Setup, Simulation, gpu, wgpu};

const SIDE: u32 = 256;
const SHADER: &str = "@vertex fn vertex(@location(0) particle: vec4f) -> @builtin(position) vec4f {
    return vec4f(particle.xy / 3.0, 0.5, 1.0);
}
@fragment fn fragment() -> @location(0) vec4f { return vec4f(0.3, 0.5, 1.0, 1.0); }";

/// Draws points out of a buffer of four numbers each.
fn points(device: &wgpu::Device, format: wgpu::TextureFormat) -> wgpu::RenderPipeline {
    let source = wgpu::ShaderSource::Wgsl(SHADER.into());
    let module = &device.create_shader_module(wgpu::ShaderModuleDescriptor { label: None, source });
    let attributes = &wgpu::vertex_attr_array![0 => Float32x4];
    let step_mode = wgpu::VertexStepMode::Vertex;
    let buffers = &[Some(wgpu::VertexBufferLayout { array_stride: 16, step_mode, attributes })];
    let (entry_point, targets) = (None, &[Some(format.into())]);
    device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: None,
        layout: None,
        vertex: wgpu::VertexState { module, entry_point, compilation_options: default(), buffers },
        primitive: wgpu::PrimitiveState { topology: wgpu::PrimitiveTopology::PointList, ..default() },
        depth_stencil: None,
        multisample: default(),
        fragment: Some(wgpu::FragmentState { module, entry_point, compilation_options: default(), targets }),
        multiview_mask: None,
        cache: None,
    })
}

pub(crate) fn main() -> Result<(), Box<dyn Error>> {
    let setup = Setup::new(plummer(2000).build()?, vec![Gravity { softening: 0.05, ..default() }.into()], 0.01);
    // A device of the renderer's own; the simulation borrows it.
    let gpu::Found { device, queue, .. } = &pollster::block_on(gpu::best())?;
    let mut simulation = Simulation::new(device, queue, &setup)?;
    let pipeline = points(device, wgpu::TextureFormat::Rgba8Unorm);
    let image = device.create_texture(&wgpu::TextureDescriptor {
        label: None,
        size: wgpu::Extent3d { width: SIDE, height: SIDE, depth_or_array_layers: 1 },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: wgpu::TextureFormat::Rgba8Unorm,
        usage: wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::COPY_SRC,
        view_formats: &[],
    });
    let (view, size) = (&image.create_view(&default()), u64::from(4 * SIDE * SIDE));
    let usage = wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST;
    let buffer = &device.create_buffer(&wgpu::BufferDescriptor { label: None, size, usage, mapped_at_creation: false });
    for _ in 0..10 {
        let mut encoder = device.create_command_encoder(&default());
        simulation.encode(2, &mut encoder)?;
        let (resolve_target, depth_slice, ops) = (None, None, default());
        let target = wgpu::RenderPassColorAttachment { view, depth_slice, resolve_target, ops };
        let targets = wgpu::RenderPassDescriptor { color_attachments: &[Some(target)], ..default() };
        let mut pass = encoder.begin_render_pass(&targets);
        pass.set_pipeline(&pipeline);
        pass.set_vertex_buffer(0, simulation.buffer(POSITION).ok_or("positions are always there")?.slice(..));
        pass.draw(0..simulation.count(), 0..1);
        drop(pass);
        let layout = wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(4 * SIDE), rows_per_image: None };
        encoder.copy_texture_to_buffer(
            image.as_image_copy(),
            wgpu::TexelCopyBufferInfo { buffer, layout },
            image.size(),
        );
        queue.submit([encoder.finish()]);
    }
    buffer.map_async(wgpu::MapMode::Read, .., |_| ());
    device.poll(wgpu::PollType::wait_indefinitely())?;
    let lit = buffer.get_mapped_range(..)?.chunks_exact(4).filter(|pixel| pixel[2] > 0).count();
    assert!(lit > 300, "only {lit} pixels are lit");
    println!("{} steps, {lit} of {} pixels are lit", simulation.steps(), SIDE * SIDE);
    Ok(())
}
