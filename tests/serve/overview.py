#!/usr/bin/env python3
"""The page's table of variations in Debian's chromium, by the boxes of its elements: with few and with thousands, upright
and lying. A server of its own stands in for dspm, as nothing here needs a render. Exit code 77: as browser.py.
usage: overview.py folder-of-the-page [folder-for-screenshots]"""
import http.server, itertools, json, os, pathlib, struct, sys, tempfile, threading, zlib

import browser
from browser import Page, expect, until

CASES = {  # name: axes and the size of the images
    "24-upright": ([6, 2, 2], (90, 160)), "24-lying": ([6, 2, 2], (160, 90)),
    "144-upright": ([6, 4, 3, 2], (90, 160)), "144-lying": ([6, 4, 3, 2], (160, 90)),
    "1000-upright": ([10, 10, 10], (90, 160)), "1000-lying": ([10, 10, 10], (160, 90)),
    "5000-lying": ([25, 10, 20], (160, 90)), "300-in-a-row": ([300], (160, 90)), "folded": ([1, 4, 1, 3], (90, 160)),
}
WORDS = ["glass", "cap", "label", "light"]


def run_of(name):
    axes, (width, height) = CASES[name]
    names = [[f"{WORDS[a]}{i + 1}" for i in range(n)] for a, n in enumerate(axes)]
    frames = [{"label": " ".join(names[a][c] for a, c in enumerate(choices)), "moment": 1, "variation": i,
               "choices": choices} for i, choices in enumerate(itertools.product(*map(range, axes)))]
    return {"run": 1, "scene": name, "width": width, "height": height, "fps": 24, "frames": frames, "groups": [],
            "axes": [{"name": WORDS[a], "variations": n} for a, n in enumerate(names)], "images": [f["label"] for f in frames],
            "outputs": [{"name": "radiance", "sentence": "", "is_id": 0, "is_radiance": 1, "channels": ["R", "G", "B"],
                         "names": []}], "view": {"name": "standard", "stops": 0}, "center": [0, 0, 0], "radius": 1}


def grey(value, count):
    bits, = struct.unpack("<H", struct.pack("<e", value))
    plane = bytes([bits >> 8]) + bytes(count - 1) + bytes([bits & 255]) + bytes(count - 1)
    return zlib.compress(3 * plane)


class Handler(http.server.BaseHTTPRequestHandler):
    protocol_version = "HTTP/1.1"

    def answer(self, body, kind):
        self.send_response(200)
        self.send_header("Content-Type", kind)
        self.send_header("Content-Length", str(len(body)))
        self.end_headers()
        self.wfile.write(body)

    def do_GET(self):
        _, case, file = self.path.split("?")[0].split("/")
        kinds = {"css": "text/css", "js": "text/javascript", "html": "text/html"}
        if file == "run":
            return self.answer(json.dumps(run_of(case)).encode(), "application/json")
        if file == "events":
            state = {"run": 1, "phase": "done", "coarse": 0, "guided": 1, "step": "", "iterations": 4, "of": 4, "seconds": 1,
                     "share": 1}
            return self.answer(f"event: state\ndata: {json.dumps(state)}\n\n".encode(), "text/event-stream")
        file = file or "index.html"
        self.answer((pathlib.Path(folder) / file).read_bytes(), kinds[file.rsplit(".", 1)[1]])

    def do_POST(self):
        lines = self.rfile.read(int(self.headers["Content-Length"])).decode().split("\n")[1:]
        body = b""
        for line in filter(None, lines):
            frame, output, halvings, version, _ = line.split()
            if int(version) == 0:
                pixels = grey(.2 + .6 * (int(frame) % 7) / 7, 16 * 9)
                body += f"{frame} {output} {halvings} 1 16 9 3 2 4 0 1 {len(pixels)}\n".encode() + pixels
        if not body:
            threading.Event().wait(1)
        self.answer(body, "application/octet-stream")

    def log_message(self, *_):
        pass


BOXES = """(() => { const box = e => (b => [b.x, b.y, b.width, b.height])(e.getBoundingClientRect());
    return {cells: box(document.getElementById('cells')),
            buttons: [...document.querySelectorAll('#cells button')].map(e => [box(e), box(e.children[0]), box(e.children[1]), e.innerText]),
            heads: [...document.querySelectorAll('#cells .head')].map(e => [box(e), e.innerText])}; })()"""


def disjoint(boxes):
    """Sweeps over y: none lies over another."""
    open_boxes = []
    for x, y, w, h in sorted(boxes, key=lambda b: b[1]):
        open_boxes = [b for b in open_boxes if b[1] + b[3] > y + .5]
        for b in open_boxes:
            if b[0] + b[2] > x + .5 and x + w > b[0] + .5:
                return False
        open_boxes.append((x, y, w, h))
    return True


def is_laid_out(page, name, count):
    axes, (width, height) = CASES[name]
    boxes = page.js(BOXES)
    expect(boxes["buttons"], f"{name}: there are pictures")
    if count <= 1000:
        expect(len(boxes["buttons"]) == count, f"{name}: {len(boxes['buttons'])} of {count}")
    else:
        expect(len(boxes["buttons"]) < 1500, f"{name}: {len(boxes['buttons'])} elements exist at a time")
    expect(disjoint([b[0] for b in boxes["buttons"]] + [h[0] for h in boxes["heads"]]), f"{name}: boxes overlap")
    for whole, picture, label, text in boxes["buttons"]:
        expect(abs(picture[2] / picture[3] / (width / height) - 1) < .03, f"{name}: a picture of {picture[2:]}")
        expect(picture[2] >= 60 and picture[1] + picture[3] <= label[1] + 1 and label[1] + label[3] <= whole[1] + whole[3] + 1,
               f"{name}: {text} lies under its picture: {picture}, {label}, {whole}")


def look(page, url, name):
    page.go(f"{url}/{name}/")
    until(lambda: page.js("document.getElementById('scene')?.textContent") == name and
          page.js("document.querySelectorAll('#cells button').length"), f"{name} is there")
    count = len(run_of(name)["frames"])
    is_laid_out(page, name, count)
    page.shot(name)
    page.js("document.getElementById('cells').scrollTo(1e7, 1e7)")
    last = run_of(name)["frames"][-1]["label"]
    until(lambda: page.js(f"[...document.querySelectorAll('#cells button')].some(e => e.innerText === {last!r} && "
                          "e.getBoundingClientRect().bottom <= innerHeight)"), f"{name} scrolls to the last")
    is_laid_out(page, name, count)
    until(lambda: (p := page.pixel("#cells button:last-of-type div")) and max(p) > 40, f"{name}: the last has its picture")
    page.shot(name + "-end")


def folds_filters_and_chooses(page, url):
    page.go(f"{url}/folded/")
    heads = lambda: [h[1] for h in page.js(BOXES)["heads"]]
    until(lambda: page.js("document.getElementById('scene')?.textContent") == "folded" and heads(), "folded is there")
    expect(heads() == ["light1", "light2", "light3", "cap1", "cap2", "cap3", "cap4"], f"axes of one are folded: {heads()}")
    expect(page.js("document.documentElement.scrollWidth <= innerWidth"), "the page fits into the window")
    page.js("(e => { e.value = '1', e.dispatchEvent(new Event('change')); })(document.getElementById('columns'))")
    until(lambda: heads()[:4] == ["cap1", "cap2", "cap3", "cap4"], "the chosen axis lies in columns")
    page.js("(e => { e.value = 'cap2 LIGHT', e.dispatchEvent(new Event('input')); })(document.getElementById('filter'))")
    until(lambda: len(page.js(BOXES)["buttons"]) == 3 and heads() == ["light1", "light2", "light3"], "a filter")
    is_laid_out(page, "folded", 3)
    page.js("(e => { e.value = '', e.dispatchEvent(new Event('input')); })(document.getElementById('filter'))")
    page.js("(e => { e.value = '-1', e.dispatchEvent(new Event('change')); })(document.getElementById('columns'))")
    until(lambda: len(page.js(BOXES)["buttons"]) == 12 and not heads(), "one after the other")
    is_laid_out(page, "folded", 12)


def main():
    server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), Handler)
    server.daemon_threads, server.handle_error = True, lambda *_: None  # pages leave without waiting
    threading.Thread(target=server.serve_forever, daemon=True).start()
    url = f"http://127.0.0.1:{server.server_port}"
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as profile:  # chromium may still write
        page = Page("about:blank", profile)
        try:
            for name in CASES:
                look(page, url, name)
            folds_filters_and_chooses(page, url)
            problems = [p for p in page.problems if "events" not in p]  # the stub's end at once
            expect(not problems, problems)
        except AssertionError:
            page.shot("failed")
            raise
        finally:
            page.close()
    print("the table is laid out:", ", ".join(CASES))


if __name__ == "__main__":
    folder, browser.shots = os.path.abspath(sys.argv[1]), sys.argv[2] if len(sys.argv) > 2 else None
    main()
