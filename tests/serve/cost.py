#!/usr/bin/env python3
"""What a viewer costs a render: processor time of runs that someone looks at, and of runs with a page that nobody opens,
alternately; and when the first pictures of all frames come.
usage: cost.py dspm scene [iterations [pairs]]"""
import json, re, resource, statistics, subprocess, sys, tempfile, threading, time, urllib.request


def run(looks):
    with tempfile.TemporaryDirectory() as folder:
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        begin = time.monotonic()
        process = subprocess.Popen([dspm, scene, "--serve", "0", "--iterations", str(iterations), "-o", f"{folder}/a.####.exr"],
                                   stderr=subprocess.PIPE, text=True)
        url = next(re.search(r"http://\S+", line)[0] for line in process.stderr if "page is at" in line)
        threading.Thread(target=process.stderr.read, daemon=True).start()
        done, figures = threading.Event(), {"bytes": 0, "pictures": 0}

        def watch():
            for line in urllib.request.urlopen(url + "events"):
                if line.startswith(b"data: {") and json.loads(line[6:]).get("phase") == "done":
                    return done.set()

        def look():
            seen, frames = {}, None
            while not done.is_set():
                frames = frames or len(json.load(urllib.request.urlopen(url + "run")).get("frames", [])) or time.sleep(.02)
                if not frames:
                    continue
                wishes = "".join(f"{f} radiance {halvings} {seen.get((f, halvings), 0)} {seen.get((f, halvings), 0)}\n"
                                 for f in range(frames))
                body = urllib.request.urlopen(url + "pictures", f"1\n{wishes}".encode()).read()
                figures["bytes"] += len(body)
                while body:
                    line, body = body.split(b"\n", 1)
                    words = line.split()
                    seen[int(words[0]), int(words[2])] = int(words[3])
                    body = body[int(words[-1]):]
                    figures["pictures"] += 1
                if "first" not in figures and len({f for f, _ in seen}) == frames:
                    figures["first"] = time.monotonic() - begin
        threading.Thread(target=watch, daemon=True).start()
        if looks:
            threading.Thread(target=look, daemon=True).start()
        done.wait()
        figures["seconds"] = time.monotonic() - begin
        urllib.request.urlopen(url + "stop", b"")
        process.wait()
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime, figures


dspm, scene = sys.argv[1:3]
iterations, pairs = (int(v) for v in (sys.argv[3:5] + ["32", "5"][len(sys.argv) - 3:]))
halvings = 0
looked, alone = [], []
for i in range(pairs):
    for looks in (True, False) if i % 2 == 0 else (False, True):
        seconds, figures = run(looks)
        (looked if looks else alone).append(seconds)
        if looks:
            print(f"{figures['pictures']} pictures, {figures['bytes'] / 1e6:.1f} MB in {figures['seconds']:.1f} s, "
                  f"first of all frames after {figures.get('first', float('nan')):.2f} s")
a, b = statistics.median(looked), statistics.median(alone)
print(f"processor time: {a:.2f} s with a viewer, {b:.2f} s without: {100 * (a / b - 1):+.1f}%; "
      f"pairs: {' '.join(f'{100 * (x / y - 1):+.1f}%' for x, y in zip(looked, alone))}")
