//! The backend that runs the references: f64 on the host, over all cores, with no driver at all.

use std::collections::BTreeMap;
use std::sync::{Arc, OnceLock};
use std::task::Waker;

use crate::error::Error;
use crate::kernel::{Access, Array, Arrival, Backend, Host, Machine, Next, POSITION, Plan, VELOCITY, World};

/// The number of threads for kernels. They are started here, once; a program that has built rayon's global pool itself keeps it.
///
/// # Errors
/// [`Error::Threads`] when the system cannot start any.
pub fn threads() -> Result<usize, Error> {
    static POOL: OnceLock<Result<(), String>> = OnceLock::new();
    // There rayon makes do with the thread that there is, unless it is asked.
    if cfg!(target_family = "wasm") {
        return Ok(rayon::current_num_threads());
    }
    let pool = POOL.get_or_init(|| match rayon::ThreadPoolBuilder::new().build_global() {
        // Without a cause there is a pool already.
        Err(why) => std::error::Error::source(&why).map_or(Ok(()), |cause| Err(cause.to_string())),
        Ok(()) => Ok(()),
    });
    pool.clone().map(|()| rayon::current_num_threads()).map_err(Error::Threads)
}

/// Runs plans by their references.
pub struct Cpu {
    host: Host,
    count: usize,
    saved: Saved,
}

/// Copies of arrays and of the clock, from which steps are repeated.
#[derive(Default)]
struct Saved {
    arrays: BTreeMap<String, Arc<Array>>,
    world: World,
}

impl Cpu {
    /// For `count` particles.
    ///
    /// # Errors
    /// [`Error::Scene`] when there are none, [`Error::Threads`] when no thread can be started.
    pub fn new(count: u32) -> Result<Self, Error> {
        threads()?;
        if count == 0 {
            return Err(Error::Scene("there are no particles: a simulation needs one or more".to_owned()));
        }
        let mut host = Host::default();
        // A reference may read more of a particle than its shader does.
        for always in [POSITION.name, VELOCITY.name] {
            host.insert(always, Array::Vec4(Vec::new()).zeros(count as usize));
        }
        Ok(Self { host, count: count as usize, saved: Saved::default() })
    }
    /// The arrays, as the references see them.
    #[must_use]
    pub fn host(&self) -> &Host {
        &self.host
    }
    /// The same, for fields that no plan has made.
    pub fn host_mut(&mut self) -> &mut Host {
        &mut self.host
    }
}

impl Backend for Cpu {
    type Program = Plan;

    fn machine(&self) -> Machine {
        Machine::HOST
    }
    fn host(&self) -> Option<&Host> {
        Some(&self.host)
    }
    fn compile(&mut self, plan: &Plan) -> Result<Plan, Error> {
        for kernel in &plan.kernels {
            if kernel.reference.is_none() {
                let text = format!(
                    "`{}` is a WGSL file without an f64 reference: it needs a GPU or a software driver, not --backend cpu",
                    kernel.name
                );
                return Err(Error::Scene(text));
            }
            for (field, binding) in kernel.bindings().filter(|(_, b)| b.access != Access::Uniform) {
                if self.host.contains(field) || kernel.is_scratch(field) || field == "world" {
                    continue;
                }
                let elements = kernel.size(field).map_or(self.count, |n| usize::try_from(n).unwrap_or(usize::MAX));
                let zeros = binding.zeros(elements);
                let table = plan.table(field).map(|words| zeros.like(bytemuck::cast_slice(words)));
                self.host.insert(field, table.unwrap_or(zeros));
            }
        }
        Ok(plan.clone())
    }
    fn run(&mut self, program: &Plan, times: u32) -> Result<(), Error> {
        let host = &self.host;
        for _ in 0..times {
            // Within the pool: kernels of few particles end before another thread would be awake.
            rayon::scope(|_| -> Result<(), Error> {
                let mut walk = program.walk();
                while let Some(next) = walk.next() {
                    match next {
                        Next::Run(kernel) => kernel.reference.as_ref().map_or(Ok(()), |reference| reference(host))?,
                        Next::Ask(flag) if host.is_set(flag)? => walk.leave(),
                        Next::Ask(_) => {}
                    }
                }
                Ok(())
            })?;
        }
        Ok(())
    }
    fn set_world(&mut self, world: World) -> Result<(), Error> {
        self.host.set_world(world);
        Ok(())
    }
    fn alike(&self, rows: u32) -> Result<Self, Error> {
        Self::new(rows)
    }
    fn resize(&mut self, rows: u32) {
        self.count = rows as usize;
        for always in [POSITION.name, VELOCITY.name] {
            self.host.insert(always, Array::Vec4(Vec::new()).zeros(self.count));
        }
    }
    fn set_rows(&mut self, count: u32, free: u32) -> Result<(), Error> {
        self.host.set_world(World { count, free, ..self.host.world() });
        Ok(())
    }
    fn save(&mut self, fields: &[String]) -> Result<(), Error> {
        let all = self.host.arrays()?;
        let missing = |name: &String| Error::Device(format!("there is no field `{name}` on the host"));
        let copy = |name: &String| {
            let array = all.get(name.as_str()).ok_or_else(|| missing(name))?;
            Ok((name.clone(), Arc::clone(array)))
        };
        self.saved = Saved { arrays: fields.iter().map(copy).collect::<Result<_, Error>>()?, world: self.host.world() };
        Ok(())
    }
    fn restore(&mut self) -> Result<(), Error> {
        for (name, array) in &self.saved.arrays {
            self.host.replace(name, Array::clone(array))?;
        }
        self.host.set_world(self.saved.world);
        Ok(())
    }
    fn write_at(&mut self, name: &str, first: usize, array: &Array) -> Result<(), Error> {
        self.host.fill(name, first, array)
    }
    fn forget(&mut self, name: &str) {
        self.host.remove(name);
    }
    async fn read(&mut self, name: &str, like: &Array, len: usize) -> Result<Array, Error> {
        self.copy(name, like, len)
    }
    fn request(&mut self, name: &str, like: &Array, len: usize) -> Result<Box<dyn Arrival>, Error> {
        Ok(Box::new(Copied(Some(self.copy(name, like, len)?))))
    }
}

/// A copy that waits for nothing.
struct Copied(Option<Array>);

impl Arrival for Copied {
    fn look(&mut self) -> Option<Result<Array, Error>> {
        self.0.take().map(Ok)
    }
    fn wake(&mut self, waker: &Waker) {
        waker.wake_by_ref();
    }
}

impl Cpu {
    fn copy(&self, name: &str, like: &Array, len: usize) -> Result<Array, Error> {
        let missing = || Error::Device(format!("there is no field `{name}` on the host"));
        let mut array = self.host.get(name).ok_or_else(missing)?;
        match &mut array {
            Array::Vec4(a) => a.truncate(len),
            Array::Float(a) => a.truncate(len),
            Array::Vec3(a) => a.truncate(len),
            Array::Uint(a) => a.truncate(len),
        }
        if std::mem::discriminant(&array) == std::mem::discriminant(like) { Ok(array) } else { Err(missing()) }
    }
}
