//! The corpora of `fuzz/`, read whole, cut and changed, by what the fuzz targets do.

use std::path::{Path, PathBuf};

#[expect(unreachable_pub, reason = "it is a library in its own crate")]
#[path = "../../../../fuzz/src/lib.rs"]
mod targets;

use targets::TARGETS;

/// How many times each file is changed.
const CHANGES: u32 = 400;

fn corpora() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fuzz/corpus")
}

/// The files of a target's corpus, by name, so that a failure comes back.
fn corpus(target: &str) -> Vec<(String, Vec<u8>)> {
    let folder = corpora().join(target);
    let entries =
        std::fs::read_dir(&folder).unwrap_or_else(|e| panic!("{}: {e}", folder.display()));
    let paths = entries.map(|entry| entry.unwrap().path());
    let name = |path: &Path| path.file_name().unwrap().to_string_lossy().into_owned();
    let mut files: Vec<_> = paths
        .map(|path| (name(&path), std::fs::read(&path).unwrap()))
        .collect();
    files.sort();
    files
}

/// Numbers that look random and are always the same: splitmix64 (Steele, Lea, Flood, "Fast
/// Splittable Pseudorandom Number Generators", 2014).
struct Numbers(u64);

impl Numbers {
    fn below(&mut self, bound: usize) -> usize {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) % bound as u64) as usize
    }
}

/// The bytes with a few bits turned, bytes that mean something written over others, a piece taken
/// out or doubled, or the end cut off.
fn changed(bytes: &[u8], numbers: &mut Numbers) -> Vec<u8> {
    const TELLING: &[u8] = b"0123456789-+.eE/ \\\n\r#\"[]{}=,\x00\x01\x7f\x80\xff";
    let mut bytes = bytes.to_vec();
    for _ in 0..=numbers.below(4) {
        let length = bytes.len();
        if length == 0 {
            break;
        }
        let at = numbers.below(length);
        let end = at + numbers.below((length - at).min(16)) + 1;
        match numbers.below(6) {
            0 | 1 => bytes[at] ^= 1 << numbers.below(8),
            2 | 3 => bytes[at] = TELLING[numbers.below(TELLING.len())],
            4 => drop(bytes.drain(at..end)),
            _ => {
                let piece = bytes[at..end].to_vec();
                bytes.splice(at..at, piece);
            }
        }
    }
    if numbers.below(4) == 0 {
        bytes.truncate(numbers.below(bytes.len() + 1));
    }
    bytes
}

#[test]
fn every_corpus_is_read_whole_cut_and_changed() {
    for (target, read) in TARGETS {
        read(b"");
        for (index, (name, bytes)) in corpus(target).into_iter().enumerate() {
            let mut numbers = Numbers(index as u64);
            let tell = |how: &str, bytes: &[u8]| {
                // The bytes that a reader panics at, after its message.
                let read = std::panic::AssertUnwindSafe(|| read(bytes));
                if std::panic::catch_unwind(read).is_err() {
                    panic!(
                        "{target}/{name}, {how}: {:?}",
                        bytes.escape_ascii().to_string()
                    );
                }
            };
            tell("whole", &bytes);
            for change in 0..CHANGES {
                let changed = changed(&bytes, &mut numbers);
                tell(&format!("change {change}"), &changed);
            }
        }
    }
}

#[test]
fn every_target_has_a_program_and_a_corpus_of_small_files_and_no_corpus_is_without_one() {
    for (target, _) in TARGETS {
        let program = corpora().join(format!("../fuzz_targets/{target}.rs"));
        let program = std::fs::read_to_string(program).unwrap();
        assert!(
            program.contains(&format!("ombra_fuzz::{target}(")),
            "{target}"
        );
        let corpus = corpus(target);
        assert!(!corpus.is_empty(), "{target}");
        for (name, bytes) in corpus {
            assert!(
                bytes.len() <= 4096,
                "{target}/{name}: {} bytes",
                bytes.len()
            );
        }
    }
    for folder in std::fs::read_dir(corpora()).unwrap() {
        // Readers of other crates are no targets of this list, but have their programs all the same.
        let name = folder.unwrap().file_name().into_string().unwrap();
        let program = corpora().join(format!("../fuzz_targets/{name}.rs"));
        assert!(program.exists(), "{name} has no program");
    }
}
