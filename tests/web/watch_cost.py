#!/usr/bin/env python3
"""What the live view costs a run: seven pairs of runs, alone and watched by a client that asks as the page does.

    watch_cost.py PROGRAM CASE WORK [END]

Prints the wall and processor times of each pair and fails if the median slow-down by the clock exceeds 7 %. Only a quiet
machine gives a figure worth having.
"""
import http.client
import json
import os
import re
import shutil
import statistics
import subprocess
import sys
import threading
from pathlib import Path

PAIRS = 7
LARGEST_SLOWDOWN = 0.07


def follow(port, stop):
    """Once a second: the state, then the new rows, frames and cuts."""
    connection = http.client.HTTPConnection("127.0.0.1", port, timeout=10)

    def get(path):
        connection.request("GET", path)
        return connection.getresponse().read()

    known, sizes = {"frames": 0, "cuts": 0}, {}
    try:
        get("/")
        while not stop.is_set():
            state = json.loads(get("/state"))
            for name, size in state["tables"].items():
                if size > sizes.get(name, 0):
                    sizes[name] = sizes.get(name, 0) + len(get(f"/{name}.csv?from={sizes.get(name, 0)}"))
            for kind, one in (("frames", "frame"), ("cuts", "cut")):
                if state[kind] > known[kind]:
                    get(f"/{kind}?from={known[kind]}")
                    for number in range(known[kind], state[kind]):
                        get(f"/{one}?number={number}")
                    known[kind] = state[kind]
            stop.wait(1.0)
    except OSError:
        pass  # the run has ended, and its server with it


def simulate(program, case, folder, end, is_watched):
    """Wall time of the run itself and processor time of the process."""
    shutil.rmtree(folder, ignore_errors=True)
    command = [program, "run", case, "-o", str(folder), "--set", f"time.end={end}"]
    process = subprocess.Popen(command + (["--watch", "--port", "0"] if is_watched else []),
                               stdout=subprocess.PIPE, text=True)
    stop, client = threading.Event(), None
    for line in process.stdout:
        address = re.search(r"127\.0\.0\.1:(\d+)/", line)
        if is_watched and address and client is None:
            client = threading.Thread(target=follow, args=(int(address[1]), stop))
            client.start()
    _, status, usage = os.wait4(process.pid, 0)
    stop.set()
    if client:
        client.join()
    if status != 0 or (is_watched and client is None):
        sys.exit(f"the run failed: {' '.join(command)}")
    wall = json.loads((folder / "run.json").read_text(encoding="utf-8"))["wall_seconds"]
    return wall, usage.ru_utime + usage.ru_stime


def main():
    program, case, work = sys.argv[1], sys.argv[2], Path(sys.argv[3])
    end = sys.argv[4] if len(sys.argv) > 4 else "1.5"
    wall, processor = [], []
    for pair in range(PAIRS):
        # Whoever is second finds warmer caches: the order alternates.
        times = {w: simulate(program, case, work / "run", end, w) for w in ((False, True), (True, False))[pair % 2]}
        wall.append(times[True][0] / times[False][0] - 1.0)
        processor.append(times[True][1] / times[False][1] - 1.0)
        print(f"pair {pair}: alone {times[False][0]:.2f} s ({times[False][1]:.2f} s of processor), "
              f"watched {times[True][0]:.2f} s ({times[True][1]:.2f} s)", flush=True)
    slowdown = statistics.median(wall)
    print(f"median slow-down {slowdown:+.1%} by the clock, {statistics.median(processor):+.1%} in processor time")
    sys.exit(slowdown > LARGEST_SLOWDOWN)


if __name__ == "__main__":
    main()
