// A scalar column: its whole element.
alias Value = f32;

fn own(old: f32, next: f32) -> f32 { return next; }

fn is_broken(value: f32) -> bool { return broken(vec4f(value)); }
