"""All frames of an animation, or all variations of a product, rendered together.

    import dspm
    render = dspm.Render(dspm.load("scenes/demo.dsc"))
    render.iterate(16)
    image = render.image(0)        # numpy, (height, width, 3)

docs/python.md in dspm's sources shows how to write an integrator with Query.
"""

from ._dspm import (LightSamples, Parts, Query, Radiance, Rays, Render, Scattered, Scene, SceneError, Surfaces, UsageError,
                    __version__, add, load, set_threads)
from .ply import ply

__all__ = ["LightSamples", "Parts", "Query", "Radiance", "Rays", "Render", "Scattered", "Scene", "SceneError", "Surfaces",
           "UsageError", "__version__", "add", "load", "ply", "set_threads"]
