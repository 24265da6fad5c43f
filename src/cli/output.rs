//! What a run leaves behind.

use std::io::Write;
use std::path::{Path, PathBuf};
use std::rc::Rc;

use motes::formats::{Folder, Format, Precision, atomically};
use motes::life::Population;
use motes::links::Links;
use motes::measure::Flock;
use motes::render::{Color, Picture, Scenery, Trail, framed, group_color, pack};
use motes::scene::{Group, Scene};
use motes::settings::Settings;
use motes::{Bounds, Error, Measure, State};

use super::plot;
use super::table::Table;

const HEADER: &str = "step,time,kinetic,potential,total,momentum_x,momentum_y,momentum_z,angular_momentum_x,\
                      angular_momentum_y,angular_momentum_z";
const FLOW: &str = "step,time,pending,active,removed,spawned,mass";
const FLOCK: &str = "step,time,order,speed,neighbors,most_neighbors,clusters,largest_cluster";

/// The folder, and what is in it so far.
pub struct Output {
    folder: Rc<Folder>,
    name: String,
    formats: Vec<&'static Format>,
    pictures: bool,
    precision: Precision,
    digits: usize,
    picture: Settings,
    groups: Vec<Group>,
    energy: Table,
    rows: Vec<Measure>,
    /// Of a flock: its table, the statistics radius, and the box.
    flock: Option<(Table, (f64, Option<u32>), Bounds)>,
    flock_statistics: Vec<Flock>,
    /// Where particles are born or die: how many.
    flow: Option<Table>,
    population: Option<Population>,
    /// Where a few particles have been.
    pub trail: Trail,
    /// What pictures show beside particles.
    pub scenery: Scenery,
}

impl Output {
    /// Writes the scene as it was resolved into the folder, and an empty table of energies; and one of order and clusters,
    /// where a statistics radius is set.
    pub fn new(
        folder: Rc<Folder>,
        scene: &Scene,
        count: usize,
        flock_statistics: Option<(f64, Option<u32>)>,
        precision: Precision,
        device: &str,
    ) -> Result<Self, Error> {
        let resolved = format!("{}\n{}", scene.resolved_in(folder.path()), folder.signature(device));
        atomically(&folder.file("scene.toml")?, |out| out.write_all(resolved.as_bytes()))?;
        let energy = Table::new(folder.file("energy.csv")?, HEADER)?;
        let flock = flock_statistics.map(|of| Ok((Table::new(folder.file("flock.csv")?, FLOCK)?, of, scene.bounds)));
        let flock = flock.transpose()?;
        Ok(Self {
            folder,
            name: scene.name.clone(),
            formats: scene.output.formats.clone(),
            pictures: scene.output.pictures,
            precision,
            digits: scene.steps.to_string().len(),
            picture: framed(&scene.picture, &scene.bounds),
            groups: scene.groups.clone(),
            energy,
            rows: Vec::new(),
            flock,
            flock_statistics: Vec::new(),
            flow: None,
            population: None,
            scenery: Scenery::default(),
            // A trail is for pictures.
            trail: Trail::new(if scene.output.pictures || scene.output.frames > 0 { count } else { 0 }),
        })
    }
    /// Measures a state, and writes that down.
    pub fn measure(&mut self, snapshot: &State) -> Result<(), Error> {
        let row = Measure::of(snapshot)?;
        let (p, l) = (row.momentum, row.angular_momentum);
        let numbers = [row.time, row.kinetic, row.potential, row.total(), p.x, p.y, p.z, l.x, l.y, l.z];
        self.energy.row(row.step, &numbers)?;
        self.rows.push(row);
        if let Some((table, (range, species), bounds)) = &mut self.flock {
            let f = Flock::of(snapshot, *bounds, Some(*range), *species)?;
            let numbers =
                [f.time, f.order, f.speed, f.neighbors, f64::from(f.most_neighbors), f64::from(f.clusters), f.largest];
            table.row(f.step, &numbers)?;
            self.flock_statistics.push(f);
        }
        if self.flow.is_none() && !snapshot.life().is_empty() {
            self.flow = Some(Table::new(self.folder.file("flow.csv")?, FLOW)?);
        }
        if let Some(table) = &mut self.flow {
            let of = snapshot.population();
            let born = (of.active + of.removed) as f64;
            let mass = snapshot.mass().iter().sum::<f64>();
            table.row(row.step, &[row.time, of.pending as f64, of.active as f64, of.removed as f64, born, mass])?;
            self.population = Some(of);
        }
        Ok(())
    }
    /// How many wait, live and are dead, where that changes.
    pub fn population(&self) -> Option<Population> {
        self.population
    }
    /// The first row, which energies are compared with.
    pub fn first(&self) -> Measure {
        self.rows.first().copied().unwrap_or_default()
    }
    /// The first and the last row of the table of order and clusters, if there is one.
    pub fn flock_statistics(&self) -> Option<(&Flock, &Flock)> {
        Some((self.flock_statistics.first()?, self.flock_statistics.last()?))
    }
    /// All rows.
    pub fn rows(&self) -> &[Measure] {
        &self.rows
    }
    /// Writes particles in every format that is numbers, and settles the tables beside them.
    pub fn snapshot(&self, snapshot: &State) -> Result<(), Error> {
        let flock = self.flock.as_ref().map(|(table, ..)| table);
        for table in [Some(&self.energy), flock, self.flow.as_ref()].into_iter().flatten() {
            table.settle()?;
        }
        let stem = format!("snapshot_{:0width$}", snapshot.step, width = self.digits);
        for format in &self.formats {
            let path = self.folder.file(&format!("{stem}.{}", format.name))?;
            written(&path, format, snapshot, self.precision)?;
        }
        Ok(())
    }
    /// Writes what is left of links that may break, beside a snapshot: `[[links]] file` reads it.
    pub fn links(&self, step: u64, links: &Links) -> Result<(), Error> {
        if !self.formats.is_empty() {
            let path = self.folder.file(&format!("links_{step:0width$}.csv", width = self.digits))?;
            atomically(&path, |out| motes::formats::links::write(out, links))?;
        }
        Ok(())
    }
    /// Whether pictures are wanted.
    pub fn pictures(&self) -> bool {
        self.pictures
    }
    /// The picture of a state, to be drawn.
    pub fn picture(&self, snapshot: &State) -> Result<Picture, Error> {
        let of = |id: usize| {
            let found = self.groups.iter().position(|g| g.ids.start as usize <= id && id < g.ids.end as usize);
            u32::try_from(found.unwrap_or(0)).unwrap_or(0)
        };
        let groups: Vec<u32> = (0..snapshot.len()).map(of).collect();
        let trail = self.trail.clone();
        let mut picture = Picture::with(&self.picture, snapshot, &groups, trail, &self.scenery.at(snapshot.time))?;
        // Colours that the scene gives count before those of the palette, unless another was asked for.
        if !["speed", "heading"].contains(&self.picture.text("color")) && self.groups.iter().any(|g| g.color.is_some())
        {
            let color = |group: &u32| {
                let own = self.groups.get(*group as usize).and_then(|g| g.color);
                pack(own.unwrap_or_else(|| group_color(*group)))
            };
            picture.color = Color::Given(groups.iter().map(color).collect());
        }
        Ok(picture)
    }
    /// The file of the picture of a step.
    pub fn frame(&self, step: u64) -> Result<PathBuf, Error> {
        self.folder.file(&format!("picture_{step:0width$}.png", width = self.digits))
    }
    /// The file of the last picture.
    pub fn portrait(&self) -> Result<PathBuf, Error> {
        self.folder.file(&format!("{}.png", self.name))
    }
    /// Plots the energies.
    pub fn plot(&self) -> Result<(), Error> {
        plot::energy(&self.folder.file("energy.svg")?, &self.rows, &self.name)
    }
    /// The folder.
    pub fn folder(&self) -> &Folder {
        &self.folder
    }
}

/// Writes a state into a file of a format.
pub fn written(path: &Path, format: &Format, state: &State, precision: Precision) -> Result<(), Error> {
    atomically(path, |out| format.write.map_or(Ok(()), |write| write(out, state, precision)))
}
