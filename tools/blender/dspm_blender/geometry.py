"""Meshes over the frames: a file whenever a mesh is not what it was in the frame before."""
import os
from itertools import groupby
from operator import itemgetter

from .blocks import dynamic
from .directive import Directive
from .mesh_arrays import MeshArrays
from .ply import write_ply


class Geometry:
    """One mesh, with a part for each of its material slots."""

    def __init__(self, name, folder):
        self.name, self.folder = name, folder
        self.seen = self.digest = self.connections = self.parts = None  # of the last frame
        self.files = {}    # material's slot -> {frame: the frame whose file it shows}
        self.written = []  # frames that have files

    def see(self, frame, mesh):
        if self.seen == frame:
            return
        arrays = MeshArrays(mesh)
        if arrays.digest != self.digest:
            self._write(arrays, frame)
        for slot in self.parts:
            self.files.setdefault(slot, {})[frame] = self.written[-1]
        self.seen, self.digest, self.connections = frame, arrays.digest, arrays.connections

    def _write(self, arrays, frame):
        if arrays.connections != self.connections or arrays.normals == "CORNER":
            self.parts = arrays.parts()
        for slot, (corners, triangles) in self.parts.items():
            write_ply(self._path(slot, f".{frame:04}"), triangles, **arrays.vertices(corners))
        self.written.append(frame)

    def finish(self):
        """A mesh that never changes has a name without a number."""
        if not self.deforms():
            for slot in self.files:
                os.replace(self._path(slot, f".{self.written[0]:04}"), self._path(slot, ""))

    def deforms(self):
        return len(self.written) > 1

    def shapes(self, name, slot, frames, all_frames, params, in_their_block):
        """The lines of a slot's shape in these frames, named `name`. Are they in a Dynamic block of these frames?"""
        files = self.files[slot]
        def shape(number):
            file = f"{os.path.basename(self.folder)}/{os.path.basename(self._path(slot, number))}"
            return str(Directive("Shape", "plymesh").with_params(
                {"string filename": file, "string name": name, **params}))
        if not self.deforms():
            return [shape("")]
        lines = []
        for first, last, same in runs([(frame, files[frame]) for frame in frames if frame in files]):
            line = shape(f".{files[first]:04}" if same else ".%04d")
            whole = in_their_block and (first, last) == (frames[0], frames[-1])
            lines += [line] if whole else dynamic(name, first, last, all_frames, [line])
        return lines

    def _path(self, slot, number):
        return os.path.join(self.folder, f"{self.name}{f'.{slot}' if slot else ''}{number}.ply")


def runs(files):
    """[first frame, last frame, is it one file?]: where a file stays, and where each frame has its own."""
    found = []
    for file, group in groupby(files, key=itemgetter(1)):
        frames = [frame for frame, _ in group]
        own = frames == [file]
        if own and found and not found[-1][2] and found[-1][1] == file - 1:
            found[-1][1] = file
        else:
            found.append([frames[0], frames[-1], not own])
    return found
