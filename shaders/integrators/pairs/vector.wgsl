// A column in the components FIRST to END of its elements; the other components belong to other columns.
alias Value = vec4f;

override FIRST: u32 = 0u;
override END: u32 = 3u;

fn own(old: vec4f, next: vec4f) -> vec4f {
    var mixed = old;
    for (var k = FIRST; k < END; k += 1u) { mixed[k] = next[k]; }
    return mixed;
}

fn is_broken(value: vec4f) -> bool { return broken(own(vec4f(), value)); }
