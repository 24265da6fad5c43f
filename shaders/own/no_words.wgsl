// A law whose words of a pair's history are known before it runs.
fn beyond(word: u32) -> f32 { return 0.0; }
