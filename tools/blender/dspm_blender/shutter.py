"""Blender's motion blur: when dspm's shutter is open, and the times between frames that show how things move meanwhile."""
from .versions import shutter_position

STEPS = 2**16  # a frame: dspm's times


class Shutter:
    """Its times are in frames of the file, which are `step` of Blender's apart, after the frame that they belong to."""

    def __init__(self, scene, step):
        length = scene.render.motion_blur_shutter / step if scene.render.use_motion_blur else 0
        before = {"START": 0, "CENTER": 0.5, "END": 1}[shutter_position(scene)] * length
        self.open, self.close = 0 - before, length - before

    def params(self):
        """Of the camera."""
        return {"float shutteropen": self.open, "float shutterclose": self.close} if self.close > self.open else {}

    def times(self, frames, around):
        """Those of the frames from 1 at which it opens, is half closed, and closes, but for whole frames of the file. With
        `around`, also a frame before the first and one after the last. Keys lie after frame 0."""
        found = {round((frame + after) * STEPS) for frame in range(1, frames + 1)
                 for after in (self.open, (self.open + self.close) / 2, self.close)}
        found |= {0, (frames + 1) * STEPS} if around else set()
        whole = {frame * STEPS for frame in range(1, frames + 1)}
        return [max(time, 1) / STEPS for time in sorted(found - whole)]


def lacks(scene):
    """What Blender's shutter has and dspm's has not."""
    render, cycles = scene.render, getattr(scene, "cycles", None)
    if render.use_motion_blur and getattr(cycles, "rolling_shutter_type", "NONE") != "NONE":
        yield "the rolling shutter opens and closes everywhere at once"
