//! Remarks on temperatures: a thermostat and a barostat with fluctuations keep one state together only at the same temperature.

use super::Remark;
use crate::simulation::Setup;

/// The part by which two temperatures may differ and be the same.
const SAME: f64 = 1e-6;

/// The remark on a barostat whose temperature is not that of the thermostat, or for which there is none.
pub fn remark(setup: &Setup) -> Option<Remark> {
    let parts = || setup.forces.iter().map(|force| (force.name(), force.properties()));
    let (barostat, wanted) =
        parts().find_map(|(name, properties)| Some((name, properties.barostat.and(properties.temperature)?)))?;
    let bath = parts().find_map(|(name, of)| Some((name, of.temperature.filter(|_| of.thermostat)?)));
    let Some((thermostat, given)) = bath else {
        let text = format!(
            "{barostat} has the volumes of the temperature {wanted} where a thermostat keeps it, and there is none: the temperature drifts"
        );
        let advice = format!("add a [[force]] of kind = \"csvr\" with temperature = {wanted}");
        return Some(Remark::warning("no-thermostat", text).with("temperature", wanted).advice(advice));
    };
    let text = format!(
        "{barostat} has the temperature {wanted}, and {thermostat} {given}: volumes fluctuate as at the one, and velocities as at the other"
    );
    let differs = (wanted - given).abs() > SAME * given.abs();
    differs.then(|| {
        let remark = Remark::warning("two-temperatures", text).with("barostat", wanted).with("thermostat", given);
        remark.advice("give both the same temperature")
    })
}
