//! A window that shares its device with a simulation and draws the position buffer: no copy, no read-back.
//!
//! `cargo run --release --example window`; space pauses, Escape ends. `--frames N --screenshot FILE` draws N frames, saves the last
//! one as a PNG and ends, so that it can be checked without a person. `--count N` takes another number of bodies.

#[path = "window/screenshot.rs"]
mod screenshot;

use std::sync::Arc;
use std::time::Instant;

use glam::Vec3;
use glam::camera::rh::{proj, view};
use motes::gpu::{self, Found};
use motes::settings::{Settings, Value};
use motes::{Bounds, Error, Gpu, POSITION, Setup, Simulation, forces, integrators, shapes, wgpu};
use winit::application::ApplicationHandler;
use winit::event::{ElementState, WindowEvent};
use winit::event_loop::{ActiveEventLoop, EventLoop};
use winit::keyboard::{Key, NamedKey};
use winit::window::{Window, WindowId};

const STEPS_PER_FRAME: u32 = 2;
const HALO: f64 = 0.4;

#[derive(Clone)]
struct Options {
    frames: Option<u64>,
    screenshot: Option<String>,
    count: u32,
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut options = Options { frames: None, screenshot: None, count: 8192 };
    let mut args = std::env::args().skip(1);
    while let Some(arg) = args.next() {
        let value = args.next().ok_or_else(|| format!("{arg} wants a value"))?;
        match arg.as_str() {
            "--frames" => options.frames = Some(value.parse()?),
            "--screenshot" => options.screenshot = Some(value),
            "--count" => options.count = value.parse()?,
            _ => return Err(format!("unknown argument {arg}: there are --frames, --screenshot and --count").into()),
        }
    }
    let mut app = App { options, state: None, failed: None };
    EventLoop::new()?.run_app(&mut app)?;
    app.failed.map_or(Ok(()), Err)
}

struct App {
    options: Options,
    state: Option<State>,
    failed: Option<Box<dyn std::error::Error>>,
}

impl ApplicationHandler for App {
    fn resumed(&mut self, events: &ActiveEventLoop) {
        let attributes =
            Window::default_attributes().with_title("motes").with_inner_size(winit::dpi::PhysicalSize::new(1024, 640));
        let state = events
            .create_window(attributes)
            .map_err(Into::into)
            .and_then(|window| State::new(window, self.options.count));
        match state {
            Ok(state) => self.state = Some(state),
            Err(error) => self.end(events, Some(error)),
        }
    }
    fn window_event(&mut self, events: &ActiveEventLoop, _: WindowId, event: WindowEvent) {
        let Some(state) = &mut self.state else { return };
        match event {
            WindowEvent::CloseRequested => self.end(events, None),
            WindowEvent::Resized(size) => state.resize(size.width, size.height),
            WindowEvent::KeyboardInput { event, .. } if event.state == ElementState::Pressed => match event.logical_key
            {
                Key::Named(NamedKey::Escape) => self.end(events, None),
                Key::Named(NamedKey::Space) => state.paused = !state.paused,
                _ => {}
            },
            WindowEvent::RedrawRequested => {
                let last = self.options.frames.is_some_and(|n| state.frames + 1 >= n);
                let file = self.options.screenshot.as_deref().filter(|_| last);
                if let Err(error) = state.frame(file) {
                    self.end(events, Some(error));
                } else if last {
                    println!("{} frames, {} steps", state.frames, state.simulation.steps());
                    self.end(events, None);
                } else {
                    state.window.request_redraw();
                }
            }
            _ => {}
        }
    }
}

impl App {
    fn end(&mut self, events: &ActiveEventLoop, error: Option<Box<dyn std::error::Error>>) {
        self.failed = error;
        self.state = None;
        events.exit();
    }
}

struct State {
    surface: wgpu::Surface<'static>,
    config: wgpu::SurfaceConfiguration,
    found: Found,
    simulation: Simulation<Gpu>,
    pipeline: wgpu::RenderPipeline,
    view: wgpu::Buffer,
    group: wgpu::BindGroup,
    /// The number of bodies in the disk; those of the halo follow.
    disk: f32,
    start: Instant,
    frames: u64,
    paused: bool,
    window: Arc<Window>,
}

impl State {
    fn new(window: Window, count: u32) -> Result<Self, Box<dyn std::error::Error>> {
        let window = Arc::new(window);
        let instance = gpu::instance();
        let surface = instance.create_surface(window.clone())?;
        // This device is ours as an app; the simulation borrows it.
        let mut adapters = pollster::block_on(gpu::adapters(&instance));
        adapters.retain(|adapter| adapter.is_surface_supported(&surface));
        let found = pollster::block_on(gpu::open(gpu::choose(adapters, &gpu::Choice::Best)?))?;
        let size = window.inner_size();
        let config = surface
            .get_default_config(&found.adapter, size.width.max(1), size.height.max(1))
            .ok_or("the adapter cannot draw on this window")?;
        surface.configure(&found.device, &config);
        let simulation = Simulation::new(&found.device, &found.queue, &setup(count)?)?;
        let (pipeline, view, group) = pipeline(&found.device, config.format);
        let state = Self {
            surface,
            config,
            found,
            simulation,
            pipeline,
            view,
            group,
            #[expect(clippy::cast_possible_truncation, reason = "a number of bodies")]
            disk: (f64::from(count) * (1.0 - HALO)) as f32,
            start: Instant::now(),
            frames: 0,
            paused: false,
            window: window.clone(),
        };
        window.request_redraw();
        Ok(state)
    }
    fn resize(&mut self, width: u32, height: u32) {
        (self.config.width, self.config.height) = (width.max(1), height.max(1));
        self.surface.configure(&self.found.device, &self.config);
    }

    /// Steps and draws, in one encoder and one submission.
    fn frame(&mut self, screenshot: Option<&str>) -> Result<(), Box<dyn std::error::Error>> {
        self.found.faults.check()?;
        self.look();
        let texture = match self.surface.get_current_texture() {
            wgpu::CurrentSurfaceTexture::Success(texture) => texture,
            wgpu::CurrentSurfaceTexture::Timeout | wgpu::CurrentSurfaceTexture::Occluded => return Ok(()),
            _ => {
                self.surface.configure(&self.found.device, &self.config);
                return Ok(());
            }
        };
        let mut encoder = self.found.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        if !self.paused {
            self.simulation.encode(STEPS_PER_FRAME, &mut encoder)?;
        }
        self.draw(&mut encoder, &texture.texture.create_view(&wgpu::TextureViewDescriptor::default()));
        self.found.queue.submit([encoder.finish()]);
        self.found.queue.present(texture);
        self.frames += 1;
        if let Some(file) = screenshot {
            self.screenshot()?.save(std::path::Path::new(file))?;
            // The alarm is read here only: no frame waits for it.
            pollster::block_on(self.simulation.check())?;
        }
        Ok(())
    }
    fn look(&self) {
        let angle = self.start.elapsed().as_secs_f32() * 0.1;
        let eye = Vec3::new(angle.cos(), angle.sin(), 0.6) * 14.0;
        #[expect(clippy::cast_precision_loss, reason = "a number of pixels")]
        let aspect = self.config.width as f32 / self.config.height as f32;
        let camera =
            proj::directx::perspective(0.8, aspect, 0.1, 1000.0) * view::look_at_mat4(eye, Vec3::ZERO, Vec3::Z);
        let mut words = camera.to_cols_array().to_vec();
        words.extend([aspect, 0.09, self.disk, 0.0]);
        let bytes: Vec<u8> = words.iter().flat_map(|w| w.to_le_bytes()).collect();
        self.found.queue.write_buffer(&self.view, 0, &bytes);
    }
    fn draw(&self, encoder: &mut wgpu::CommandEncoder, target: &wgpu::TextureView) {
        let Some(positions) = self.simulation.buffer(POSITION) else { return };
        let background = wgpu::Color { r: 0.004, g: 0.006, b: 0.012, a: 1.0 };
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view: target,
                depth_slice: None,
                resolve_target: None,
                ops: wgpu::Operations { load: wgpu::LoadOp::Clear(background), store: wgpu::StoreOp::Store },
            })],
            ..Default::default()
        });
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(0, &self.group, &[]);
        pass.set_vertex_buffer(0, positions.slice(..));
        pass.draw(0..4, 0..self.simulation.count());
    }
}

fn setup(count: u32) -> Result<Setup, Error> {
    let absent = || Error::Scene("a part of the register is missing".to_owned());
    let disk = shapes::shape("disk").ok_or_else(absent)?;
    let settings = Settings::defaults(disk.keys)
        .with("count", Value::Number(f64::from(count)))
        .with("halo_fraction", Value::Number(HALO));
    let gravity = forces::entry("gravity").ok_or_else(absent)?;
    let softened = Settings::defaults(gravity.keys).with("softening", Value::Number(0.15));
    Ok(Setup {
        state: (disk.build)(&settings)?,
        forces: vec![(gravity.build)(&softened)],
        integrator: Box::new(integrators::Leapfrog),
        dt: 0.05,
        bounds: Bounds::default(),
        solver: motes::Solver::default(),
    })
}

fn pipeline(
    device: &wgpu::Device,
    format: wgpu::TextureFormat,
) -> (wgpu::RenderPipeline, wgpu::Buffer, wgpu::BindGroup) {
    let module = device.create_shader_module(wgpu::include_wgsl!("window/window.wgsl"));
    let add = wgpu::BlendComponent {
        src_factor: wgpu::BlendFactor::One,
        dst_factor: wgpu::BlendFactor::One,
        operation: wgpu::BlendOperation::Add,
    };
    let pipeline = device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: None,
        layout: None,
        vertex: wgpu::VertexState {
            module: &module,
            entry_point: Some("vertex"),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            // One position for each instance: the simulation's buffer as it is.
            buffers: &[Some(wgpu::VertexBufferLayout {
                array_stride: 16,
                step_mode: wgpu::VertexStepMode::Instance,
                attributes: &wgpu::vertex_attr_array![0 => Float32x4],
            })],
        },
        primitive: wgpu::PrimitiveState { topology: wgpu::PrimitiveTopology::TriangleStrip, ..Default::default() },
        depth_stencil: None,
        multisample: wgpu::MultisampleState::default(),
        fragment: Some(wgpu::FragmentState {
            module: &module,
            entry_point: Some("fragment"),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            targets: &[Some(wgpu::ColorTargetState {
                format,
                blend: Some(wgpu::BlendState { color: add, alpha: add }),
                write_mask: wgpu::ColorWrites::ALL,
            })],
        }),
        multiview_mask: None,
        cache: None,
    });
    let usage = wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST;
    let view =
        device.create_buffer(&wgpu::BufferDescriptor { label: None, size: 80, usage, mapped_at_creation: false });
    let group = device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: None,
        layout: &pipeline.get_bind_group_layout(0),
        entries: &[wgpu::BindGroupEntry { binding: 0, resource: view.as_entire_binding() }],
    });
    (pipeline, view, group)
}
