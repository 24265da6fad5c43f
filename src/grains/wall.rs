//! A wall that grains touch: its kernels, for its pose and for the forces on grains.

use std::sync::Arc;

use glam::{DQuat, DVec3, DVec4, Vec4};

use super::force::force;
use super::{Ball, Balls, ContactForce, Material, Meeting, WORDS, Wound, moment};
use crate::error::Error;
use crate::kernel::{ACCELERATION, Bounds, Host, Kernel, Pass, Problem, Scalar, Shader, Source, time};
use crate::motion::Motion;
use crate::solids::Solid;
use crate::state::State;

/// A wall in a problem.
#[derive(Clone)]
pub struct Surface {
    /// Its shape.
    pub shape: Solid,
    /// 1, or −1 for a container.
    pub side: f64,
    /// Contacts that a grain may have with it at the same time: of a box with grains inside one along each axis.
    pub contacts: u32,
    /// Words of history that each particle has.
    pub words: u32,
    /// Its initial position \[length\].
    pub position: DVec3,
    /// The species that it acts on, if not all.
    pub species: Option<u32>,
    /// Its material.
    pub material: Material,
    /// The number of its motion, and the motion.
    pub motion: Option<(u32, Motion)>,
}

/// The names of the buffers of the wall with so many before it.
#[must_use]
pub fn own(what: &str, earlier: usize) -> String {
    if earlier == 0 { format!("wall_{what}") } else { format!("wall_{}_{what}", earlier + 1) }
}

/// Elements of a pose.
const FRAME: u64 = 5;

/// The pose of a wall: its centre, the pivot of its motion, its turn, and its rates.
struct Frame {
    centre: DVec3,
    pivot: DVec3,
    turn: DQuat,
    velocity: DVec3,
    spin: DVec3,
}

impl Frame {
    fn still(centre: DVec3) -> Self {
        Self { centre, pivot: centre, turn: DQuat::IDENTITY, velocity: DVec3::ZERO, spin: DVec3::ZERO }
    }
}

/// The kernel that finds the pose of a moving wall, for all particles.
fn pose(position: DVec3, number: u32, motion: &Motion, name: String, problem: &Problem) -> Result<Kernel, Error> {
    let shader = Shader::join(&[
        crate::shader!("world.wgsl"),
        crate::shader!("motion/turned.wgsl"),
        problem.clock(),
        crate::shader!("motion/pose.wgsl"),
        crate::shader!("solids/moving.wgsl"),
        crate::shader!("solids/frame.wgsl"),
    ])?;
    let values = [("position", Scalar::Vector(position)), ("motion", Scalar::Uint(number))];
    let params = shader.reflection().binding("params");
    let params = params.map_or(Ok(Vec::new()), |binding| binding.packed.pack("a wall", &values))?;
    let mut constants = vec![("REACHED", problem.reached)];
    constants.extend(problem.clock_constants());
    let (tables, of_tables) = problem.motion_tables();
    let mut sizes = problem.clock_sizes();
    sizes.extend(of_tables);
    sizes.push((name.clone().into(), FRAME));
    let (motion, all, field) = (motion.clone(), problem.clone(), name.clone());
    let reference = move |host: &Host| {
        let now = time(host, &all, all.reached)?;
        let pose = motion.pose(now);
        let (centre, pivot) = (motion.place(position, now), motion.about + pose.shift);
        let rows =
            [centre.extend(0.0), pivot.extend(0.0), pose.turn.into(), pose.velocity.extend(0.0), pose.spin.extend(0.0)];
        host.writing::<Vec4>(&field)?.iter_mut().zip(rows).for_each(|(to, row)| *to = row);
        Ok(())
    };
    let pass = Pass { constants, uniforms: vec![("params", params)], ..Pass::new(shader, 1) };
    Ok(Kernel {
        name: name.replace('_', " "),
        passes: vec![pass.on(&[("wall_frame", name.into())])],
        reference: Some(Arc::new(reference)),
        sizes,
        scratch: Vec::new(),
        tables,
    })
}

impl Surface {
    /// The kernel that finds its pose, if it moves.
    ///
    /// # Errors
    /// When a shader does not compile.
    pub fn frame(&self, earlier: usize, problem: &Problem) -> Result<Option<Kernel>, Error> {
        let of =
            |(number, motion): &(u32, Motion)| pose(self.position, *number, motion, own("frame", earlier), problem);
        self.motion.as_ref().map(of).transpose()
    }
    /// The kernel of the forces on grains.
    ///
    /// # Errors
    /// When a shader does not compile.
    pub fn kernel(self, wgsl: Source, name: &str, earlier: usize, problem: &Problem) -> Result<Kernel, Error> {
        let wall = self;
        let frame = match wall.motion {
            Some(_) => crate::shader!("solids/framed.wgsl"),
            None => crate::shader!("solids/still.wgsl"),
        };
        let shader = Shader::join(&[
            crate::shader!("world.wgsl"),
            crate::shader!("fields.wgsl"),
            crate::shader!("particle.wgsl"),
            crate::shader!("visit/each.wgsl"),
            crate::shader!("own/no_turns.wgsl"),
            crate::shader!("law/species.wgsl"),
            crate::shader!("motion/turned.wgsl"),
            crate::shader!("solids/distance.wgsl"),
            crate::shader!("grains/touch.wgsl"),
            crate::shader!("grains/bridge.wgsl"),
            frame,
            wgsl,
        ])?;
        let (radius, size, axis) = wall.shape.parts();
        let mut values = vec![
            ("position".to_owned(), Scalar::Vector(wall.position)),
            ("radius".to_owned(), Scalar::Float(radius)),
            ("size".to_owned(), Scalar::Vector(size)),
            ("axis".to_owned(), Scalar::Vector(axis)),
            ("shape".to_owned(), Scalar::Uint(wall.shape.number())),
            ("side".to_owned(), Scalar::Float(wall.side)),
            ("species".to_owned(), Scalar::Uint(wall.species.unwrap_or(u32::MAX))),
            ("contacts".to_owned(), Scalar::Uint(wall.contacts)),
        ];
        values.extend(wall.material.members());
        let values: Vec<_> = values.iter().map(|(name, value)| (name.as_str(), *value)).collect();
        let params = shader.reflection().binding("params");
        let params = params.map_or(Ok(Vec::new()), |binding| binding.packed.pack("a wall", &values))?;
        let words = wall.material.words();
        let mut constants = problem.constants(&shader);
        constants.push(("WORDS", f64::from(words)));
        let [history, pose] = ["history", "frame"].map(|what| own(what, earlier));
        let mut sizes = vec![(history.clone().into(), u64::from(problem.capacity) * u64::from(wall.words))];
        if wall.motion.is_some() {
            sizes.push((pose.clone().into(), FRAME));
        }
        let names = [("wall_history", history.clone().into()), ("wall_frame", pose.clone().into())];
        let reference = move |host: &Host| wall.forces(host, [&history, &pose]);
        let pass =
            Pass { constants, uniforms: vec![("params", params)], alone: true, ..Pass::new(shader, problem.capacity) };
        Ok(Kernel {
            name: name.to_owned(),
            passes: vec![pass.on(&names)],
            reference: Some(Arc::new(reference)),
            sizes,
            scratch: Vec::new(),
            tables: Vec::new(),
        })
    }
    /// The reference.
    fn forces(&self, host: &Host, [history, pose]: [&str; 2]) -> Result<(), Error> {
        let view = crate::visit::View::of(host)?;
        let (bodies, world) = (view.particles(), host.world());
        let (mut acceleration, mut torque) = (host.write(ACCELERATION)?, host.writing::<Vec4>("torque")?);
        let mut history = host.writing::<f32>(history)?;
        let frame = self.pose(host, pose)?;
        let (words, half) = (self.material.words() as usize, (world.step & 1) as usize);
        for me in &bodies {
            let turning = me.vector("angular_velocity").unwrap_or_default();
            let ball = Ball { velocity: me.velocity, spin: turning.truncate(), radius: turning.w, mass: me.mass };
            let meets = self.is_met_by(&ball, me.species());
            for contact in 0..self.contacts as usize {
                let place = |half: usize| self.place(me.index, half, contact);
                let at = self.meeting(&ball, me.position, contact, &frame, &world.bounds);
                let mut kept = Wound::default();
                let word = |word: usize| if word < words { history[place(half) + word] } else { 0.0 };
                let last = Wound::of(word);
                let bridge = self.material.bridge(&at, last.is_wet, world.dt);
                if meets && at.overlap > 0.0 {
                    let touch = self.material.touch(&at, &last, world.dt);
                    acceleration[me.index] += touch.push.extend(touch.energy) / me.mass;
                    torque[me.index] += (at.arm * at.n.cross(touch.push) + touch.turn).extend(touch.heat);
                    kept = touch.wound;
                } else if meets && self.material.is_near(&at) {
                    torque[me.index].w += self.material.left(&at, &last, world.dt);
                }
                if meets {
                    acceleration[me.index] += (bridge.pull * at.n).extend(bridge.energy) / me.mass;
                    torque[me.index].w += bridge.heat;
                    kept.is_wet = bridge.is_there;
                }
                let next = place(1 - half);
                history[next..next + words].copy_from_slice(&kept.words()[..words.min(WORDS)]);
            }
        }
        Ok(())
    }
    /// A particle without mass is moved by nothing.
    fn is_met_by(&self, ball: &Ball, species: u32) -> bool {
        ball.mass > 0.0 && ball.radius > 0.0 && self.species.is_none_or(|own| own == species)
    }
    /// The index of the first word of history of a particle's contact.
    fn place(&self, row: usize, half: usize, contact: usize) -> usize {
        ((2 * row + half) * self.contacts as usize + contact) * self.material.words() as usize
    }
    /// How a grain meets the face that it may touch at one of its contacts.
    fn meeting(&self, ball: &Ball, position: DVec3, contact: usize, frame: &Frame, bounds: &Bounds) -> Meeting {
        let way = position - frame.centre;
        // Planes have no end; all others have images in a periodic box.
        let r = if matches!(self.shape, Solid::Plane(_)) { way } else { bounds.shortest(way) };
        let (out, distance) = self.face(contact, r, frame, bounds);
        let overlap = ball.radius - distance;
        let (n, arm) = (-out, ball.radius - 0.5 * overlap);
        let moving = frame.velocity + frame.spin.cross(frame.centre + r + arm * n - frame.pivot);
        Meeting {
            n,
            overlap,
            arm,
            v: ball.velocity + arm * ball.spin.cross(n) - moving,
            radius: ball.radius,
            smaller: ball.radius,
            spin: ball.spin - frame.spin,
            mass: ball.mass,
            rest: moment(ball.mass, ball.radius),
        }
    }
    /// The forces on the grains of a state, with `earlier` walls before this one.
    #[must_use]
    pub fn pushes(&self, state: &State, bounds: &Bounds, earlier: usize) -> Vec<ContactForce> {
        let (balls, frame) = (Balls::of(state), self.posed(state.time));
        let history = state.scalar(&own("history", earlier)).unwrap_or_default();
        let half = usize::from(state.step % 2 == 1);
        let words = self.material.words() as usize;
        let contact = |grain: usize, contact: usize| {
            let ball = balls.ball(grain).filter(|ball| self.is_met_by(ball, state.species()[grain]))?;
            let at = self.meeting(&ball, state.position()[grain], contact, &frame, bounds);
            let first = self.place(grain, half, contact);
            let word = |word: usize| if word < words { history.get(first + word).copied().unwrap_or(0.0) } else { 0.0 };
            let arm = at.arm * at.n;
            let force = force(&self.material, &at, &Wound::of(word))?;
            Some(ContactForce { grain, other: None, way: arm, arm, force })
        };
        (0..state.len()).flat_map(|grain| (0..self.contacts as usize).filter_map(move |k| contact(grain, k))).collect()
    }
    /// Its pose at a time.
    fn posed(&self, time: f64) -> Frame {
        let position = self.position;
        let Some((_, motion)) = &self.motion else { return Frame::still(position) };
        let pose = motion.pose(time);
        Frame {
            centre: motion.place(position, time),
            pivot: motion.about + pose.shift,
            turn: pose.turn,
            velocity: pose.velocity,
            spin: pose.spin,
        }
    }
    fn pose(&self, host: &Host, field: &str) -> Result<Frame, Error> {
        if self.motion.is_none() {
            return Ok(Frame::still(self.position));
        }
        let rows = host.reading::<Vec4>(field)?;
        let row = |n: usize| rows.get(n).copied().unwrap_or(DVec4::ZERO);
        let [centre, pivot, velocity, spin] = [0, 1, 3, 4].map(|n| row(n).truncate());
        Ok(Frame { centre, pivot, turn: DQuat::from_vec4(row(2)), velocity, spin })
    }
    /// ∇φ and φ of a face that a grain may touch.
    fn face(&self, contact: usize, r: DVec3, frame: &Frame, bounds: &Bounds) -> (DVec3, f64) {
        let own = frame.turn.inverse() * r;
        let (out, distance) = match self.shape {
            Solid::Box(size) if self.contacts > 1 => {
                let out = if own[contact] >= 0.0 { -1.0 } else { 1.0 };
                (DVec3::AXES[contact] * out, 0.5 * size[contact] + out * own[contact])
            }
            shape => {
                let (out, distance) = shape.distance(own, bounds.dimensions);
                (self.side * out, self.side * distance)
            }
        };
        (frame.turn * out, distance)
    }
}
