#!/usr/bin/env python3
"""The live page in Debian's chromium, driven by its debugging protocol. Exit code 77: chromium or python3-websocket is
missing. With a folder as the second argument, screenshots stay there.
usage: browser.py dspm [folder]"""
import base64, json, os, pathlib, re, shutil, subprocess, sys, tempfile, time, urllib.request

chromium = shutil.which("chromium")
try:
    import websocket
except ImportError:
    websocket = None
if not chromium or not websocket:
    print("SKIPPED: needs the packages chromium and python3-websocket")
    sys.exit(77)

SCENE = """
Frames 3 "float fps" 8
Integrator "dsppm" "integer iterations" 3 "integer photons" 2000 "integer seed" 5
LookAt 0 0 -4  0 0 0  0 1 0
Camera "perspective" "float fov" 45
Film "rgb" "integer xresolution" 96 "integer yresolution" 64 "string filename" "tiny.exr"
WorldBegin
  AttributeBegin
    AreaLightSource "diffuse" "rgb L" [60 60 60]
    Translate 0 2 -1
    Shape "sphere" "float radius" 0.3
  AttributeEnd
  Material "diffuse" "rgb reflectance" [.7 .6 .5]
  AttributeBegin
    Translate 0 0 30
    Shape "sphere" "float radius" 29
  AttributeEnd
  DynamicBegin "ball"
    Keyframe 1  Translate -1 0 0
    Keyframe 3  Translate 1 0 0
    KeyframeEnd
    Shape "sphere" "float radius" 0.4
  DynamicEnd
"""

LIT = SCENE.replace('"diffuse" "rgb L"', '"diffuse" "string group" "key" "rgb L"').replace('  Material "diffuse"', """
  LightSource "point" "string group" "fill" "point3 from" [-2 1 -3] "rgb I" [1 2 4]
  Material "diffuse\"""")


class Page:
    """One tab."""

    def __init__(self, url, folder, size=(1400, 900)):
        self.profile = tempfile.mkdtemp(dir=folder)
        self.process = subprocess.Popen(
            [chromium, "--headless=new", "--no-sandbox", "--disable-gpu-sandbox", "--use-angle=swiftshader",
             "--enable-unsafe-swiftshader", "--remote-debugging-port=0", "--remote-allow-origins=*", "--no-first-run",
             "--disable-background-networking", "--disable-component-update", f"--user-data-dir={self.profile}",
             f"--window-size={size[0]},{size[1]}", "about:blank"],
            stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        port_file = pathlib.Path(self.profile) / "DevToolsActivePort"
        until(lambda: port_file.exists() and len(port_file.read_text().split()) == 2, "chromium starts", 60)
        port = port_file.read_text().split()[0]
        tabs = json.load(urllib.request.urlopen(f"http://127.0.0.1:{port}/json"))
        tab = next(t for t in tabs if t["type"] == "page")
        self.socket = websocket.create_connection(tab["webSocketDebuggerUrl"], timeout=60)
        self.number, self.problems = 0, []
        for domain in ("Page", "Runtime", "Log", "Network"):
            self.call(f"{domain}.enable")
        self.call("Emulation.setDeviceMetricsOverride", width=size[0], height=size[1], deviceScaleFactor=1, mobile=False)
        self.go(url)

    def call(self, method, **params):
        self.number += 1
        self.socket.send(json.dumps({"id": self.number, "method": method, "params": params}))
        while True:
            message = json.loads(self.socket.recv())
            if message.get("method") == "Runtime.exceptionThrown":
                self.problems.append(message["params"]["exceptionDetails"].get("exception", {}).get("description"))
            if message.get("method") == "Log.entryAdded" and message["params"]["entry"]["level"] == "error":
                self.problems.append(message["params"]["entry"]["text"])
            if message.get("id") == self.number:
                if "error" in message:
                    raise AssertionError(f"{method}: {message['error']}")
                return message["result"]

    def go(self, url):
        self.call("Page.navigate", url=url)

    def js(self, text):
        result = self.call("Runtime.evaluate", expression=text, awaitPromise=True, returnByValue=True)
        if "exceptionDetails" in result:
            raise AssertionError(f"{text}: {result['exceptionDetails']}")
        return result["result"].get("value")

    def key(self, key, shift=False):
        code = {"ArrowLeft": 37, "ArrowRight": 39, "Escape": 27, "Enter": 13, " ": 32}.get(key, ord(key[0].upper()))
        text = {"text": key if key != "Enter" else "\r"} if len(key) == 1 or key == "Enter" else {}
        for kind in ("keyDown", "keyUp"):
            self.call("Input.dispatchKeyEvent", type=kind, key=key, windowsVirtualKeyCode=code,
                      modifiers=8 if shift else 0, **(text if kind == "keyDown" else {}))

    def mouse(self, kind, x, y, **more):
        self.call("Input.dispatchMouseEvent", type=kind, x=x, y=y, **more)

    def drag(self, start, end, modifiers=0, button="left"):
        self.mouse("mousePressed", *start, button=button, clickCount=1, modifiers=modifiers)
        for i in range(1, 6):
            self.mouse("mouseMoved", *(a + (b - a) * i / 5 for a, b in zip(start, end)), button=button, modifiers=modifiers,
                       buttons=1)
        self.mouse("mouseReleased", *end, button=button, clickCount=1, modifiers=modifiers)

    def shot(self, name=None):
        """The screen as PNG."""
        data = base64.b64decode(self.call("Page.captureScreenshot", format="png")["data"])
        if name and shots:
            (pathlib.Path(shots) / f"{name}.png").write_bytes(data)
        return data

    def pixel(self, selector, fx=.5, fy=.5):
        """The screen's colour within an element, as the browser composed it."""
        box = self.js(f"(b => b && [b.x, b.y, b.width, b.height])(document.querySelector({selector!r})?.getBoundingClientRect())")
        if not box:
            return None
        x, y = box[0] + fx * box[2], box[1] + fy * box[3]
        clip = {"x": int(x), "y": int(y), "width": 1, "height": 1, "scale": 1}
        data = self.call("Page.captureScreenshot", format="png", clip=clip)["data"]
        return self.js(f"""(async () => {{ const i = new Image(); i.src = 'data:image/png;base64,{data}'; await i.decode();
            const c = document.createElement('canvas').getContext('2d'); c.drawImage(i, 0, 0);
            return [...c.getImageData(0, 0, 1, 1).data].slice(0, 3); }})()""")

    def close(self):
        self.socket.close()
        self.process.terminate()
        self.process.wait()


def until(holds, what, seconds=30):
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        value = holds()
        if value:
            return value
        time.sleep(.05)
    raise AssertionError(f"never: {what}")


def expect(holds, what):
    if not holds:
        raise AssertionError(what)


class Dspm:
    def __init__(self, folder, *more, scene="tiny.dsc"):
        self.log = pathlib.Path(folder) / "log.txt"
        self.process = subprocess.Popen([dspm, scene, "--serve", "0", *more], cwd=folder, stderr=self.log.open("w"))
        until(lambda: "page is at" in self.log.read_text(), "dspm serves")
        self.url = re.search(r"http://\S+", self.log.read_text())[0]

    def end(self):
        if self.process.poll() is None:
            self.process.terminate()
        self.process.wait()


def state(page, text):
    until(lambda: text in page.js("document.getElementById('state')?.textContent ?? ''"), f"the page says {text!r}", 60)


def lit(page, selector, fx=.5, fy=.5):
    return until(lambda: (p := page.pixel(selector, fx, fy)) and max(p) > 40 and p, f"{selector} shows a picture")


def shows_scrubs_and_exposes(page):
    state(page, "done")
    until(lambda: page.js("document.querySelectorAll('#cells button').length") == 3, "three frames")
    dim = lit(page, "#cells button div", .5, .8)
    page.shot("all")
    page.js("document.querySelector('#cells button').click()")
    until(lambda: not page.js("document.getElementById('large').hidden"), "one is large")
    lit(page, "#large", .5, .85)
    page.key("ArrowRight")
    until(lambda: "frame 2" in page.js("document.getElementById('moment').textContent"), "the next frame")
    before = page.pixel("#large", .8, .3)
    page.key("E", shift=True)
    until(lambda: max(page.pixel("#large", .8, .3)) < max(before) - 8, "less exposure is darker")
    page.key("e")
    until(lambda: page.pixel("#large", .8, .3) == before, "and back")
    for tone in range(1, 9):
        page.key("t")
        expect(page.js("document.getElementById('tone').value") == str(tone), "tone mapping by key")
    until(lambda: page.pixel("#large", .8, .3) != before, "false colour differs")
    page.shot("false-colour")
    page.key("t")
    return dim


def values_are_those_of_the_image(page):
    box = page.js("(b => [b.x, b.y, b.width, b.height])(document.getElementById('large').getBoundingClientRect())")
    page.mouse("mouseMoved", box[0] + .8 * box[2], box[1] + .3 * box[3])
    text = until(lambda: "radiance" in page.js("document.getElementById('values').textContent") and
                 page.js("document.getElementById('values').textContent"), "values")
    numbers = [float(n) for n in text.split("radiance")[1].split()[:3]]
    expect(all(0 < n < 100 for n in numbers) and numbers[0] > numbers[2], f"the ground is reddish: {text}")


def plays(page):
    page.key("Escape")
    page.js("document.querySelector('#cells button').click()")
    seen = set()
    page.key(" ")
    until(lambda: seen.add(page.js("document.getElementById('moment').textContent")) or len(seen) == 3, "all frames play")
    page.key(" ")


def wipes(page):
    page.js("document.getElementById('compare').value = 'frame 2', document.getElementById('compare').onchange()")
    until(lambda: not page.js("document.getElementById('wipe').hidden"), "the wipe's line")
    page.shot("wipe")
    page.key("s")
    expect("snapshot 1" in page.js("document.getElementById('compare').textContent"), "a snapshot to compare with")
    page.js("document.getElementById('compare').value = '', document.getElementById('compare').onchange()")


def zooms_and_pans(page):
    page.key("0")
    before = page.shot()
    page.key("+")
    until(lambda: page.shot() != before, "zoom")
    page.key("0")
    page.key("Escape")


def survives_a_reload_and_two_viewers(page, served, folder):
    page.call("Page.reload")
    lit(page, "#cells button div", .5, .8)
    second = Page(served.url + "?2d", folder)
    try:
        state(second, "done")
        a, b = lit(second, "#cells button div", .5, .8), lit(page, "#cells button div", .5, .8)
        expect(all(abs(x - y) <= 3 for x, y in zip(a, b)), f"the 2D canvas shows what WebGL does: {a} {b}")
        page.js("document.getElementById('more').value = 2, document.getElementById('add').click()")
        state(second, "iteration 5")
        expect(not second.problems, second.problems)
    finally:
        second.close()


def moves_the_camera(page, served):
    page.js("document.querySelector('#cells button').click()")
    page.key("c")
    text = until(lambda: page.js("document.getElementById('place').textContent").startswith("LookAt") and
                 page.js("document.getElementById('place').textContent"), "the camera's place")
    expect(text.startswith("LookAt 0 0 -4") and "Keyframe 1 LookAt" in text, text)
    box = page.js("(b => [b.x, b.y, b.width, b.height])(document.getElementById('large').getBoundingClientRect())")
    middle = (box[0] + box[2] / 2, box[1] + box[3] / 2)
    page.drag(middle, (middle[0] + 100, middle[1] + 40))
    moved = page.js("document.getElementById('place').textContent")
    numbers = [float(n) for n in moved.split()[1:7]]
    before = [float(n) for n in text.split()[1:7]]
    distance = lambda n: sum((a - b) ** 2 for a, b in zip(n[:3], n[3:])) ** .5
    expect(numbers[0] < -.5 and numbers[1] > .3 and numbers[3:] == before[3:], f"to the left and up: {moved}")
    expect(abs(distance(numbers) / distance(before) - 1) < 1e-3, f"around what it saw: {moved}")
    until(lambda: abs(page.js("fetch('run').then(r => r.json()).then(r => r.frames[0].eye[0])") - numbers[0]) < .01,
          "the camera is there")
    page.key("c")
    state(page, "done")
    page.js("document.getElementById('undo').click()")
    until(lambda: page.js("fetch('run').then(r => r.json()).then(r => r.frames[0].eye[0])") == 0, "the scene's camera")
    page.key("Escape")
    state(page, "done")


def edits(page, folder):
    scene = pathlib.Path(folder) / "tiny.dsc"
    before = lit(page, "#cells button div", .5, .8)
    scene.write_text(SCENE.replace('"rgb reflectance"', '"rgb reflektance"'))
    until(lambda: page.js("!document.getElementById('problem').hidden"), "the error is shown")
    text = page.js("document.getElementById('problem').textContent")
    expect(re.search(r"tiny.dsc:\d+:\d+: error", text) and "^" in text, text)
    page.shot("problem")
    expect(page.pixel("#cells button div", .5, .3) and max(page.pixel("#cells button div", .5, .2)) > 20, "the old picture stays")
    scene.write_text(SCENE.replace("[.7 .6 .5]", "[.1 .3 .7]"))
    until(lambda: page.js("document.getElementById('problem').hidden"), "the error goes")
    until(lambda: (p := page.pixel("#cells button div", .5, .8))[2] > p[0] + 20, f"the ground turns blue from {before}")
    state(page, "done")


def set_value(page, selector, value, event="input"):
    page.js(f"(e => {{ e.value = {str(value)!r}, e.dispatchEvent(new Event({event!r}, {{bubbles: true}})) }})"
            f"(document.querySelector({selector!r}))")


def place_of(page, x, y):
    """Where the pixel is in the large picture, which is 96 x 64, as shares of its element."""
    width, height = page.js("(b => [b.width, b.height])(document.getElementById('large').getBoundingClientRect())")
    zoom = min(width / 96, height / 64)
    return (.5 + (x + .5 - 48) * zoom / width, .5 + (y + .5 - 32) * zoom / height)


def png_pixels(page, file, places):
    data = base64.b64encode(file.read_bytes()).decode()
    return page.js(f"""(async () => {{ const i = new Image(); i.src = 'data:image/png;base64,{data}'; await i.decode();
        const c = document.createElement('canvas').getContext('2d'); c.drawImage(i, 0, 0);
        return {json.dumps(places)}.map(([x, y]) => [...c.getImageData(x, y, 1, 1).data].slice(0, 3)); }})()""")


def shows_what_pngs_show(page, folder):
    """The page starts with --view and --exposure, and its curves are those of the PNGs."""
    places = [(x, y) for x in (12, 47, 80) for y in (6, 30, 58)]
    names = page.js("[...document.getElementById('tone').options].slice(0, -1).map(o => o.text.split(',')[0])")
    chosen = page.js("[document.getElementById('tone').value, document.getElementById('exposure').value]")
    expect(chosen == [str(names.index("filmic")), "1"], f"it starts with the run's view: {names}, {chosen}")
    page.js("document.querySelector('#cells button').click()")
    lit(page, "#large", .5, .85)
    for number, name in enumerate(names):
        if name == "raw":  # viewers take its linear PNGs for what they are
            continue
        subprocess.run([dspm, "lit.dsc", "--quiet", "--frames", "1", "--png", "--view", name, "--exposure", "1",
                        "-o", f"{name}.####.exr"], cwd=folder, check=True)
        wanted = png_pixels(page, pathlib.Path(folder) / f"{name}.0001.png", places)
        set_value(page, "#tone", number, "change")
        near = lambda: all(abs(a - b) <= 3 for (x, y), rgb in zip(places, wanted)
                           for a, b in zip(page.pixel("#large", *place_of(page, x, y)), rgb))
        until(near, f"{name} shows what the PNG does: {wanted}")
    page.key("Escape")


def relights(page, served, folder):
    page.js("document.querySelector('#cells button').click()")
    expect(page.js("[...document.querySelectorAll('.light label')].map(l => l.firstChild.textContent.trim())") ==
           ["other", "fill", "key"], "a slider for each group")
    before = lit(page, "#large", *place_of(page, 47, 58))
    slider = "#sliders .light:nth-child(3) input[type=range]"
    set_value(page, slider, -8)
    until(lambda: max(page.pixel("#large", *place_of(page, 47, 58))) < max(before) - 20, "it is darker without the key")
    fill = page.pixel("#large", *place_of(page, 47, 58))
    expect(fill[2] > fill[0], f"what is left is the blue fill: {fill}")
    set_value(page, "#sliders .light:nth-child(2) input[type=color]", "#ff8000")
    until(lambda: page.pixel("#large", *place_of(page, 47, 58))[2] < 20, "the fill is orange now")
    page.shot("relit")
    text = page.js("document.getElementById('relit').textContent")
    expect(text.startswith("dspm --relight lit.000*.exr 'fill [1 0.216 0]' 'key 0' -o"), text)
    subprocess.run(text.replace("dspm", f"{dspm} --quiet", 1), shell=True, cwd=folder, check=True)
    expect((pathlib.Path(folder) / "relit.0003.exr").exists(), "the command that it shows mixes the files")
    page.js("document.getElementById('unlit').click()")
    until(lambda: page.pixel("#large", *place_of(page, 47, 58)) == before, "as in the scene")
    page.key("Escape")


def nothing_moves(page):
    shift = page.js("""new Promise(done => { let sum = 0; new PerformanceObserver(list => list.getEntries().forEach(
        e => { if (!e.hadRecentInput) sum += e.value; })).observe({type: 'layout-shift', buffered: true});
        setTimeout(() => done(sum), 500); })""")
    expect(shift < .02, f"the layout shifts by {shift}")


def main():
    with tempfile.TemporaryDirectory() as folder:
        (pathlib.Path(folder) / "tiny.dsc").write_text(SCENE)
        (pathlib.Path(folder) / "lit.dsc").write_text(LIT.replace("tiny.exr", "lit.exr"))
        served = Dspm(folder)
        page = None
        try:
            page = Page(served.url, folder)
            shows_scrubs_and_exposes(page)
            values_are_those_of_the_image(page)
            plays(page)
            wipes(page)
            zooms_and_pans(page)
            survives_a_reload_and_two_viewers(page, served, folder)
            moves_the_camera(page, served)
            edits(page, folder)
            nothing_moves(page)
            expect(not page.problems, page.problems)
            page.js("document.getElementById('stop').click()")
            until(lambda: served.process.poll() is not None, "it stops")
            expect(served.process.returncode == 0, served.log.read_text())
            served = Dspm(folder, "--aov", "lights", "--view", "filmic", "--exposure", "1", scene="lit.dsc")
            page.go(served.url)
            until(lambda: page.js("document.title").startswith("lit.dsc"), "the page of the other run", 60)
            page.problems = []  # the one that has ended does not answer
            state(page, "done")
            shows_what_pngs_show(page, folder)
            relights(page, served, folder)
            expect(not page.problems, page.problems)
        except AssertionError:
            if page:
                page.shot("failed")
                print(page.problems)
            print(served.log.read_text())
            raise
        finally:
            if page:
                page.close()
            served.end()
    print("the page works in", subprocess.run([chromium, "--version"], capture_output=True, text=True).stdout.strip())


if __name__ == "__main__":
    dspm, shots = os.path.abspath(sys.argv[1]), sys.argv[2] if len(sys.argv) > 2 else None
    main()
