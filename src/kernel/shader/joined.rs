//! Files of this crate are parsed once for each combination in which they are joined: plans are written many times, and there are few such
//! combinations. A user's files are parsed each time.

use std::borrow::Cow;
use std::collections::HashMap;
use std::sync::{Arc, LazyLock, Mutex, PoisonError};

use super::{Shader, Source};
use crate::error::Error;

/// Names and texts by their addresses and lengths: they are static.
type Key = Vec<[usize; 4]>;

static JOINED: LazyLock<Mutex<HashMap<Key, Arc<Shader>>>> = LazyLock::new(Mutex::default);

/// The result of joining these files, by `join` if they have not been joined before.
pub(super) fn once(
    sources: &[Source],
    join: impl FnOnce() -> Result<Arc<Shader>, Error>,
) -> Result<Arc<Shader>, Error> {
    let Some(key) = sources.iter().map(key).collect::<Option<Key>>() else { return join() };
    let all = || JOINED.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some(known) = all().get(&key) {
        return Ok(known.clone());
    }
    let shader = join()?;
    all().insert(key, shader.clone());
    Ok(shader)
}

/// The key of a file of this crate.
fn key(source: &Source) -> Option<[usize; 4]> {
    let (Cow::Borrowed(file), Cow::Borrowed(text)) = (&source.file, &source.text) else { return None };
    source.ours.then_some([file.as_ptr() as usize, file.len(), text.as_ptr() as usize, text.len()])
}
