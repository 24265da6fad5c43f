//! Adapters: their list, the choice of one, and the features and limits of its device.

use super::{Faults, driver};
use crate::error::Error;
use crate::kernel::Machine;

/// The choice of an adapter.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub enum Choice {
    /// The fastest kind available: discrete, integrated, virtual, software.
    #[default]
    Best,
    /// By its index in [`adapters`], or by a part of its name in upper or lower case.
    Named(String),
}

/// A device of our own.
pub struct Found {
    /// The adapter.
    pub adapter: wgpu::Adapter,
    /// The device, with the optional features and limits that kernels can use.
    pub device: wgpu::Device,
    /// Its queue.
    pub queue: wgpu::Queue,
    /// Errors of the device that were reported outside of any call.
    pub faults: Faults,
}

/// The advice where there is no driver.
#[cfg(target_arch = "wasm32")]
pub const NO_DRIVER: &str =
    "this browser gives no GPU: it needs WebGPU, a page by https or from this machine, and a GPU that it trusts";
/// The advice where there is no driver.
#[cfg(not(target_arch = "wasm32"))]
pub const NO_DRIVER: &str = "no GPU driver was found (on Debian or Ubuntu `apt-get install mesa-vulkan-drivers` brings a fast one that \
                             runs on the processor)";

impl Found {
    /// Name, kind, backend and driver.
    #[must_use]
    pub fn describe(&self) -> String {
        describe(&self.adapter.get_info())
    }
    /// The reason why OpenGL runs the kernels, if it was not chosen.
    #[must_use]
    pub fn substitute(&self) -> Option<String> {
        driver::substitute(&self.adapter.get_info())
    }
    /// Whether it is a software adapter.
    #[must_use]
    pub fn software(&self) -> bool {
        self.adapter.get_info().device_type == wgpu::DeviceType::Cpu
    }
    /// What the device binds and dispatches, and which optional features kernels use, by name.
    #[must_use]
    pub fn facts(&self) -> Vec<(&'static str, String)> {
        let (limits, info) = (self.device.limits(), self.adapter.get_info());
        let largest = bindable(&limits);
        let offered = |feature| if self.device.features().contains(feature) { "yes" } else { "no" }.to_owned();
        vec![
            ("largest field", format!("{} MiB, {} particles", largest >> 20, largest / 16)),
            ("workgroup memory", format!("{} KiB", limits.max_compute_workgroup_storage_size >> 10)),
            ("storage buffers", format!("{} in one kernel", limits.max_storage_buffers_per_shader_stage)),
            ("workgroups", format!("{} in one dimension", limits.max_compute_workgroups_per_dimension)),
            (
                "subgroups",
                format!(
                    "{}, of {} to {} lanes",
                    offered(wgpu::Features::SUBGROUP),
                    info.subgroup_min_size,
                    info.subgroup_max_size
                ),
            ),
            ("timestamps", offered(wgpu::Features::TIMESTAMP_QUERY)),
        ]
    }
}

/// An instance, as set by the environment (`WGPU_BACKEND` …); if that is not set, without OpenGL, whose drivers write to standard error
/// where there is no desktop.
#[must_use]
pub fn instance() -> wgpu::Instance {
    instance_of(wgpu::Backends::PRIMARY)
}

fn instance_of(backends: wgpu::Backends) -> wgpu::Instance {
    let default = wgpu::InstanceDescriptor::new_without_display_handle();
    wgpu::Instance::new(wgpu::InstanceDescriptor { backends, flags: flags(), ..default }.with_env())
}

/// The checks of an instance. Indirect arguments of this crate are workgroup counts that fit the device, or zero, and no user's shader can
/// write them. Checking them on the device costs a dispatch and two barriers for each indirect dispatch: without the check, an unneeded
/// iteration of a solver takes 1 µs instead of 60 µs on lavapipe. Direct3D 12 needs the check, which passes the workgroup counts to
/// shaders.
#[must_use]
pub fn flags() -> wgpu::InstanceFlags {
    let checked =
        if cfg!(windows) { wgpu::InstanceFlags::VALIDATION_INDIRECT_CALL } else { wgpu::InstanceFlags::empty() };
    wgpu::InstanceFlags::from_build_config().difference(wgpu::InstanceFlags::VALIDATION_INDIRECT_CALL) | checked
}

/// All adapters, best first. Those of OpenGL are only listed where there are no others.
pub async fn adapters(instance: &wgpu::Instance) -> Vec<wgpu::Adapter> {
    let mut all = instance.enumerate_adapters(wgpu::Backends::all()).await;
    if all.is_empty() {
        all = instance_of(wgpu::Backends::SECONDARY).enumerate_adapters(wgpu::Backends::all()).await;
    }
    all.retain(|a| a.get_downlevel_capabilities().flags.contains(wgpu::DownlevelFlags::COMPUTE_SHADERS));
    all.sort_by_key(|a| rank(&a.get_info()));
    all
}

fn rank(info: &wgpu::AdapterInfo) -> (u8, u8) {
    let kind = match info.device_type {
        wgpu::DeviceType::DiscreteGpu => 0,
        wgpu::DeviceType::IntegratedGpu => 1,
        wgpu::DeviceType::VirtualGpu => 2,
        wgpu::DeviceType::Other => 3,
        wgpu::DeviceType::Cpu => 4,
    };
    (kind, u8::from(info.backend == wgpu::Backend::Gl))
}

/// The chosen one of them.
///
/// # Errors
/// [`Error::NoAdapter`] that lists the available ones.
pub fn choose(mut adapters: Vec<wgpu::Adapter>, choice: &Choice) -> Result<wgpu::Adapter, Error> {
    if adapters.is_empty() {
        return Err(Error::NoAdapter(NO_DRIVER.to_owned()));
    }
    let index = match choice {
        Choice::Best => Some(0),
        Choice::Named(name) => name.parse().ok().filter(|i| *i < adapters.len()).or_else(|| {
            let wanted = name.to_lowercase();
            adapters.iter().position(|a| describe(&a.get_info()).to_lowercase().contains(&wanted))
        }),
    };
    match (index, choice) {
        (Some(index), _) => Ok(adapters.swap_remove(index)),
        (None, Choice::Named(name)) => {
            let list: Vec<_> =
                adapters.iter().enumerate().map(|(i, a)| format!("\n  {i}: {}", describe(&a.get_info()))).collect();
            Err(Error::NoAdapter(format!("no adapter is called `{name}`; there is{}", list.concat())))
        }
        (None, Choice::Best) => Err(Error::NoAdapter("no adapter".to_owned())),
    }
}

/// The optional features of an adapter that kernels can use. None is required: a device with [`wgpu::Features::empty`] runs everything.
///
/// * `SUBGROUP` increases speed: lanes broadcast particles and tree nodes to each other, mostly on software adapters.
/// * `TIMESTAMP_QUERY` provides times of the device's own clock, in [`Gpu::timed`](crate::Gpu::timed), the benches and `motes doctor`.
#[must_use]
pub fn wanted_features(adapter: &wgpu::Adapter) -> wgpu::Features {
    adapter.features() & (wgpu::Features::SUBGROUP | wgpu::Features::TIMESTAMP_QUERY)
}

/// The limits of an adapter that kernels can use: WebGPU's defaults, and the largest buffers and bindings that it offers. None above
/// [`wgpu::Limits::default`] is required; `max_buffer_size` and `max_storage_buffer_binding_size` allow more particles: a field has 16
/// bytes per particle, so that the default of 128 MiB suffices for 8 million.
#[must_use]
pub fn wanted_limits(adapter: &wgpu::Adapter) -> wgpu::Limits {
    let offered = adapter.limits();
    wgpu::Limits {
        max_buffer_size: offered.max_buffer_size,
        max_storage_buffer_binding_size: offered.max_storage_buffer_binding_size,
        ..wgpu::Limits::default().or_worse_values_from(&offered)
    }
}

/// Opens a device with [`wanted_features`] and [`wanted_limits`].
///
/// # Errors
/// [`Error::NoAdapter`] when the adapter refuses.
pub async fn open(adapter: wgpu::Adapter) -> Result<Found, Error> {
    let descriptor = wgpu::DeviceDescriptor {
        label: Some("motes"),
        required_features: wanted_features(&adapter),
        required_limits: wanted_limits(&adapter),
        ..Default::default()
    };
    let opened = adapter.request_device(&descriptor).await;
    let (device, queue) =
        opened.map_err(|e| Error::NoAdapter(format!("{} opens no device: {e}", describe(&adapter.get_info()))))?;
    let faults = Faults::listen(&device);
    Ok(Found { adapter, device, queue, faults })
}

/// Opens the best available device: discrete, integrated, virtual, software, in this order.
///
/// # Errors
/// [`Error::NoAdapter`] when there is none.
pub async fn best() -> Result<Found, Error> {
    open(choose(adapters(&instance()).await, &Choice::Best)?).await
}

/// Name, kind, backend and driver.
pub(super) fn describe(info: &wgpu::AdapterInfo) -> String {
    let kind = match info.device_type {
        wgpu::DeviceType::DiscreteGpu => "discrete GPU",
        wgpu::DeviceType::IntegratedGpu => "integrated GPU",
        wgpu::DeviceType::VirtualGpu => "virtual GPU",
        wgpu::DeviceType::Cpu => "software, on the processor",
        wgpu::DeviceType::Other => "unknown kind",
    };
    let driver = [info.driver.as_str(), info.driver_info.as_str()].join(" ");
    format!("{} ({kind}, {:?}, {})", info.name, info.backend, driver.trim())
}

/// The maximum number of bytes of a field.
pub(super) fn bindable(limits: &wgpu::Limits) -> u64 {
    limits.max_buffer_size.min(limits.max_storage_buffer_binding_size)
}

/// The number of invocations that a device of a kind runs at once, and of pair evaluations that it ends within a tenth of a second. A large
/// GPU runs about a quarter of a million invocations; a software adapter needs one workgroup per core. The slowest discrete GPUs are
/// expected to evaluate 4·10¹⁰ pairs per second, integrated ones 2·10¹⁰.
fn extent(kind: wgpu::DeviceType) -> (u32, u64) {
    match kind {
        wgpu::DeviceType::Cpu => (256, 1 << 30),
        wgpu::DeviceType::DiscreteGpu => (1 << 18, 1 << 32),
        wgpu::DeviceType::IntegratedGpu => (1 << 16, 1 << 31),
        wgpu::DeviceType::VirtualGpu | wgpu::DeviceType::Other => (1 << 18, 1 << 30),
    }
}

/// The properties of a device that kernels depend on.
pub(super) fn machine(device: &wgpu::Device) -> Machine {
    let info = device.adapter_info();
    let software = info.device_type == wgpu::DeviceType::Cpu;
    let fixed = info.subgroup_min_size == info.subgroup_max_size;
    // A browser's compiler requires `enable subgroups;`, which naga does not support.
    let usable = device.features().contains(wgpu::Features::SUBGROUP) && fixed && cfg!(not(target_arch = "wasm32"));
    let subgroup = if usable { info.subgroup_min_size } else { 0 };
    let (invocations, meetings) = extent(info.device_type);
    let limits = device.limits();
    let workgroups = limits.max_compute_workgroups_per_dimension;
    let turns = if software { Machine::TURNS } else { u32::MAX };
    Machine { software, subgroup, invocations, meetings, bindable: bindable(&limits), workgroups, turns }
}
