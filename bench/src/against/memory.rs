//! How much memory the program came to hold, as the system counts it.

/// Counts from when it is made.
#[derive(Debug)]
pub(super) struct PeakWatch {
    before: Option<u64>,
}

impl PeakWatch {
    pub(super) fn start() -> Self {
        // 5 takes the peak down to what is held now (proc(5), clear_refs).
        let reset = std::fs::write("/proc/self/clear_refs", "5");
        Self {
            before: reset.ok().and_then(|()| status("VmRSS:")),
        }
    }

    /// By how many bytes more was held at the worst time than at the start; nothing where the system
    /// does not say.
    pub(super) fn peak(&self) -> Option<u64> {
        Some(status("VmHWM:")?.saturating_sub(self.before?))
    }
}

/// A line of the program's status, in bytes.
fn status(key: &str) -> Option<u64> {
    let text = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = text.lines().find(|line| line.starts_with(key))?;
    let kibibytes: u64 = line.split_whitespace().nth(1)?.parse().ok()?;
    Some(1024 * kibibytes)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_was_held_for_a_while_is_counted() {
        let watch = PeakWatch::start();
        let held = vec![1_u8; 64 << 20];
        assert_eq!(std::hint::black_box(&held).len(), 64 << 20);
        drop(held);
        match watch.peak() {
            Some(peak) => assert!(peak > 60 << 20, "{peak}"),
            None => println!("skipped: this system does not say how much memory a program holds"),
        }
    }
}
