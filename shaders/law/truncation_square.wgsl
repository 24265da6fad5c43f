// The same of an energy of even powers of the distance, with slope = U'(r) / r: where only U(R) is taken off, no root is needed.
override SHIFTED: bool = false; // U'(R) is not taken off, and R = a

fn even_ended(here: Energy, end: Energy, square: f32, range: f32, onset: f32) -> Energy {
    if SHIFTED { return Energy(here.value - end.value, here.slope); }
    let inverse = inverseSqrt(max(square, SMALLEST));
    let r = square * inverse;
    let whole = ended(Energy(here.value, here.slope * r), end, r, range, onset);
    return Energy(whole.value, whole.slope * inverse);
}
