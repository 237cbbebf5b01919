//! Runs benches: `cargo run --release -p ombra-bench -- whitted`.

use clap::Parser;
use ombra_accel::StructureKind;
use ombra_bench::machine::Machine;
use ombra_bench::record::Record;
use ombra_bench::{BENCHES, Settings};

/// Compares the answers of contestants, then takes their times in turns.
#[derive(Parser)]
#[command(name = "ombra-bench", version)]
struct Arguments {
    /// Which benches to run; all of them if none is named
    benches: Vec<String>,
    /// Lists the benches
    #[arg(long)]
    list: bool,
    /// Prints records as JSON
    #[arg(long)]
    json: bool,
    /// How many times each contestant runs on the clock; 0 compares answers only
    #[arg(long, default_value_t = 9)]
    rounds: usize,
    /// With how many threads, separated by commas; 0 is all of them
    #[arg(long, value_delimiter = ',', default_values_t = [1, 0])]
    threads: Vec<usize>,
    /// How many pixels wide and high pictures are
    #[arg(long, default_value_t = 256)]
    pixels: u32,
    /// How fine generated geometry is: hills have twice the square of this many triangles
    #[arg(long, default_value_t = 200)]
    detail: u32,
    /// The structure that rays are traced against
    #[arg(long, default_value_t)]
    accel: StructureKind,
}

fn main() -> anyhow::Result<()> {
    let arguments = Arguments::parse();
    if arguments.list {
        for bench in BENCHES {
            println!("{:<10} {}", bench.name, bench.line);
        }
        return Ok(());
    }
    for name in &arguments.benches {
        anyhow::ensure!(
            BENCHES.iter().any(|bench| bench.name == name),
            "there is no bench \"{name}\"; --list names them"
        );
    }
    let settings = Settings {
        rounds: arguments.rounds,
        threads: arguments.threads,
        pixels: arguments.pixels,
        detail: arguments.detail,
        accel: arguments.accel,
    };
    let mut records: Vec<Record> = Vec::new();
    for bench in BENCHES {
        if arguments.benches.is_empty() || arguments.benches.iter().any(|b| b == bench.name) {
            records.extend((bench.run)(&settings)?);
        }
    }
    let machine = Machine::this();
    if arguments.json {
        let all = serde_json::json!({ "machine": machine, "records": records });
        println!("{}", serde_json::to_string_pretty(&all)?);
    } else {
        println!(
            "{} ({} threads), {}",
            machine.cpu, machine.threads, machine.commit
        );
        for record in &records {
            println!("{record}");
        }
    }
    Ok(())
}
