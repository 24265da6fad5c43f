//! Updaters: what acts between steps. Each is one `.wgsl` and one `.rs` of the same name, and one line in the register below.

use crate::component::{Component, Properties, Stage, components};
use crate::kernel::Problem;
use crate::visit::Over;

components! {
    UPDATERS, Updater;
    nose_hoover: NoseHoover, "a thermostat: all particles at a given mean temperature, by one variable of the system (Nosé 1984, Hoover 1985)";
    langevin: Langevin, "a heat bath with friction and noise on every particle (Langevin 1908, Bussi & Parrinello 2007)";
    andersen: Andersen, "a heat bath with which particles collide at random (Andersen 1980)";
    berendsen: Berendsen, "the temperature relaxes to a given one; for equilibration only (Berendsen et al. 1984)";
    csvr: Csvr, "a thermostat: the kinetic energy relaxes and fluctuates as it does in a heat bath, by one random factor for all velocities (Bussi, Donadio & Parrinello 2007)";
    berendsen_pressure: BerendsenPressure, "a barostat: the pressure relaxes to a given one; for equilibration only (Berendsen et al. 1984)";
    cell_rescaling: CellRescaling, "a barostat: the volume of the box relaxes and fluctuates as it does at a given pressure (Bernetti & Bussi 2020)";
    minimize: Minimize, "particles move to a minimum of the potential energy and rest there: FIRE (Bitzek et al. 2006)";
    collide: Collide, "bodies that touch merge, or bounce";
    tear: Tear, "springs that are stretched too far break permanently";
}
