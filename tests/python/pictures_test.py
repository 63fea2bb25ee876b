"""What programs take out of a render: images with less noise, bytes for screens, files; and which frame is which."""

import ast
import os
import pathlib
import struct
import subprocess
import sys
import tempfile
import unittest
import zlib

from surroundings import BUILD, need

need("numpy", "python3-numpy")

import dspm
import numpy as np

CHAIR = """
Frames 2
Integrator "path" "integer iterations" 3
Camera "perspective" "float fov" 45
Film "rgb" "integer xresolution" 20 "integer yresolution" 12 "string filename" "chair.exr"
WorldBegin
LightSource "infinite" "rgb L" [.6 .8 1.4]
MakeNamedMaterial "wood" "string type" "diffuse" "rgb reflectance" [.5 .5 .5]
AxisBegin "legs"
  VariationBegin "oak" VariationEnd
  VariationBegin "steel" MakeNamedMaterial "wood" "string type" "diffuse" "rgb reflectance" [.1 .1 .1] VariationEnd
AxisEnd
AxisBegin "top colour"
  VariationBegin "red" VariationEnd
  VariationBegin "blue" VariationEnd
  VariationBegin "green" VariationEnd
AxisEnd
NamedMaterial "wood"
Translate 0 0 4
Shape "sphere" "float radius" 1
"""


def read_png(path):
    """Eight bits for each of three channels [PNG, 9.2]."""
    data, at, packed = path.read_bytes(), 8, b""
    while at < len(data):
        size, kind = struct.unpack_from(">I4s", data, at)
        body, at = data[at + 8:at + 8 + size], at + 12 + size
        if kind == b"IHDR":
            width, height = struct.unpack_from(">II", body)
        packed += body if kind == b"IDAT" else b""
    rows = np.frombuffer(zlib.decompress(packed), np.uint8).reshape(height, 1 + 3 * width).astype(int)
    image = np.zeros((height + 1, width + 1, 3), int)
    for y, row in enumerate(rows):
        for x, pixel in enumerate(row[1:].reshape(width, 3)):
            left, up, corner = image[y + 1, x], image[y, x + 1], image[y, x]
            near = np.abs([up - corner, left - corner, left + up - 2 * corner])
            paeth = np.where((near[0] <= near[1]) & (near[0] <= near[2]), left, np.where(near[1] <= near[2], up, corner))
            image[y + 1, x + 1] = (pixel + [0, left, up, (left + up) // 2, paeth][row[0]]) % 256
    return image[1:, 1:].astype(np.uint8)


class Pictures(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        (self.folder / "chair.dsc").write_text(CHAIR)

    def rendered(self, **choices):
        render = dspm.Render(dspm.load(self.folder / "chair.dsc", **choices))
        render.iterate(3)
        return render

    def program(self, *words):
        subprocess.run([BUILD / "dspm", self.folder / "chair.dsc", "--quiet", *words], cwd=self.folder, check=True)

    def test_files_are_those_of_the_program(self):
        render = self.rendered(outputs=["Z"], denoise=True)
        self.program("-o", "theirs.exr", "--aov", "Z", "--denoise", "--png", "--view", "filmic", "--exposure", "1")
        written = render.write(self.folder / "ours.exr", png=True, view="filmic", exposure=1)
        self.assertEqual(len(written), len(render) * 3)
        for file in written:
            ours, theirs = file.read_bytes(), pathlib.Path(str(file).replace("ours", "theirs")).read_bytes()
            self.assertEqual(len(ours), len(theirs), file)
            differ = sum(a != b for a, b in zip(ours, theirs))
            self.assertLessEqual(differ, 8 if file.suffix == ".exr" else 0, f"{file}: only the header's seconds differ")

    def test_denoised_images_are_those_of_the_program(self):
        render = self.rendered(denoise=True)
        self.program("-o", "it.pfm", "--denoise")
        kind, size, _, data = (self.folder / "it.steel-blue.denoised.0002.pfm").read_bytes().split(b"\n", 3)
        theirs = np.frombuffer(data, "<f4").reshape(12, 20, 3)[::-1]
        frame, = dspm.load(self.folder / "chair.dsc").find(2, legs="steel", **{"top colour": "blue"})
        np.testing.assert_array_equal(render.image(frame, denoised=True), theirs)
        self.assertTrue((render.image(frame) != theirs).any())
        self.assertEqual(render.outputs, ["radiance"])
        with self.assertRaisesRegex(dspm.UsageError, "loaded without a denoiser"):
            self.rendered().image(denoised=True)
        with self.assertRaisesRegex(dspm.UsageError, "only radiance"):
            self.rendered(denoise=True, outputs=["Z"]).image(output="Z", denoised=True)

    def test_views_are_the_programs_pngs(self):
        render = self.rendered()
        for view in ("", "standard", "raw"):
            self.program("-o", "it.png", *(["--view", view] if view else []), "--exposure", "-1")
            ours = render.view(3, view=view, exposure=-1)
            np.testing.assert_array_equal(ours, read_png(self.folder / f"it.{render.labels[3].replace(' ', '.000')}.png"))
        raw = np.clip(render.image(0), 0, 1) * 255
        np.testing.assert_allclose(render.view(0, view="raw"), raw, atol=0.5001)
        with self.assertRaisesRegex(RuntimeError, 'there is no view "nice"'):
            render.view(view="nice")

    def test_some_frames_are_written(self):
        render = self.rendered()
        written = render.write(self.folder / "{legs}-{top colour}.{frame}.pfm", frames=[5, 0, 5])
        names = [str(each.relative_to(self.folder)) for each in written]
        self.assertEqual(names, ["oak-red.0001.pfm", "oak-green.0002.pfm"])
        self.assertEqual(sorted(str(each.relative_to(self.folder)) for each in self.folder.rglob("*.pfm")), sorted(names))
        sheet = self.folder / "sheet.png"
        render.write(self.folder / "some.pfm", frames=[1], contact_sheet=str(sheet))
        self.assertTrue(sheet.exists())
        with self.assertRaisesRegex(IndexError, "frame 12: there are 12"):
            render.write(self.folder / "x.pfm", frames=[12])
        with self.assertRaisesRegex(RuntimeError, "^cannot write .*nowhere.*: images are .exr, .png, .webp, .pfm or .hdr files$"):
            render.write(self.folder / "nowhere.jpg")

    def test_frames_are_found_by_what_they_show(self):
        scene = dspm.load(self.folder / "chair.dsc")
        self.assertEqual(scene.axes, {"legs": ["oak", "steel"], "top colour": ["red", "blue", "green"]})
        self.assertEqual(list(scene.axes), ["legs", "top colour"])
        self.assertEqual(len(scene.choices), 12)
        self.assertEqual(scene.find(), list(range(12)))
        for frame in scene.find(2, legs="steel"):
            self.assertEqual(scene.choices[frame]["legs"], "steel")
            self.assertEqual(scene.numbers[frame], 2)
        self.assertEqual(len(scene.find(2, legs="steel")), 3)
        with self.assertRaisesRegex(dspm.UsageError, 'axis "legs" has no "gold"'):
            scene.find(legs="gold")
        with self.assertRaisesRegex(dspm.UsageError, 'there is no axis "arms"'):
            scene.find(arms="oak")

    def test_there_is_no_image_before_the_first_iteration(self):
        render = dspm.Render(dspm.load(self.folder / "chair.dsc", denoise=True))
        for take in (render.image, render.alpha, render.view, lambda: render.image(denoised=True),
                     lambda: render.write(self.folder / "black.exr")):
            with self.assertRaisesRegex(RuntimeError, "no images before the first iteration"):
                take()
        self.assertFalse(list(self.folder.glob("black*")))

    def test_they_say_what_they_are(self):
        render = self.rendered()
        self.assertRegex(repr(render), r"<dspm.Render .*chair.dsc: 12 frames \(6 variations\) of 20 x 12 pixels, path, 3 of 3 iterations done>")
        query = dspm.Query(render_scene := dspm.load(self.folder / "chair.dsc"))
        rays, _ = query.camera_rays([[10, 6], [1, 1]], [[0, 0], [0, 0]])
        self.assertEqual((repr(query), repr(rays)), ("<dspm.Query of 12 frames>", "<dspm.Rays of 2 rows>"))
        parts = query.partition(rays)
        hits = query.surfaces(rays, parts)
        for each in (parts, hits, hits.sample([[.5, .5, .5]] * len(hits)), query.escaped(rays, parts)):
            self.assertRegex(repr(each), r"<dspm\.\w+ of \d+ rows>")
        self.assertIn("chair.dsc", repr(render_scene))

    def test_stubs_are_python_with_docstrings(self):
        package = BUILD / "python/dspm"
        tree = ast.parse((package / "_dspm.pyi").read_text())
        self.assertTrue((package / "py.typed").exists())
        top = {each.name: each for each in tree.body if isinstance(each, (ast.ClassDef, ast.FunctionDef))}
        self.assertEqual(set(top) | {"__version__", "ply"}, set(dspm.__all__))
        for name, each in top.items():
            self.assertTrue(ast.get_docstring(each), name)
            members = [member for member in each.body if isinstance(member, ast.FunctionDef)]
            there = {member for member in dir(getattr(dspm, name)) if not member.startswith("_")}
            if isinstance(each, ast.ClassDef) and "Error" not in name:
                self.assertEqual({member.name for member in members} - {"__init__", "__len__"}, there, name)
            for member in members:
                self.assertTrue(member.name.startswith("__") or ast.get_docstring(member), f"{name}.{member.name}")
        load = next(each for each in tree.body if getattr(each, "name", "") == "load")
        self.assertIn("denoise", [each.arg for each in load.args.kwonlyargs])
        self.assertEqual(ast.unparse(load.returns), "Scene")

    def test_python_finds_what_cmake_installs(self):
        """In the user's own folder, of another user."""
        home = self.folder / "home"
        environment = os.environ | {"HOME": str(home), "PYTHONPATH": ""}
        environment.pop("PYTHONNOUSERSITE", None)
        subprocess.run(["cmake", "--install", BUILD, "--prefix", home / ".local", "--component", "Unspecified"], check=True,
                       env=environment, capture_output=True)
        said = subprocess.run([sys.executable, "-c", "import dspm; print(dspm.__file__, dspm.load)"], cwd="/", env=environment,
                              capture_output=True, text=True)
        self.assertIn(str(home), said.stdout, said.stderr)
        said = subprocess.run([sys.executable, "-m", "dspm", "--version"], cwd="/", env=environment, capture_output=True, text=True)
        self.assertIn(dspm.__version__, said.stdout, said.stderr)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
