"""What a scene says about dspm."""
import os

import bpy

from .directive import Directive

INTEGRATORS = [
    ("dsppm", "dsppm", "Photons that all frames share; caustics. The default"),
    ("path", "path", "Path tracing: no caustics of point lights"),
    ("vcm", "vcm", "Vertex connection and merging"),
    ("sppm", "sppm", "Photons, frame by frame"),
]


class DspmSettings(bpy.types.PropertyGroup):
    integrator: bpy.props.EnumProperty(name="Integrator", items=INTEGRATORS, default="dsppm")
    iterations: bpy.props.IntProperty(name="Iterations", default=64, min=1, description="Paths per pixel")
    photons: bpy.props.IntProperty(
        name="Photons", default=100000, min=1, description="Photon paths per iteration, for all frames together")
    max_depth: bpy.props.IntProperty(name="Bounces", default=8, min=1)
    until_error: bpy.props.FloatProperty(
        name="Until Error", default=0, min=0, max=100, subtype="PERCENTAGE",
        description="Ends when half of every frame's pixels are estimated to be this good; 0: after the iterations")
    time_limit: bpy.props.IntProperty(name="Time Limit", default=0, min=0, description="Minutes for all frames; 0: none")
    seed: bpy.props.IntProperty(name="Seed", default=0, min=0)

    denoise: bpy.props.BoolProperty(
        name="Denoise", description="Combined gets less noise; the pass Noisy Image has what it was")
    checkpoint: bpy.props.BoolProperty(
        name="Checkpoint", default=True,
        description="Keeps the state and the pictures so far in a folder beside the .blend file, until the render is complete")
    resume: bpy.props.BoolProperty(
        name="Resume", description="Goes on with the render of these frames that the folder has, of the scene as it was then, "
                                   "and keeps it when it is complete")
    guide: bpy.props.StringProperty(
        name="Guide", subtype="FILE_PATH",
        description="Where photons start: learned and written if there is no such file, else read. Empty: learned each time")

    bake_size: bpy.props.IntProperty(
        name="Baked Size", default=1024, min=16, max=16384, description="Pixels of a picture of a procedural texture, each way")

    def integrator_directive(self):
        directive = Directive("Integrator", self.integrator).with_params(
            {"integer iterations": self.iterations, "integer maxdepth": self.max_depth})
        if self.integrator in {"dsppm", "sppm"}:
            directive.params["integer photons"] = self.photons
        if self.seed:
            directive.params["integer seed"] = self.seed
        return directive

    def arguments(self, resumes):
        """Of the program, when Blender runs it. A render that is resumed has learned its guide."""
        words = ["--iterations", str(self.iterations)]
        words += ["--until-error", f"{self.until_error:g}%"] if self.until_error else []
        words += ["--time-limit", f"{self.time_limit}m"] if self.time_limit else []
        words += ["--denoise"] if self.denoise else []
        if self.guide and self.uses_guide() and not resumes:
            path = bpy.path.abspath(self.guide)
            words += ["--guide" if os.path.exists(path) else "--save-guide", path]
        return words

    def uses_guide(self):
        return self.integrator in {"dsppm", "sppm", "vcm"}


class DspmLayerSettings(bpy.types.PropertyGroup):
    """Passes that Blender has no switch for."""
    albedo: bpy.props.BoolProperty(name="Albedo", description="The share of light that surfaces scatter")
    variance: bpy.props.BoolProperty(name="Variance", description="Of the noise that is left in each pixel, as estimated")
    denoising_data: bpy.props.BoolProperty(
        name="Denoising Data", description="Normal, albedo and depth of the first rough surface, for other denoisers")


def register():
    bpy.utils.register_class(DspmSettings)
    bpy.utils.register_class(DspmLayerSettings)
    bpy.types.Scene.dspm = bpy.props.PointerProperty(type=DspmSettings)
    bpy.types.ViewLayer.dspm = bpy.props.PointerProperty(type=DspmLayerSettings)


def unregister():
    del bpy.types.ViewLayer.dspm, bpy.types.Scene.dspm
    bpy.utils.unregister_class(DspmLayerSettings)
    bpy.utils.unregister_class(DspmSettings)
