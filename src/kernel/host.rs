//! Arrays on the host, by name, as a reference sees them. A reference that reads and writes one array at once is refused, as a
//! device refuses it.

use std::collections::BTreeMap;
use std::marker::PhantomData;
use std::sync::{Arc, RwLock, RwLockReadGuard, RwLockWriteGuard};

use super::{Array, Element, Field, Flag, LIFE, World};
use crate::error::Error;
use crate::life::Life;

/// Named arrays, and the parameters of every kernel.
#[derive(Debug, Default)]
pub struct Host {
    arrays: BTreeMap<String, RwLock<Arc<Array>>>,
    world: RwLock<World>,
}

/// An array that is being read.
pub struct Reading<'a, T>(RwLockReadGuard<'a, Arc<Array>>, PhantomData<T>);
/// An array that is being written.
pub struct Writing<'a, T>(RwLockWriteGuard<'a, Arc<Array>>, PhantomData<T>);

impl<T: Element> std::ops::Deref for Reading<'_, T> {
    type Target = [T::Reference];
    fn deref(&self) -> &[T::Reference] {
        T::view(&self.0).map_or(&[], Vec::as_slice)
    }
}
impl<T: Element> std::ops::Deref for Writing<'_, T> {
    type Target = [T::Reference];
    fn deref(&self) -> &[T::Reference] {
        T::view(&self.0).map_or(&[], Vec::as_slice)
    }
}
impl<T: Element> std::ops::DerefMut for Writing<'_, T> {
    fn deref_mut(&mut self) -> &mut [T::Reference] {
        T::view_mut(Arc::make_mut(&mut self.0)).map_or(&mut [], Vec::as_mut_slice)
    }
}

impl Host {
    /// Stores an array under a name, in place of an earlier one.
    pub fn insert(&mut self, name: &str, array: Array) {
        self.arrays.insert(name.to_owned(), RwLock::new(Arc::new(array)));
    }
    /// Drops an array.
    pub fn remove(&mut self, name: &str) {
        self.arrays.remove(name);
    }
    /// Fills an array from one of its elements on.
    ///
    /// # Errors
    /// When there is none of that name and kind, or it is shorter.
    pub fn fill(&mut self, name: &str, first: usize, values: &Array) -> Result<(), Error> {
        let array = self.arrays.get_mut(name).ok_or_else(|| missing(name))?;
        let array = array.get_mut().map_err(|_| aliased(name))?;
        let end = first.saturating_add(values.len());
        if array.len() < end {
            return Err(Error::Device(format!("the field `{name}` has {} elements, not {end}", array.len())));
        }
        match (Arc::make_mut(array), values) {
            (Array::Vec4(to), Array::Vec4(from)) => to[first..end].copy_from_slice(from),
            (Array::Vec3(to), Array::Vec3(from)) => to[first..end].copy_from_slice(from),
            (Array::Vec4(to), Array::Vec3(from)) => {
                to[first..end].iter_mut().zip(from).for_each(|(to, from)| *to = from.extend(0.0));
            }
            (Array::Float(to), Array::Float(from)) => to[first..end].copy_from_slice(from),
            (Array::Uint(to), Array::Uint(from)) => to[first..end].copy_from_slice(from),
            _ => return Err(missing(name)),
        }
        Ok(())
    }
    /// Puts an array in place of another of the same kind and length.
    ///
    /// # Errors
    /// When there is no such array, or it is open.
    pub fn replace(&self, name: &str, array: Array) -> Result<(), Error> {
        let lock = self.arrays.get(name).ok_or_else(|| missing(name))?;
        let mut old = lock.try_write().map_err(|_| aliased(name))?;
        if std::mem::discriminant(&**old) != std::mem::discriminant(&array) || old.len() != array.len() {
            return Err(missing(name));
        }
        *old = Arc::new(array);
        Ok(())
    }
    /// A copy of an array.
    #[must_use]
    pub fn get(&self, name: &str) -> Option<Array> {
        Some(Array::clone(&*self.arrays.get(name)?.read().ok()?))
    }
    /// All arrays at present, by name. Later writes do not change them.
    ///
    /// # Errors
    /// When one is being written.
    pub fn arrays(&self) -> Result<BTreeMap<&str, Arc<Array>>, Error> {
        let shared = |(name, lock): (&'_ String, &'_ RwLock<Arc<Array>>)| {
            lock.try_read().map(|array| Arc::clone(&array)).map_err(|_| aliased(name))
        };
        self.arrays.iter().map(|entry| Ok((entry.0.as_str(), shared(entry)?))).collect()
    }
    /// Whether there is an array of that name.
    #[must_use]
    pub fn contains(&self, name: &str) -> bool {
        self.arrays.contains_key(name)
    }
    /// Whether a flag is set.
    ///
    /// # Errors
    /// When there is no such word.
    pub fn is_set(&self, flag: &Flag) -> Result<bool, Error> {
        let lock = self.arrays.get(flag.field.as_ref()).ok_or_else(|| missing(&flag.field))?;
        let array = lock.try_read().map_err(|_| aliased(&flag.field))?;
        let word = flag.word as usize;
        let set = match &**array {
            Array::Vec4(all) => all.get(word / 4).map(|v| v[word % 4] != 0.0),
            Array::Vec3(all) => all.get(word / 4).filter(|_| word % 4 < 3).map(|v| v[word % 4] != 0.0),
            Array::Float(all) => all.get(word).map(|x| *x != 0.0),
            Array::Uint(all) => all.get(word).map(|n| *n != 0),
        };
        set.ok_or_else(|| missing(&flag.field))
    }
    /// Opens an array for reading.
    ///
    /// # Errors
    /// When there is none of that name and kind, or when it is being written.
    pub fn read<T: Element>(&self, field: Field<T>) -> Result<Reading<'_, T>, Error> {
        self.reading(field.name)
    }
    /// Opens an array for reading, by a name that is known only when the plan is written.
    ///
    /// # Errors
    /// When there is none of that name and kind, or when it is being written.
    pub fn reading<T: Element>(&self, name: &str) -> Result<Reading<'_, T>, Error> {
        let lock = self.arrays.get(name).ok_or_else(|| missing(name))?;
        let guard = lock.try_read().map_err(|_| aliased(name))?;
        if T::view(&guard).is_none() {
            return Err(missing(name));
        }
        Ok(Reading(guard, PhantomData))
    }
    /// Opens an array for writing.
    ///
    /// # Errors
    /// When there is none of that name and kind, or when it is open already.
    pub fn write<T: Element>(&self, field: Field<T>) -> Result<Writing<'_, T>, Error> {
        self.writing(field.name)
    }
    /// Opens an array for writing, by a name that is known only when the plan is written.
    ///
    /// # Errors
    /// When there is none of that name and kind, or when it is open already.
    pub fn writing<T: Element>(&self, name: &str) -> Result<Writing<'_, T>, Error> {
        let lock = self.arrays.get(name).ok_or_else(|| missing(name))?;
        let guard = lock.try_write().map_err(|_| aliased(name))?;
        if T::view(&guard).is_none() {
            return Err(missing(name));
        }
        Ok(Writing(guard, PhantomData))
    }
    /// The life of particles, by id: all are active where there is no such field.
    ///
    /// # Errors
    /// When that field is being written.
    pub fn is_active(&self) -> Result<impl Fn(usize) -> bool + Sync + use<>, Error> {
        let life = if self.contains(LIFE.name) { self.read(LIFE)?.to_vec() } else { Vec::new() };
        Ok(move |id: usize| life.get(id).is_none_or(|word| *word == Life::Active.word()))
    }
    /// The parameters of every kernel.
    #[must_use]
    pub fn world(&self) -> World {
        self.world.read().map_or_else(|e| **e.get_ref(), |c| *c)
    }
    /// Sets the parameters of every kernel.
    pub fn set_world(&self, world: World) {
        match self.world.write() {
            Ok(mut c) => *c = world,
            Err(mut e) => **e.get_mut() = world,
        }
    }
}

fn missing(name: &str) -> Error {
    Error::Device(format!("a reference reads the field `{name}`, which does not exist"))
}
fn aliased(name: &str) -> Error {
    Error::Device(format!("a reference opens the field `{name}` twice, once to write"))
}
