// The usual sum of a law over pairs, with what its additions lose: beside a large force many small ones are not rounded away.
struct Sum { acceleration: vec3f, potential: f32, rest: vec3f }

fn merge(total: ptr<function, Sum>, part: Sum) {
    let sum = two_sum((*total).acceleration, part.acceleration);
    (*total).acceleration = sum.high;
    (*total).rest += sum.low + part.rest;
    (*total).potential += part.potential;
}

// Whether each source is added so; otherwise each block of them is.
override EACH: bool;

fn gathered(me: Particle, you: Particle, r: vec3f, sum: ptr<function, Sum>) {
    if EACH {
        var one = Sum();
        gather(me, you, r, &one);
        merge(sum, one);
    } else {
        gather(me, you, r, sum);
    }
}

fn settled(sum: Sum) -> Sum { return Sum(sum.acceleration + sum.rest, sum.potential, vec3f()); }
