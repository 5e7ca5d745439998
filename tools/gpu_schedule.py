#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""gpu_schedule.py PROGRAMS [--gpu K40|H100]... [--waves N]: simulates how the warps of OpenACC's march share a GPU, for a frame of
1920 x 1080. Prints the active lanes, the steps of the longest warp and the time for several schedules.

A quarter of a multiprocessor serves its warps in turn; a warp alone waits for the result of each instruction. Each step
of a ray takes the same number of iterations, and beginning rays takes as long as a step."""
import argparse
import heapq
import os

import numpy as np

import gpu_expected
import k40

WARP = 8, 4  # columns and rows: warp_width and warp_height in core/job/job.h
WARPS = k40.BLOCK // gpu_expected.LANES  # of a block
STEPS_OF_ROUND = 4  # core/job/threads.h
RESIDENT = 2048  # threads that a multiprocessor holds at most


def rows_of_band(gpu, waves):
    """Returns the rows of a band, computed as by pixels_of_band() in core/job/driver.h."""
    return min(max(waves * RESIDENT * gpu.multiprocessors, 1 << 18), 1 << 22) // gpu_expected.WIDTH


def tiled(values):
    """Returns the values of the pixels, a row for each warp. `values`: by row of the picture, the top one first."""
    (rows, columns), (width, height) = values.shape, WARP
    padded = np.pad(values[::-1], ((0, -rows % height), (0, -columns % width)))
    return padded.reshape(-1, height, padded.shape[1] // width, width).swapaxes(1, 2).reshape(-1, width * height)


class Tiles:
    """A warp marches a tile of pixels until its last ray has ended. `queue`: it then takes the next tile; otherwise it
    ends, and its block ends with its last warp."""
    def __init__(self, march, steps, iterations, order, queue):
        lanes = np.argsort(-steps, axis=1)
        steps, each = (np.take_along_axis(values, lanes, axis=1) for values in (steps, iterations))
        rounds = -np.diff(steps, axis=1, append=0)
        slowest = np.maximum.accumulate(each, axis=1)
        self.cycles = ((march.step_cycles + march.round_cycles * slowest) * rounds).sum(axis=1) + march.step_cycles
        self.steps, self.order, self.queue, self.next = steps[:, 0], order, queue, 0
        self.slots = self.steps[order].sum() * gpu_expected.LANES

    def segment(self, warp):
        if self.next == len(self.order) or (warp["steps"] and not self.queue):
            return None
        tile = self.order[self.next]
        self.next += 1
        warp["steps"] += max(1, self.steps[tile])
        return self.cycles[tile]


class Refill:
    """A lane whose ray has ended takes the next pixel of a queue."""
    queue = True

    def __init__(self, march, steps, iterations, order):
        self.march, self.steps, self.iterations = march, steps[order].ravel(), iterations[order].ravel()
        self.order, self.next, self.slots = order, 0, 0

    def segment(self, warp):
        left, each = warp.setdefault("lanes", np.zeros((2, gpu_expected.LANES)))
        idle = np.flatnonzero(left <= 0)
        taken = slice(self.next, self.next + len(idle))
        lanes = idle[:len(self.steps[taken])]
        self.next += len(lanes)
        left[lanes], each[lanes] = self.steps[taken], self.iterations[taken]
        cycles = self.march.step_cycles * bool(len(lanes))
        for _ in range(STEPS_OF_ROUND):
            active = left > 0
            if not active.any():
                break
            cycles += self.march.step_cycles + self.march.round_cycles * each[active].max()
            left[active] -= 1
            warp["steps"] += 1
            self.slots += gpu_expected.LANES
        return cycles if cycles else None


class Quarter:
    """A quarter of a multiprocessor. `served`: the cycles that each of its warps has been served so far."""
    def __init__(self, latency):
        self.latency, self.served, self.time, self.warps, self.stamp = latency, 0, 0, [], 0

    def advance(self, time):
        self.served += (time - self.time) / max(self.latency, len(self.warps))
        self.time = time

    def next_end(self):
        return self.time + max(0, self.warps[0][0] - self.served) * max(self.latency, len(self.warps))


def simulated(gpu, resident, blocks, schedule):
    """Returns the cycles until the last warp ends, and the steps of the longest warp. `resident`: blocks that a
    multiprocessor holds at once."""
    quarters = [Quarter(gpu.latency) for _ in range(gpu.quarters())]
    ends, count, longest, last = [], 0, 0, 0
    waiting = min(blocks, resident * gpu.multiprocessors) if schedule.queue else blocks

    def serve(quarter, warp):
        """Gives the warp its next work. Returns False if there is none."""
        nonlocal count
        cycles = schedule.segment(warp)
        if cycles is not None:
            count += 1
            heapq.heappush(quarter.warps, (quarter.served + cycles, count, warp))
        return cycles is not None

    def plan(number):
        quarter = quarters[number]
        quarter.stamp += 1
        if quarter.warps:
            heapq.heappush(ends, (quarter.next_end(), number, quarter.stamp))

    def begin(multiprocessor, time):
        nonlocal waiting
        waiting -= 1
        block = {"warps": 0}
        for number in range(WARPS * multiprocessor, WARPS * (multiprocessor + 1)):
            quarters[number].advance(time)
            block["warps"] += serve(quarters[number], {"steps": 0, "block": block})
            plan(number)

    for i in range(resident * gpu.multiprocessors):
        if waiting:
            begin(i % gpu.multiprocessors, 0)
    while ends:
        time, number, stamp = heapq.heappop(ends)
        quarter = quarters[number]
        if stamp != quarter.stamp:
            continue
        quarter.advance(time)
        _, _, warp = heapq.heappop(quarter.warps)
        if not serve(quarter, warp):
            last, longest = time, max(longest, warp["steps"])
            warp["block"]["warps"] -= 1
            if waiting and warp["block"]["warps"] == 0:
                begin(number // WARPS, time)
        plan(number)
    return last, longest


def table(render, name, waves):
    gpu = gpu_expected.GPUS[name]
    found = gpu_expected.marches(render, gpu)
    _, architecture, tool, most_blocks = next(row for row in k40.GPUS if row[0] == name)
    registers = k40.resources(k40.extract(render)[0], k40.pinned(tool), architecture)
    print(f"{name}\n{'fractal':<12}{'precision':<11}{'mode':<7}{'schedule':<36}{'active lanes':>13}{'longest warp, steps':>21}{'ms':>8}")
    for key in sorted(key for key in found if key[0] == "openacc"):
        march = found[key]
        resident = k40.threads(registers["_".join(("march", *key[1:]))][0], most_blocks) // k40.BLOCK
        steps, iterations = (tiled(values) for values in gpu_expected.drawn(render, *key[1:]))
        each = iterations / np.maximum(steps, 1)
        cost = ((march.step_cycles + march.round_cycles * each) * steps).max(axis=1)
        tiles = np.arange(len(steps))
        band = rows_of_band(gpu, waves) // WARP[1] * -(-gpu_expected.WIDTH // WARP[0])
        bands = [tiles[first:first + band] for first in range(0, len(tiles), band)]
        heavy = [order[np.argsort(-cost[order])] for order in bands]
        for text, made in (("blocks", [Tiles(march, steps, each, order, False) for order in bands]),
                           ("queue of tiles", [Tiles(march, steps, each, order, True) for order in bands]),
                           ("queue of pixels, refill", [Refill(march, steps, each, order) for order in bands]),
                           ("the same, heaviest tiles first", [Refill(march, steps, each, order) for order in heavy])):
            ends = [simulated(gpu, resident, -(-len(one.order) // WARPS), one) for one in made]
            print(f"{key[1]:<12}{key[2]:<11}{key[3]:<7}{text:<36}{steps.sum() / sum(one.slots for one in made):>13.0%}"
                  f"{max(longest for _, longest in ends):>21.0f}{1e3 * sum(cycles for cycles, _ in ends) / gpu.clock:>8.3g}", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("programs")
    parser.add_argument("--gpu", choices=gpu_expected.GPUS, action="append")
    parser.add_argument("--waves", type=int, default=128, help="pixels of a band for each thread that the GPU can hold (default 128)")
    arguments = parser.parse_args()
    for name in arguments.gpu or gpu_expected.GPUS:
        table(os.path.join(arguments.programs, "render"), name, arguments.waves)


if __name__ == "__main__":
    main()
