//! The files of a run: one thread writes them in the order in which they are queued, so that the device does not wait for the disk.

use std::collections::VecDeque;
use std::fmt;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::thread::{Builder, JoinHandle};

use crate::error::Error;
use crate::links::Links;
use crate::state::State;

/// The size limit of the queue, including the file being written \[bytes\]; a larger file is accepted when the queue is empty.
const BYTES: usize = 256 << 20;
/// The maximum number of files in the queue.
const FILES: usize = 64;

/// A file, and the function that writes it.
struct Job {
    file: PathBuf,
    bytes: usize,
    write: Box<dyn FnOnce() -> Result<(), Error> + Send>,
}

/// The queue, and its first error.
#[derive(Default)]
struct Queue {
    jobs: VecDeque<Job>,
    /// The total size and number of files that are not written yet, including the one being written.
    bytes: usize,
    files: usize,
    closed: bool,
    /// The first file that could not be written: no later file is written.
    failed: Option<(PathBuf, String)>,
}

impl Queue {
    fn has_room(&self, bytes: usize) -> bool {
        self.files == 0 || self.files <= FILES && self.bytes.saturating_add(bytes) <= BYTES
    }
    fn check(&self) -> Result<(), Error> {
        let failed =
            |(file, message): &(PathBuf, String)| Error::Output { file: file.clone(), message: message.clone() };
        self.failed.as_ref().map_or(Ok(()), |why| Err(failed(why)))
    }
}

#[derive(Default)]
struct Shared {
    queue: Mutex<Queue>,
    changed: Condvar,
}

impl Shared {
    fn queue(&self) -> MutexGuard<'_, Queue> {
        self.queue.lock().unwrap_or_else(PoisonError::into_inner)
    }
    fn wait<'a>(&self, queue: MutexGuard<'a, Queue>) -> MutexGuard<'a, Queue> {
        self.changed.wait(queue).unwrap_or_else(PoisonError::into_inner)
    }
    /// Writes queued files, until the queue is closed and empty.
    fn work(&self) {
        while let Some(job) = self.next() {
            let (bytes, failed) = (job.bytes, written(job));
            let mut queue = self.queue();
            let mut dropped = VecDeque::new();
            (queue.bytes, queue.files) = (queue.bytes - bytes, queue.files - 1);
            if failed.is_some() {
                dropped = std::mem::take(&mut queue.jobs);
                (queue.bytes, queue.files, queue.failed) = (0, 0, failed);
            }
            drop(queue);
            // The data of the jobs is freed here.
            drop(dropped);
            self.changed.notify_all();
        }
    }
    fn next(&self) -> Option<Job> {
        let mut queue = self.queue();
        loop {
            match queue.jobs.pop_front() {
                None if !queue.closed => queue = self.wait(queue),
                job => return job,
            }
        }
    }
}

/// Writes a file. Returns the error, and its file.
fn written(Job { file, write, .. }: Job) -> Option<(PathBuf, String)> {
    // If a panic ended the thread, the run would wait forever.
    match catch_unwind(AssertUnwindSafe(write)) {
        Ok(Ok(())) => None,
        Ok(Err(Error::Output { file, message })) => Some((file, message)),
        Ok(Err(other)) => Some((file, other.to_string())),
        Err(_) => Some((file, "the thread that writes it panicked, which is a bug in motes".to_owned())),
    }
}

/// A queue of files to write. Clones share one thread, which ends with the last clone, when all files are written.
#[derive(Clone)]
pub(super) struct Stream(Arc<Thread>);

struct Thread {
    shared: Arc<Shared>,
    /// `None` if no thread can be started: then files are written at once.
    thread: Option<JoinHandle<()>>,
}

impl Default for Stream {
    fn default() -> Self {
        let shared = Arc::<Shared>::default();
        let its = shared.clone();
        let thread = Builder::new().name("motes-writer".to_owned()).spawn(move || its.work()).ok();
        Self(Arc::new(Thread { shared, thread }))
    }
}

impl Stream {
    /// Queues a file of approximately this size, which `write` writes. Waits if the queue is full.
    ///
    /// # Errors
    /// [`Error::Output`] with the first file that could not be written, this one or one before.
    pub fn write(
        &self,
        file: &Path,
        bytes: usize,
        write: impl FnOnce() -> Result<(), Error> + Send + 'static,
    ) -> Result<(), Error> {
        let Thread { shared, thread } = &*self.0;
        let mut queue = shared.queue();
        queue.check()?;
        let job = Job { file: file.to_owned(), bytes, write: Box::new(write) };
        if thread.is_none() {
            queue.failed = written(job);
            return queue.check();
        }
        while !queue.has_room(bytes) {
            queue = shared.wait(queue);
        }
        queue.check()?;
        queue.jobs.push_back(job);
        (queue.bytes, queue.files) = (queue.bytes.saturating_add(bytes), queue.files + 1);
        shared.changed.notify_all();
        Ok(())
    }
    /// Checks whether all files so far were written without an error.
    ///
    /// # Errors
    /// [`Error::Output`] with the first file that could not be written.
    pub fn check(&self) -> Result<(), Error> {
        self.0.shared.queue().check()
    }
    /// Waits until all files are written.
    ///
    /// # Errors
    /// [`Error::Output`] with the first file that could not be written.
    pub fn drain(&self) -> Result<(), Error> {
        let mut queue = self.0.shared.queue();
        while queue.files > 0 {
            queue = self.0.shared.wait(queue);
        }
        queue.check()
    }
}

impl Drop for Thread {
    fn drop(&mut self) {
        self.shared.queue().closed = true;
        self.shared.changed.notify_all();
        if let Some(thread) = self.thread.take() {
            let _ = thread.join();
        }
    }
}

impl fmt::Debug for Stream {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let queue = self.0.shared.queue();
        write!(f, "Stream({} files, {} bytes, {:?})", queue.files, queue.bytes, queue.failed)
    }
}

/// The memory of the columns and links of a state \[bytes\].
pub(super) fn size(state: &State) -> usize {
    state.columns().map(|(_, values)| values.bytes()).sum::<usize>() + tied(&state.links)
}

/// The memory of links \[bytes\].
pub(super) fn tied(Links { springs, rods, joints, dihedrals, triangles }: &Links) -> usize {
    size_of_val(&**springs)
        + size_of_val(&**rods)
        + size_of_val(&**joints)
        + size_of_val(&**dihedrals)
        + size_of_val(&**triangles)
}

#[cfg(test)]
mod tests {
    use std::sync::mpsc::channel;
    use std::time::Duration;

    use super::*;

    fn failure(file: &str) -> Result<(), Error> {
        Err(Error::Output { file: file.into(), message: "no space left".to_owned() })
    }
    fn words(result: Result<(), Error>) -> String {
        result.map_or_else(|error| error.to_string(), |()| "well".to_owned())
    }
    /// A stream without a thread.
    fn here() -> Stream {
        Stream(Arc::new(Thread { shared: Arc::default(), thread: None }))
    }

    #[test]
    fn files_are_written_in_order_by_another_thread() {
        for (stream, other) in [(Stream::default(), true), (here(), false)] {
            let (tell, heard) = channel();
            for number in 0..1000 {
                let tell = tell.clone();
                let write = move || {
                    tell.send((number, std::thread::current().id())).expect("heard");
                    Ok(())
                };
                stream.write(Path::new("a"), 1 << 20, write).expect("taken");
            }
            stream.drain().expect("well");
            let all: Vec<_> = heard.try_iter().collect();
            assert!(all.iter().map(|(number, _)| *number).eq(0..1000));
            assert!(all.iter().all(|(_, thread)| (*thread != std::thread::current().id()) == other));
        }
    }

    #[test]
    fn a_slow_writer_blocks_and_memory_does_not_grow() {
        // By their sizes, a larger one than all that may wait alone, and by their number.
        for (bytes, most) in [(BYTES / 4, 4), (BYTES * 2, 1), (1, FILES + 1)] {
            let stream = Stream::default();
            let (go, wait) = channel::<()>();
            let (tell, heard) = channel();
            let wait = Arc::new(Mutex::new(wait));
            let pushing = std::thread::spawn({
                let stream = stream.clone();
                move || {
                    for number in 0..most + 3 {
                        let wait = wait.clone();
                        let write = move || {
                            wait.lock().expect("one at a time").recv().expect("a word");
                            Ok(())
                        };
                        stream.write(Path::new("a"), bytes, write).expect("taken");
                        tell.send(number).expect("heard");
                    }
                }
            });
            let minute = Duration::from_mins(1);
            for number in 0..most {
                assert_eq!(heard.recv_timeout(minute), Ok(number), "{bytes} bytes");
            }
            assert!(heard.recv_timeout(Duration::from_millis(100)).is_err(), "the next one waits: {stream:?}");
            go.send(()).expect("heard");
            assert_eq!(heard.recv_timeout(minute), Ok(most), "one is written, so one is taken");
            assert!(heard.recv_timeout(Duration::from_millis(100)).is_err(), "and the next one waits: {stream:?}");
            (0..most + 2).for_each(|_| go.send(()).expect("heard"));
            pushing.join().expect("all are taken");
            stream.drain().expect("well");
        }
    }

    #[test]
    fn the_first_fault_is_reported_with_its_file_and_nothing_is_written_behind_it() {
        for stream in [Stream::default(), here()] {
            let (tell, heard) = channel();
            let mut taken = Vec::new();
            for number in 0..100 {
                let tell = tell.clone();
                let write = move || {
                    tell.send(number).expect("heard");
                    if number == 3 { failure("b.csv") } else { Ok(()) }
                };
                taken.push(words(stream.write(Path::new("a"), 1, write)));
            }
            let fault = words(failure("b.csv"));
            assert!(
                fault.contains("b.csv") && taken.iter().all(|words| *words == fault || words == "well"),
                "{taken:?}"
            );
            assert_eq!([words(stream.drain()), words(stream.check()), words(stream.drain())], [&*fault; 3]);
            assert_eq!(heard.try_iter().collect::<Vec<_>>(), [0, 1, 2, 3]);
        }
    }

    #[test]
    fn a_fault_wakes_a_run_that_waits_and_a_panic_is_a_fault() {
        let stream = Stream::default();
        let (go, wait) = channel::<()>();
        let write = move || {
            wait.recv().expect("a word");
            panic!("meant")
        };
        stream.write(Path::new("a.csv"), BYTES, write).expect("taken");
        let pushing = std::thread::spawn({
            let stream = stream.clone();
            move || words(stream.write(Path::new("b.csv"), BYTES, || Ok(())))
        });
        std::thread::sleep(Duration::from_millis(50));
        go.send(()).expect("heard");
        let waited = pushing.join().expect("it ends");
        assert!(waited.contains("a.csv") && waited.contains("a bug in motes"), "{waited}");
        assert_eq!(words(stream.drain()), waited);
    }

    #[test]
    fn what_is_taken_is_written_when_the_run_is_dropped() {
        let (tell, heard) = channel();
        let stream = Stream::default();
        for number in 0..20 {
            let tell = tell.clone();
            let write = move || {
                std::thread::sleep(Duration::from_millis(1));
                tell.send(number).expect("heard");
                Ok(())
            };
            stream.write(Path::new("a"), 1, write).expect("taken");
        }
        drop(stream);
        assert!(heard.try_iter().eq(0..20));
    }
}
