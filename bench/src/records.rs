//! Records are kept by machine and date.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::time::{SystemTime, UNIX_EPOCH};

use crate::machine::Machine;

/// Writes a record as `FOLDER/MACHINE/DATE-BENCH.json` and its tables beside it as `.md`, under a title;
/// gives the two paths.
///
/// # Errors
/// When a file cannot be written.
pub fn keep(
    folder: &Path,
    machine: &Machine,
    bench: &str,
    title: &str,
    json: &str,
    tables: &str,
) -> io::Result<[PathBuf; 2]> {
    let folder = folder.join(machine_name(machine));
    fs::create_dir_all(&folder)?;
    let date = today();
    let [json_path, tables_path] =
        ["json", "md"].map(|ending| folder.join(format!("{date}-{bench}.{ending}")));
    fs::write(&json_path, format!("{json}\n"))?;
    fs::write(&tables_path, format!("# {title}, {date}\n\n{tables}"))?;
    Ok([json_path, tables_path])
}

/// A machine as a folder is called: the processor's own words and its threads, such as
/// `xeon-2-threads`.
#[must_use]
pub fn machine_name(machine: &Machine) -> String {
    const SAYS_NOTHING: [&str; 6] = ["intel", "amd", "processor", "cpu", "core", "with"];
    let name = machine.cpu.to_lowercase();
    // What comes behind an @ is the clock rate; (R) and (TM) are no words.
    let name = name.split('@').next().unwrap_or_default();
    let name = name.replace("(r)", " ").replace("(tm)", " ");
    let words = name.split(|c: char| !c.is_ascii_alphanumeric());
    let words = words.filter(|word| !word.is_empty() && !SAYS_NOTHING.contains(word));
    let words: Vec<_> = words.collect();
    format!("{}-{}-threads", words.join("-"), machine.threads)
}

/// The day in Greenwich, as year-month-day.
fn today() -> String {
    let since = SystemTime::now().duration_since(UNIX_EPOCH);
    let days = since.map_or(0, |since| since.as_secs() / 86_400);
    date(i64::try_from(days).unwrap_or(0))
}

/// Days since 1970 as a date: Hinnant, "chrono-Compatible Low-Level Date Algorithms", 2013.
fn date(days: i64) -> String {
    // Years begin in March, so that the leap day is the last.
    let shifted = days + 719_468;
    let era = shifted.div_euclid(146_097);
    let day_of_era = shifted.rem_euclid(146_097);
    let year_of_era =
        (day_of_era - day_of_era / 1460 + day_of_era / 36_524 - day_of_era / 146_096) / 365;
    let day_of_year = day_of_era - (365 * year_of_era + year_of_era / 4 - year_of_era / 100);
    let month_from_march = (5 * day_of_year + 2) / 153;
    let day = day_of_year - (153 * month_from_march + 2) / 5 + 1;
    let month = (month_from_march + 2) % 12 + 1;
    let year = year_of_era + era * 400 + i64::from(month <= 2);
    format!("{year:04}-{month:02}-{day:02}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn days_are_dates() {
        for (days, wanted) in [
            (0, "1970-01-01"),
            (59, "1970-03-01"),
            (11_016, "2000-02-29"),
            (11_017, "2000-03-01"),
            (20_454, "2026-01-01"),
        ] {
            assert_eq!(date(days), wanted);
        }
    }

    #[test]
    fn a_machine_is_called_by_what_tells_it_from_others() {
        let name = |cpu: &str| {
            machine_name(&Machine {
                cpu: cpu.to_owned(),
                threads: 2,
                ..Machine::this()
            })
        };
        assert_eq!(name("Intel(R) Xeon(R) Processor"), "xeon-2-threads");
        assert_eq!(name("AMD EPYC 9B45"), "epyc-9b45-2-threads");
        assert_eq!(
            name("Intel(R) Core(TM) i7-8700K CPU @ 3.70GHz"),
            "i7-8700k-2-threads"
        );
    }

    #[test]
    fn a_record_is_kept_with_its_tables() {
        let folder = tempfile::tempdir().unwrap();
        let machine = Machine::this();
        let paths = keep(
            folder.path(),
            &machine,
            "against",
            "Against other tracers",
            "{}",
            "| a |\n",
        )
        .unwrap();
        assert!(paths[0].starts_with(folder.path().join(machine_name(&machine))));
        assert_eq!(fs::read_to_string(&paths[0]).unwrap(), "{}\n");
        assert!(fs::read_to_string(&paths[1]).unwrap().ends_with("| a |\n"));
    }
}
