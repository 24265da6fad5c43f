// How the energy of a pair ends at the cut-off radius R, with what is taken off of U(R) and U'(R):
//   U(r) − U(R) − (r − R) U'(R),  times S = (R² − r²)² (R² + 2 r² − 3 a²) / (R² − a²)³ beyond the onset a (Brooks et al. 1983).
override SMOOTHED: bool = true; // otherwise R = a

fn ended(here: Energy, end: Energy, r: f32, range: f32, onset: f32) -> Energy {
    let value = here.value - end.value - (r - range) * end.slope;
    let slope = here.slope - end.slope;
    if !SMOOTHED || r <= onset { return Energy(value, slope); }
    let left = (range - r) * (range + r);
    let begun = (onset - r) * (onset + r);
    let width = (range - onset) * (range + onset);
    let part = left / (width * width * width);
    return Energy(part * left * (width - 2.0 * begun) * value, part * (left * (width - 2.0 * begun) * slope + 12.0 * r * begun * value));
}
