"""What the tests here share: a small scene, programs that may be missing, pictures as arrays."""
import os, pathlib, shutil, struct, subprocess, sys, tempfile, zlib

try:
    import numpy as np
except ImportError:
    print("SKIPPED: needs the package python3-numpy")
    sys.exit(77)

SCENE = """
Frames 3 "float fps" 8
Integrator "dsppm" "integer iterations" 2 "integer photons" 2000 "integer seed" 5
LookAt 0 0 -4  0 0 0  0 1 0
Camera "perspective" "float fov" 45
Film "rgb" "integer xresolution" 48 "integer yresolution" 32 "string filename" "tiny.exr"
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
    Material "diffuse" "rgb reflectance" [.1 .3 .8]
    Keyframe 1  Translate -1 0 0
    Keyframe 3  Translate 1 0 0
    KeyframeEnd
    Shape "sphere" "float radius" 0.4
  DynamicEnd
"""

program = pathlib.Path(sys.argv[1]).resolve()


def is_there(command, package):
    """Whether a command of the package is there; says what is left out if it is not."""
    if shutil.which(command):
        return True
    print(f"SKIPPED: without {command} (package {package})")
    return False


class Checks:
    """A folder with the scene, and what was found wrong."""

    def __init__(self):
        self.failures, self.done = 0, 0
        self.temporary = tempfile.TemporaryDirectory()
        self.folder = pathlib.Path(self.temporary.name)
        (self.folder / "tiny.dsc").write_text(SCENE)

    def expect(self, holds, text):
        self.done += 1
        if not holds:
            self.failures += 1
            print("FAILED:", text)

    def run(self, *words, **more):
        """Output of a command in the folder; its failure is the test's."""
        run = subprocess.run([str(word) for word in words], cwd=self.folder, capture_output=True, **more)
        if run.returncode:
            raise RuntimeError(f"{words}: {run.returncode} {run.stdout.decode()} {run.stderr.decode()}")
        return run.stdout

    def dspm(self, *words):
        return self.run(program, "tiny.dsc", "--quiet", *words)

    def finish(self):
        """77 if no program was there to check anything with."""
        self.temporary.cleanup()
        print(f"{self.done} checks, {self.failures} failures")
        sys.exit(1 if self.failures else 0 if self.done else 77)


def png_chunks(data):
    at = 8
    while at < len(data):
        size, = struct.unpack_from(">I", data, at)
        yield data[at + 4:at + 8].decode(), data[at + 8:at + 8 + size]
        at += 12 + size


def read_png(data):
    """Rows of pixels, from the upper one, each of three or four numbers of 8 or 16 bits, or numbers of its palette."""
    chunks = list(png_chunks(data))
    width, height, bits, kind = struct.unpack(">IIBB", chunks[0][1][:10])
    channels = {2: 3, 3: 1, 6: 4}[kind]
    pixel = channels * bits // 8
    rows = np.frombuffer(zlib.decompress(b"".join(content for name, content in chunks if name == "IDAT")), np.uint8)
    rows = rows.reshape(height, 1 + width * pixel)
    image, above = [], np.zeros(width * pixel, int)
    for row in rows:
        above = unfiltered(row[0], row[1:].astype(int), above, pixel)
        image.append(above)
    image = np.array(image, np.uint8)
    if bits == 16:
        image = image.view(">u2")
    image = image.astype(int).reshape(height, width, channels)
    palette = next((content for name, content in chunks if name == "PLTE"), None)
    return np.frombuffer(palette, np.uint8).reshape(-1, 3).astype(int)[image[..., 0]] if kind == 3 else image


def unfiltered(kind, row, above, pixel):
    """[PNG specification, 9.2]"""
    if kind in (0, 2):
        return (row + (above if kind == 2 else 0)) & 255
    row = row.copy()
    for i in range(len(row)):
        left, corner = (row[i - pixel], above[i - pixel]) if i >= pixel else (0, 0)
        if kind == 4:
            guess = left + above[i] - corner
            apart = abs(guess - left), abs(guess - above[i]), abs(guess - corner)
            left = (left, above[i], corner)[apart.index(min(apart))]
        elif kind == 3:
            left = (left + above[i]) // 2
        row[i] = (row[i] + left) & 255
    return row
