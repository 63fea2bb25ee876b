#!/usr/bin/env python3
"""How soon a page has something to show: from the start of dspm until a viewer has coarse pictures of all frames, and until
it has those of the full size.
usage: first.py dspm scene [times]"""
import sys, tempfile, time

import viewer


def measure():
    """Seconds until coarse pictures, and until full ones."""
    begin = time.monotonic()
    with tempfile.TemporaryDirectory() as folder:
        process, url = viewer.serve(dspm, scene, folder)
        try:
            frames, seen, come = viewer.frame_count(url), {}, {True: {}, False: {}}
            while len(come[False]) < frames:
                pictures, _ = viewer.newer(url, 1, frames, 1, seen)
                for frame, is_coarse, _ in pictures:
                    come[is_coarse].setdefault(frame, time.monotonic() - begin)
            coarse = max(come[True].values()) if len(come[True]) == frames else max(come[False].values())
            return coarse, max(come[False].values())
        finally:
            process.terminate()
            process.wait()


if len(sys.argv) < 3:
    sys.exit(__doc__)
dspm, scene = sys.argv[1:3]
times = [measure() for _ in range(int((sys.argv[3:] + ["5"])[0]))]
for name, which in (("coarse", 0), ("full size", 1)):
    print(f"{name}: {min(t[which] for t in times):.2f} to {max(t[which] for t in times):.2f} s")
