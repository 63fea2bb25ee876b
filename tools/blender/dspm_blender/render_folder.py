"""Where a render keeps its scene, its pictures and its checkpoint: beside the .blend file, so that a crash loses nothing."""
import json
import os
import shutil
import tempfile
import zlib

import bpy

from .textures import file_name


def own_name(layer):
    """No other view layer has it, though characters that files do not have are replaced."""
    name = file_name(layer)
    return name if name == layer else f"{name}-{zlib.crc32(layer.encode()):08x}"


class RenderFolder:
    """Of one view layer of some frames. It goes when the render is complete; what has not come that far stays to be resumed."""

    def __init__(self, settings, layer, frames):
        beside = os.path.dirname(bpy.data.filepath)
        self.frames, self.is_kept = frames, bool(settings.checkpoint and beside and os.access(beside, os.W_OK))
        if self.is_kept:
            which = f"{frames[0]:04}" if len(frames) == 1 else f"{frames[0]:04}-{frames[-1]:04}"
            self.path = os.path.join(f"{os.path.splitext(bpy.data.filepath)[0]}.dspm", f"{own_name(layer)}.{which}")
        else:
            self.path = tempfile.mkdtemp(prefix="dspm-")
        self.scene, self.checkpoint = (os.path.join(self.path, name) for name in ("scene.dsc", "checkpoint"))
        self.label = os.path.join(self.path, "frames.json")

    def holds_a_render(self):
        """Of these frames, and one that has come far enough to be resumed."""
        if not (os.path.exists(self.checkpoint) and os.path.exists(self.label)):
            return False
        with open(self.label, encoding="utf-8") as file:
            return json.load(file) == self.frames

    def begin(self):
        """Empty, but for its label."""
        if os.path.exists(self.label):
            shutil.rmtree(self.path)
        os.makedirs(self.path, exist_ok=True)
        with open(self.label, "w", encoding="utf-8") as file:
            json.dump(self.frames, file)

    def remove(self):
        shutil.rmtree(self.path, ignore_errors=True)
        try:
            if self.is_kept:
                os.rmdir(os.path.dirname(self.path))
        except OSError:
            pass  # other renders are there
