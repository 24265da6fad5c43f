// Whether iterations have ended, how many there were, and the change by the last one.
struct Iteration { done: f32, count: f32, change: f32 }
