"""A viewer of the live page that is no browser: what cost.py and edits.py share."""
import json, re, subprocess, threading, time, urllib.request


def serve(dspm, scene, folder, *options):
    """Renders the scene into the folder; returns the process and the address of its page."""
    process = subprocess.Popen([dspm, scene, "--serve", "0", "-o", f"{folder}/a.####.exr", *options],
                               stderr=subprocess.PIPE, text=True)
    url = next(re.search(r"http://\S+", line)[0] for line in process.stderr if "page is at" in line)
    threading.Thread(target=process.stderr.read, daemon=True).start()
    return process, url


def states(url):
    """What the page says of the run, as it says it."""
    for line in urllib.request.urlopen(url + "events"):
        if line.startswith(b"data: {"):
            yield json.loads(line[6:])


def frame_count(url):
    """Once the run has begun."""
    while not (frames := len(json.load(urllib.request.urlopen(url + "run")).get("frames", []))):
        time.sleep(.02)
    return frames


def newer(url, viewer, frames, halvings, seen):
    """Waits for pictures of the first frames that are newer than those in `seen`, which holds versions by frame; returns
    frame, whether it is coarse, and the number of its run, and the bytes of all."""
    wishes = "".join(f"{f} radiance {halvings} {seen.get(f, 0)} {seen.get(f, 0)}\n" for f in range(frames))
    body = urllib.request.urlopen(url + "pictures", f"{viewer}\n{wishes}".encode()).read()
    pictures, size = [], len(body)
    while body:
        line, body = body.split(b"\n", 1)
        words = line.split()
        frame, body = int(words[0]), body[int(words[-1]):]
        seen[frame] = int(words[3])
        pictures.append((frame, words[9] == b"1", int(words[10])))
    return pictures, size
