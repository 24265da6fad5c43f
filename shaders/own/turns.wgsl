// Counts the iterations of the loops of a user's law. Mesa before 25 ends the loops of an invocation after 65 535 iterations of all of them together,
// silently, and each loop behind that after its first turn: so does the loop here. No driver ends a loop that has no end.
// words 8 and 9 of the alarm: the mark of a law whose loops the driver has ended; the mark of one whose loops take too many turns
override LAW: u32;

// Turns of one invocation in the loops that do not say how many they have, at most: some 0.1 s.
const MOST_TURNS: u32 = 16777216u;
const NO_LAW: u32 = 0xffffffffu;

var<private> own_turns: u32;
var<private> own_turns_end: bool;

// Asked at the start of each such turn. Now and then it looks at what others say: where one has no end, none has.
fn own_loop_ends() -> bool {
    own_turns += 1u;
    if (own_turns & 0xffffu) == 0u {
        if own_turns >= MOST_TURNS { atomicMin(&alarm[9], LAW); }
        own_turns_end = own_turns_end || atomicLoad(&alarm[9]) != NO_LAW;
    }
    return own_turns_end;
}

// A loop of two turns, behind all others. No compiler knows that no mass has a sign.
fn check_turns(me: Particle) {
    let wanted = 2u + (bitcast<u32>(me.mass) >> 31u);
    var turns = 0u;
    while turns < wanted { turns += 1u; }
    if turns < wanted { atomicMin(&alarm[8], LAW); }
}
