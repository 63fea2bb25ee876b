#!/usr/bin/env python3
"""What viewers cost a render: the processor time of taking pictures and of the threads that serve them, as a share of the
run's, and when the first pictures of all frames come. Time on the processor is counted, so a busy machine does not matter.
usage: cost.py dspm scene [iterations [runs [viewers [halvings [frames]]]]]; of so many frames, each halved so often"""
import os, pathlib, re, statistics, sys, tempfile, threading, time, urllib.request

import viewer


def processor_seconds(process, named=None):
    """Of all threads, or of those of that name."""
    ticks, root = 0, pathlib.Path(f"/proc/{process}")
    for task in (root / "task").iterdir() if named else [root]:
        try:
            name, values = re.match(r"\d+ \((.*)\) (.*)", (task / "stat").read_text()).groups()
        except (OSError, AttributeError):
            continue  # it has ended
        if named in (None, name):
            ticks += sum(int(v) for v in values.split()[11:13])
    return ticks / os.sysconf("SC_CLK_TCK")


def run():
    with tempfile.TemporaryDirectory() as folder:
        begin = time.monotonic()
        process, url = viewer.serve(dspm, scene, folder, "--iterations", str(iterations))
        done, figures = threading.Event(), {"bytes": 0, "pictures": 0}

        def watch():
            for state in viewer.states(url):
                if state.get("phase") == "done":
                    figures["looking"] = state["looking"]
                    return done.set()

        def look(number):
            seen, frames = {}, min(viewer.frame_count(url), few)
            while not done.is_set():
                pictures, size = viewer.newer(url, number, frames, halvings, seen)
                figures["bytes"] += size
                figures["pictures"] += len(pictures)
                if "first" not in figures and len(seen) == frames:
                    figures["first"] = time.monotonic() - begin
        threading.Thread(target=watch, daemon=True).start()
        for number in range(viewers):
            threading.Thread(target=look, args=(number + 1,), daemon=True).start()
        done.wait()
        figures["seconds"] = time.monotonic() - begin
        figures["serving"], figures["all"] = processor_seconds(process.pid, "dspm page"), processor_seconds(process.pid)
        urllib.request.urlopen(url + "stop", b"")
        process.wait()
        return figures


dspm, scene = sys.argv[1:3]
iterations, runs, viewers, halvings, few = (int(v) for v in sys.argv[3:] + ["32", "3", "1", "0", "1000"][len(sys.argv) - 3:])
shares = []
for _ in range(runs):
    f = run()
    shares.append((f["looking"] + f["serving"]) / f["all"])
    print(f"{f['pictures']} pictures, {f['bytes'] / 1e6:.1f} MB in {f['seconds']:.1f} s, first of all frames after "
          f"{f.get('first', float('nan')):.2f} s; processor time {f['all']:.2f} s: taking pictures {f['looking']:.2f} s, "
          f"serving {f['serving']:.2f} s, {100 * shares[-1]:.2f}%", flush=True)
print(f"median {100 * statistics.median(shares):.2f}%")
