#!/usr/bin/env python3
"""What viewers cost a render: the processor time of taking pictures and of the threads that serve them, as a share of the
run's, and when the first pictures of all frames come. Time on the processor is counted, so a busy machine does not matter.
usage: cost.py dspm scene [iterations [runs [viewers [halvings [frames]]]]]; of so many frames, each halved so often"""
import json, os, pathlib, re, statistics, subprocess, sys, tempfile, threading, time, urllib.request


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
        process = subprocess.Popen([dspm, scene, "--serve", "0", "--iterations", str(iterations), "-o", f"{folder}/a.####.exr"],
                                   stderr=subprocess.PIPE, text=True)
        url = next(re.search(r"http://\S+", line)[0] for line in process.stderr if "page is at" in line)
        threading.Thread(target=process.stderr.read, daemon=True).start()
        done, figures = threading.Event(), {"bytes": 0, "pictures": 0}

        def watch():
            for line in urllib.request.urlopen(url + "events"):
                if line.startswith(b"data: {") and (state := json.loads(line[6:])).get("phase") == "done":
                    figures["looking"] = state["looking"]
                    return done.set()

        def look(viewer):
            seen, frames = {}, None
            while not done.is_set():
                frames = frames or len(json.load(urllib.request.urlopen(url + "run")).get("frames", [])) or time.sleep(.02)
                if not frames:
                    continue
                wishes = "".join(f"{f} radiance {halvings} {seen.get((f, halvings), 0)} {seen.get((f, halvings), 0)}\n"
                                 for f in range(min(frames, few)))
                body = urllib.request.urlopen(url + "pictures", f"{viewer}\n{wishes}".encode()).read()
                figures["bytes"] += len(body)
                while body:
                    line, body = body.split(b"\n", 1)
                    words = line.split()
                    seen[int(words[0]), int(words[2])] = int(words[3])
                    body = body[int(words[-1]):]
                    figures["pictures"] += 1
                if "first" not in figures and len({f for f, _ in seen}) == min(frames, few):
                    figures["first"] = time.monotonic() - begin
        threading.Thread(target=watch, daemon=True).start()
        for viewer in range(viewers):
            threading.Thread(target=look, args=(viewer + 1,), daemon=True).start()
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
