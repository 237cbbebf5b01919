#!/usr/bin/env python3
"""The business card, by its own program and by ombra, in turns, on one thread.

    cargo build --release
    python3 bench/card.py CARD.cpp [ROUNDS]

CARD.cpp is the program of Kensler's card, which is not ours to pass on; it is compiled with g++ -O3.
Both make 512 x 512 pixels of 64 samples. What counts is the time that a process has on a processor,
start and writing included; the ratio is the card's over ombra's, above 1 where ombra is faster.
"""

import os
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path


def seconds(command: list[str], output: Path) -> float:
    """Runs a command and gives the seconds of processor time that it took."""
    before = os.times()
    with output.open("wb") as file:
        subprocess.run(command, stdout=file, check=True)
    after = os.times()
    return (after.children_user + after.children_system) - (
        before.children_user + before.children_system
    )


def main() -> None:
    if len(sys.argv) not in (2, 3):
        sys.exit(__doc__)
    rounds = int(sys.argv[2]) if len(sys.argv) == 3 else 5
    ombra = Path(__file__).parent.parent / "target/release/ombra"
    with tempfile.TemporaryDirectory() as folder:
        card, out = Path(folder) / "card", Path(folder) / "card.ppm"
        subprocess.run(["g++", "-O3", "-w", sys.argv[1], "-o", str(card)], check=True)
        ours = [str(ombra), "render", "card", "-o", str(Path(folder) / "ombra.ppm")]
        ours += ["--threads", "1", "--quiet"]
        times = [(seconds([str(card)], out), seconds(ours, out)) for _ in range(rounds)]
    ratios = sorted(theirs / mine for theirs, mine in times)
    for theirs, mine in times:
        print(f"card {theirs:.2f} s, ombra {mine:.2f} s, ratio {theirs / mine:.3f}")
    print(f"median ratio {statistics.median(ratios):.3f} ({ratios[0]:.3f} to {ratios[-1]:.3f})")


main()
