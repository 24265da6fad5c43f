// An obstacle with a prescribed motion: its pose at a fraction of the step.
override REACHED: f32 = 1.0;

fn frame() -> Frame {
    let p = pose(params.motion, REACHED);
    let about = motions[params.motion].about;
    let centre = params.position + (p.shift + turned(p.turn, params.position - about));
    return Frame(centre, about + p.shift, p.turn, p.velocity, p.spin);
}
