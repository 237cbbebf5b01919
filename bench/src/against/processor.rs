//! Time on the processor, and which of its cores may run.

/// Seconds that this thread has run; wall time where the system does not say.
pub(crate) fn thread_seconds() -> f64 {
    system::thread_seconds()
}

/// Whether [`thread_seconds`] is what it says, and not wall time.
pub(crate) const HAS_THREAD_CLOCK: bool = cfg!(target_os = "linux");

/// While this lives, all threads of this program share one core, where the system can be told so: a
/// build by a peer with threads of its own is then one on one thread.
#[derive(Debug)]
pub(super) struct Pinned(
    #[cfg_attr(
        not(target_os = "linux"),
        expect(dead_code, reason = "no pinning here")
    )]
    Option<system::Cores>,
);

impl Pinned {
    pub(super) fn on_one_core() -> Self {
        Self(system::pin())
    }
}

#[cfg(target_os = "linux")]
impl Drop for Pinned {
    fn drop(&mut self) {
        if let Some(before) = &self.0 {
            system::allow(before);
        }
    }
}

#[cfg(target_os = "linux")]
mod system {
    use rustix::thread::{CpuSet, Pid, sched_getaffinity, sched_setaffinity};
    use rustix::time::{ClockId, clock_gettime};

    pub(super) type Cores = CpuSet;

    pub(super) fn thread_seconds() -> f64 {
        let time = clock_gettime(ClockId::ThreadCPUTime);
        time.tv_sec as f64 + time.tv_nsec as f64 * 1e-9
    }

    /// Gives what was allowed before.
    pub(super) fn pin() -> Option<Cores> {
        let before = sched_getaffinity(None).ok()?;
        let last = (0..CpuSet::MAX_CPU)
            .rev()
            .find(|&core| before.is_set(core))?;
        let mut one = CpuSet::new();
        one.set(last);
        allow(&one);
        Some(before)
    }

    /// For all threads that there are. One that ends meanwhile is no loss.
    pub(super) fn allow(cores: &Cores) {
        let Ok(tasks) = std::fs::read_dir("/proc/self/task") else {
            return;
        };
        for task in tasks.flatten() {
            let id = task.file_name().to_str().and_then(|id| id.parse().ok());
            if let Some(id) = id.and_then(Pid::from_raw) {
                let _ = sched_setaffinity(Some(id), cores);
            }
        }
    }
}

#[cfg(not(target_os = "linux"))]
mod system {
    use std::sync::LazyLock;
    use std::time::Instant;

    pub(super) type Cores = ();

    pub(super) fn thread_seconds() -> f64 {
        static START: LazyLock<Instant> = LazyLock::new(Instant::now);
        START.elapsed().as_secs_f64()
    }

    pub(super) fn pin() -> Option<Cores> {
        None
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn time_goes_on() {
        let begin = thread_seconds();
        let sum: u64 = (0..2_000_000).map(std::hint::black_box).sum();
        assert!(sum > 0 && thread_seconds() > begin);
    }

    #[cfg(target_os = "linux")]
    #[test]
    fn what_is_pinned_has_one_core_and_all_of_them_afterwards() {
        let cores = || std::thread::available_parallelism().unwrap().get();
        let before = cores();
        let pinned = Pinned::on_one_core();
        let during = cores();
        drop(pinned);
        assert_eq!((during, cores()), (1, before));
    }
}
