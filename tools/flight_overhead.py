#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""flight_overhead.py FLYTHROUGH FOLDER: measures the overhead of a segment. Makes films of 10 and of 40 segments that
are so small that rendering takes almost no time, in one process and, if mpirun exists, on 1, 2 and 4 ranks. The
difference over 30 is the overhead of a segment, without that of the program's start. Writes
FOLDER/flight_overhead.txt."""
import os
import shutil
import subprocess
import sys
import tempfile
import time

from table_file import put

FRAMES = 60  # per segment
FEW, MANY = 10, 40  # segments
ROUNDS = 3


def run(*command):
    start = time.monotonic()
    env = dict(os.environ, OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1")
    done = subprocess.run(command, capture_output=True, text=True, env=env)
    if done.returncode != 0:
        sys.exit(f"flight_overhead: {' '.join(command)}: {done.stderr.strip()}")
    return time.monotonic() - start


def launchers():
    """Returns the commands that start the program: none, then mpirun with 1, 2 and 4 ranks."""
    found = [("one process", [])]
    if shutil.which("mpirun"):
        found += [(f"mpirun -n {n}", ["mpirun", "--oversubscribe", "--bind-to", "none", "-n", str(n)]) for n in (1, 2, 4)]
    return found


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    program, folder = os.path.abspath(sys.argv[1]), sys.argv[2]
    head = f"{'':14}" + "".join(f"{f'{n} segments, s':>16}" for n in (FEW, MANY)) + f"{'ms a segment':>16}"
    lines = ["flight study: what a segment costs beside its drawing", "", head]
    with tempfile.TemporaryDirectory() as scratch:
        paths = {}
        for segments in (FEW, MANY):
            paths[segments] = os.path.join(scratch, f"{segments}.json")
            run(program, "plan", paths[segments], "--frames", str(segments * FRAMES))
        for name, launcher in launchers():
            seconds = {}
            for segments, path in paths.items():
                film = os.path.join(scratch, "film.mp4")
                times = []
                for _ in range(ROUNDS):
                    times.append(run(*launcher, program, "render", path, "--size", "64x36", "--samples", "1", "--backend",
                                     "openmp", "--output", film))
                    os.remove(film)
                    os.remove(film + ".made")
                seconds[segments] = sorted(times)[ROUNDS // 2]
            cost = 1000 * (seconds[MANY] - seconds[FEW]) / (MANY - FEW)
            lines.append(f"{name:14}" + "".join(f"{seconds[n]:>16.2f}" for n in (FEW, MANY)) + f"{cost:>16.0f}")
    lines.append(f"Films of 64 x 36 on {os.cpu_count()} cores, the median of {ROUNDS} runs. A segment is {FRAMES} frames: asking")
    lines.append("for it, starting the encoder, drawing and encoding tiny frames, syncing and renaming the file.")
    text = "\n".join(lines) + "\n"
    put(text, os.path.join(folder, "flight_overhead.txt"))


if __name__ == "__main__":
    main()
