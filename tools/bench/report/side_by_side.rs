//! Runs long tasks in parallel, as many as the host has cores. Instructions are counted by the emulator's own clock, so tasks
//! that run at the same time change no count.

use crate::Result;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;

/// Applies `each` to all items in parallel; returns the results in order.
pub(crate) fn side_by_side<T: Sync, R: Send>(
    these: &[T],
    each: impl Fn(&T) -> Result<R> + Sync,
) -> Result<Vec<R>> {
    let next = AtomicUsize::new(0);
    let some = || {
        let mut done = Vec::new();
        loop {
            let at = next.fetch_add(1, Ordering::Relaxed);
            let Some(this) = these.get(at) else { break done };
            // Errors stay in their thread; their messages are passed on.
            done.push((at, each(this).map_err(|error| error.to_string())));
        }
    };
    let at_once = thread::available_parallelism().map_or(1, usize::from);
    let mut done = Vec::new();
    thread::scope(|scope| {
        let threads: Vec<_> = (0..at_once).map(|_| scope.spawn(some)).collect();
        for thread in threads {
            done.extend(thread.join().map_err(|_| "a thread panicked")?);
        }
        Ok::<(), &str>(())
    })?;
    done.sort_by_key(|of| of.0);
    done.into_iter().map(|of| of.1.map_err(Into::into)).collect()
}
