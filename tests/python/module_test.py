"""The Python module against the program, against itself frame by frame, and in rooms whose light is known."""

import pathlib
import subprocess
import sys
import tempfile
import unittest
import warnings

from surroundings import BUILD, SOURCE, need

need("numpy", "python3-numpy")

import dspm
import numpy as np

TINY = """
Frames 3 "float fps" 25
Default grey 0.5
Integrator "dsppm" "string indirect" "photons" "integer iterations" 2 "integer photons" 500 "integer seed" 5
LookAt 0 0 -4  0 0 0  0 1 0
Camera "perspective" "float fov" 45
Film "rgb" "integer xresolution" 24 "integer yresolution" 16 "string filename" "tiny.pfm"
WorldBegin
  AttributeBegin
    AreaLightSource "diffuse" "rgb L" [5 5 5]
    Translate 0 2 -1
    Shape "sphere" "float radius" 0.3
  AttributeEnd
  Material "diffuse" "rgb reflectance" [$grey .6 .5]
  AttributeBegin
    Translate 0 0 30
    Shape "sphere" "float radius" 29
  AttributeEnd
  DynamicBegin "ball"
    Keyframe 1  Translate -1 0 0
    Keyframe 3  Translate 1 0 0
    KeyframeEnd
    Material "conductor" "float roughness" 0.3
    Shape "sphere" "float radius" 0.4
  DynamicEnd
"""

# A camera inside a closed sphere that emits 1 and reflects a half: 1 + 1/2 + 1/4 + ... = 2 everywhere.
FURNACE = """
Integrator "path" "integer iterations" 1
Camera "perspective" "float fov" 60
Film "rgb" "integer xresolution" 20 "integer yresolution" 20
WorldBegin
  AreaLightSource "diffuse" "rgb L" [1 1 1]
  Material "diffuse" "rgb reflectance" [.5 .5 .5]
  ReverseOrientation
  Shape "sphere" "float radius" 2
"""


def read_pfm(path):
    kind, size, scale, data = path.read_bytes().split(b"\n", 3)
    width, height = map(int, size.split())
    assert kind == b"PF" and float(scale) < 0
    return np.frombuffer(data, "<f4").reshape(height, width, 3)[::-1]


def pixel_centres(query_scene):
    width, height = query_scene.size
    y, x = np.mgrid[0:height, 0:width]
    return np.stack([x.ravel(), y.ravel()], 1) + 0.5


def traced(scene, samples, depth, seed=1):
    """Path tracing with multiple importance sampling, as docs/python.md shows it."""
    query, centres, random = dspm.Query(scene), pixel_centres(scene), np.random.default_rng(seed)
    image = np.zeros((len(query), len(centres), 3))

    def balance(ours, other):
        return np.where(ours > 0, ours / np.maximum(ours + other, 1e-30), 1)[:, None]

    for _ in range(samples):
        rays, shade = query.camera_rays(centres + random.random(centres.shape) - 0.5, random.random(centres.shape))
        pixel, weight, pdf = rays.row, shade[:, None] * np.ones(3), np.zeros(len(rays))
        for _ in range(depth):
            parts = query.partition(rays)
            hits = query.surfaces(rays, parts)
            sky = query.escaped(rays, parts)
            dspm.add(image, pixel[sky.row], sky.frames,
                     weight[sky.row] * sky.radiance * balance(pdf[sky.row], sky.pdf_w))
            pixel, weight, pdf = pixel[hits.ray], weight[hits.ray], pdf[hits.ray]
            seen = hits.emitted()
            dspm.add(image, pixel[seen.row], seen.frames,
                     weight[seen.row] * seen.radiance * balance(pdf[seen.row], seen.pdf_w))
            lights = hits.sample_lights(random.random((len(hits), 3)))
            at, cosine = lights.rays.row, np.abs(np.sum(lights.wi * hits.ns[lights.rays.row], 1))[:, None]
            scattered = hits.evaluate(lights.wi, at) * cosine * balance(lights.pdf_w, hits.pdf_w(lights.wi, at))
            dspm.add(image, pixel[at], lights.rays.frames & ~query.occluded(lights.rays),
                     weight[at] * scattered * lights.weight)
            drawn = hits.sample(random.random((len(hits), 3)))
            rays = drawn.rays
            pixel, weight = pixel[rays.row], weight[rays.row] * drawn.weight
            pdf = np.where(drawn.specular, 0, drawn.pdf_w)
    width, height = scene.size
    return image.reshape(len(query), height, width, 3) / samples


class Module(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)

    def put(self, text, name="tiny.dsc"):
        path = pathlib.Path(self.folder.name) / name
        path.write_text(text)
        return path

    def images(self, scene, iterations=2):
        render = dspm.Render(scene)
        render.iterate(iterations)
        return np.stack([render.image(frame) for frame in range(len(scene))])

    def test_images_have_the_bits_of_the_program(self):
        scene = self.put(TINY)
        subprocess.run([BUILD / "dspm", scene.name, "--quiet"], cwd=scene.parent, check=True)
        ours = self.images(dspm.load(scene))
        for frame in range(3):
            np.testing.assert_array_equal(ours[frame], read_pfm(scene.parent / f"tiny.{frame + 1:04}.pfm"))

    def test_images_do_not_depend_on_threads(self):
        scene = dspm.load(self.put(TINY))
        dspm.set_threads(1)
        alone = self.images(scene)
        dspm.set_threads(5)
        np.testing.assert_array_equal(alone, self.images(scene))
        dspm.set_threads(0)

    def test_more_frames_than_fit_in_an_interval(self):
        scene = self.put(TINY.replace("Frames 3", "Frames 70").replace("Keyframe 3", "Keyframe 70"))
        render, alone = dspm.Render(dspm.load(scene)), dspm.Render(dspm.load(scene, frames=[70]))
        render.iterate()
        alone.iterate()
        self.assertEqual(render.labels[69], alone.labels[0])
        np.testing.assert_allclose(render.image(69), alone.image(0), rtol=1e-5)

    def test_parts_are_what_each_frame_meets_alone(self):
        scene = dspm.load(self.put(TINY))
        query, random = dspm.Query(scene), np.random.default_rng(3)
        rays = dspm.Rays(random.uniform(-1, 1, (500, 3)), random.normal(size=(500, 3)))
        parts = query.partition(rays)
        seen = np.zeros((3, 500), int)
        for frame in range(3):
            inside = (parts.frames >> np.uint64(frame) & np.uint64(1)).astype(bool)
            seen[frame, parts.ray[inside]] += 1
            alone = dspm.Query(scene, frames=[frame]).partition(rays)
            np.testing.assert_array_equal(alone.ray, parts.ray[inside])
            np.testing.assert_array_equal(alone.t, parts.t[inside])
            np.testing.assert_array_equal(alone.uv, parts.uv[inside])
        self.assertTrue((seen == 1).all())
        hidden = query.occluded(rays)
        for ray in range(500):
            of_ray = parts.ray == ray
            met = np.bitwise_or.reduce(parts.frames[of_ray & (parts.shape >= 0)], initial=np.uint64(0))
            self.assertEqual(hidden[ray], met)

    def test_paths_in_a_furnace(self):
        image = traced(dspm.load(self.put(FURNACE)), samples=16, depth=20)
        np.testing.assert_allclose(image.mean(), 2, rtol=0.01)
        np.testing.assert_allclose(image, 2, rtol=0.5)

    def test_paths_see_what_the_path_tracer_sees(self):
        ours = traced(dspm.load(self.put(TINY)), samples=256, depth=12)
        theirs = self.images(dspm.load(self.put(TINY), integrator="path", seed=9), 256)
        for frame in range(3):
            ratio = ours[frame].mean((0, 1)) / theirs[frame].mean((0, 1))
            np.testing.assert_allclose(ratio, 1, atol=0.03)
            blocks = [image[frame].reshape(4, 4, 6, 4, 3).mean((1, 3)) for image in (ours, theirs)]
            np.testing.assert_allclose(blocks[0], blocks[1], rtol=0.3)

    def test_the_integrator_of_the_page_is_ambient_occlusion(self):
        page = (SOURCE / "docs/python.md").read_text()
        names = {}
        exec(page.split("```python")[1].split("```")[0].replace("scenes/", f"{SOURCE}/scenes/"), names)
        text = (SOURCE / "scenes/demo.dsc").read_text()
        occluded = text.replace('Integrator "dsppm"', 'Integrator "ambientocclusion" "float maxdistance" 0.5 #')
        scene = dspm.load(self.put(occluded), resolution=0.25, iterations=16)
        for ours, theirs in zip(names["image"], self.images(scene, 16), strict=True):
            self.assertLess(theirs.mean(), 0.9)
            np.testing.assert_allclose(ours.mean(), theirs.mean(), rtol=0.01)
            blocks = [image.reshape(6, 10, 8, 10, 3).mean((1, 3)) for image in (ours, theirs)]
            np.testing.assert_allclose(*blocks, atol=0.08)

    def test_a_parameter_is_changed(self):
        grey = self.images(dspm.load(self.put(TINY)))
        dark = self.images(dspm.load(self.put(TINY), define={"grey": 0.1}))
        self.assertLess(dark[..., 0].mean(), 0.9 * grey[..., 0].mean())

    def test_a_scene_of_arrays(self):
        vertices = np.array([[-1, -1, 3], [1, -1, 3], [1, 1, 3], [-1, 1, 3]])
        whole = {"normals": np.tile([0, 0, -1], (4, 1)), "uv": vertices[:, :2], "colours": [[.8, .4, .2]] * 4}
        text = """Integrator "path" "integer iterations" 1
            Camera "perspective" "float fov" 30 Film "rgb" "integer xresolution" 8 "integer yresolution" 8
            WorldBegin LightSource "infinite" Texture "paint" "spectrum" "vertexcolor"
            Material "diffuse" "texture reflectance" "paint" Shape "plymesh" "string filename" "square.ply" """
        for faces in ([[0, 1, 2, 3]], [[0, 1, 2], [0, 2, 3]]):
            made = {"made.dsc": text, "square.ply": dspm.ply(vertices, faces, **whole)}
            self.assertFalse(pathlib.Path("made.dsc").exists())
            image = self.images(dspm.load("made.dsc", made=made), 64)[0]
            np.testing.assert_allclose(image.mean((0, 1)), [.8, .4, .2], rtol=0.02)
        with self.assertRaisesRegex(dspm.SceneError, "made.dsc"):  # it was there as long as its scene
            dspm.load("made.dsc")
        with self.assertRaisesRegex(dspm.SceneError, r"made\.dsc:4:.*"):
            dspm.load("made.dsc", made={"made.dsc": text})
        with self.assertRaisesRegex(ValueError, r"uv: expected an array of shape \(4, 2\), not \(4, 3\)"):
            dspm.ply(vertices, faces, uv=vertices)

    def test_a_render_goes_on_from_a_state(self):
        for integrator in ("dsppm", "vcm"):
            load = lambda **choices: dspm.load(self.put(TINY), integrator=integrator, outputs=["N"], **choices)
            render = dspm.Render(load())
            render.iterate(2)
            kept = render.state
            render.iterate(2)
            again = dspm.Render(load(), state=kept)
            self.assertEqual(again.iterations, 2)
            again.iterate(2)
            for output in render.outputs:
                np.testing.assert_array_equal(render.image(2, output), again.image(2, output))
            with self.assertRaisesRegex(dspm.UsageError, "state: it is of another scene, or of other choices"):
                dspm.Render(load(seed=8), state=kept)
            with self.assertRaisesRegex(RuntimeError, "it ends too early"):
                dspm.Render(load(), state=kept[:-1])
            with self.assertRaisesRegex(RuntimeError, "fewer bytes"):
                dspm.Render(load(), state=kept + b"x")

    def test_iterations_are_followed_and_stopped(self):
        render, seen = dspm.Render(dspm.load(self.put(TINY))), []
        render.iterate(5, each=lambda r: seen.append(r.iterations) or len(seen) < 3)
        self.assertEqual((seen, render.iterations, render.wanted), ([1, 2, 3], 3, 2))
        statistics = render.statistics
        self.assertEqual(statistics["photon paths"], 1500)
        self.assertGreaterEqual(statistics["photon segments"]["separate"], statistics["photon segments"]["done"])

    def test_outputs(self):
        render = dspm.Render(dspm.load(self.put(TINY), outputs=["Z"]))
        render.iterate()
        self.assertEqual(render.outputs, ["radiance", "Z"])
        middle = render.image(1, "Z")[6:10, 10:14, 0].min()  # the ball is in front of the camera then
        self.assertAlmostEqual(middle, 3.6, delta=0.02)
        with self.assertRaisesRegex(IndexError, '"N" is none of the outputs'):
            render.image(0, "N")
        with self.assertRaisesRegex(IndexError, "frame 3: there are 3"):
            render.image(3)

    def test_arrays_are_the_memory_of_rays(self):
        rays = dspm.Rays(np.zeros((2, 3)), [[0, 0, 2], [0, 3, 0]])
        np.testing.assert_array_equal(rays.direction, [[0, 0, 1], [0, 1, 0]])
        rays.origin[1] = 7
        np.testing.assert_array_equal(rays.origin[1], [7, 7, 7])
        self.assertIs(rays.origin.base, rays)

    def test_mistakes_have_the_words_of_the_program(self):
        with self.assertRaisesRegex(dspm.SceneError, r'bad\.dsc:3:\d+: .*"spheer"'):
            dspm.load(self.put('WorldBegin\n\nShape "spheer"\n', "bad.dsc"))
        with self.assertRaisesRegex(dspm.UsageError, "there is no frame 9"):
            dspm.load(self.put(TINY), frames=[9])
        with self.assertRaisesRegex(ValueError, r"direction: expected an array of shape \(2, 3\)"):
            dspm.Rays(np.zeros((2, 3)), np.zeros((3, 3)))
        with self.assertRaisesRegex(IndexError, "row: 5 is none"):
            dspm.add(np.zeros((1, 2, 3)), [5], [1], [[1, 1, 1]])
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            dspm.load(self.put(TINY.replace('"float fov"', '"float fov@9" 40 "float fov@1"')))
        self.assertIn("fov@9", str(caught[0].message))

    def test_the_program_runs(self):
        said = subprocess.run([sys.executable, "-m", "dspm", "--version"], cwd=BUILD / "python", check=True,
                              capture_output=True, text=True).stdout
        self.assertIn(dspm.__version__, said)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
