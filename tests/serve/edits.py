#!/usr/bin/env python3
"""How soon an edit is seen: replaces a word in a file of the scene, again and again, and says after how long the page had
begun anew and had coarse pictures of all frames. It waits between edits for that many seconds, each time anew at random
by up to half more or less, so that they meet the render in different steps; "during" is the step that they met.
usage: edits.py dspm scene file old new [edits [seconds]]     with {} in `new` for the number of the edit, as in
       edits.py build/release/dspm scenes/horse.dsc scenes/horse/setting.dsc '"float eta" 1.5' '"float eta" 1.5{}'
The file gets its old text back."""
import pathlib, random, statistics, sys, tempfile, threading, time

import viewer


def watch():
    """Notes when the page says which state."""
    for state in viewer.states(url):
        states.append((time.monotonic(), state))


def look():
    """Asks for all frames at half of the size, as a page with all of them does, and notes when coarse ones come."""
    seen = {}
    while not ended.is_set():
        try:
            pictures, _ = viewer.newer(url, 1, frames, 1, seen)
        except OSError:
            return  # the run has ended
        coarse.extend((time.monotonic(), frame, run) for frame, is_coarse, run in pictures if is_coarse)


def edit(number):
    """Saves the file; returns when the page had begun anew, and when it had pictures of all frames."""
    during = states[-1][1]["step"]
    run = max([states[-1][1]["run"]] + [run for _, _, run in coarse])
    begin = time.monotonic()
    path.write_text(text.replace(old, new.format(number)))
    while True:
        time.sleep(.01)
        anew = next((at for at, state in list(states) if at > begin and state["run"] > run and state["coarse"]), None)
        come = {}
        for at, frame, of_run in list(coarse):
            if of_run > run:
                come.setdefault(frame, at)
        if anew and len(come) == frames:
            return during, anew - begin, max(come.values()) - begin
        if time.monotonic() > begin + 60:
            sys.exit(f"edits.py: 60 seconds after edit {number} there were pictures of {len(come)} of {frames} frames")


if len(sys.argv) < 6:
    sys.exit(__doc__)
dspm, scene, file, old, new = sys.argv[1:6]
edits, seconds = int((sys.argv[6:] + ["8"])[0]), float((sys.argv[7:] + ["4"])[0])
path = pathlib.Path(file)
text = path.read_text()
if old not in text:
    sys.exit(f"edits.py: {file} does not hold {old}")
states, coarse, ended = [], [], threading.Event()
with tempfile.TemporaryDirectory() as folder:
    process, url = viewer.serve(dspm, scene, folder)
    try:
        frames = viewer.frame_count(url)
        for task in watch, look:
            threading.Thread(target=task, daemon=True).start()
        times = []
        for number in range(edits):
            time.sleep(seconds * random.uniform(.5, 1.5))
            during, anew, all_frames = edit(number + 1)
            times.append(all_frames)
            print(f"during {during}: begun anew after {anew:.2f} s, pictures of all frames after {all_frames:.2f} s",
                  flush=True)
        print(f"median {statistics.median(times):.2f} s, longest {max(times):.2f} s")
    finally:
        path.write_text(text)
        ended.set()
        process.terminate()
        process.wait()
