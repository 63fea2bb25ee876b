"""EXR files as dspm writes them with --compression none: rows of floats or halves, any channels."""
import struct

import numpy as np

KINDS = {0: "<u4", 1: "<f2", 2: "<f4"}


class Exr:
    """`channels[name]` has rows from the lowest, as Blender's pictures do; `texts` are the header's strings."""

    def __init__(self, path):
        with open(path, "rb") as file:
            self.data = file.read()
        attributes, at = self._attributes(8)
        self.texts = {name: value.decode(errors="replace") for name, (kind, value) in attributes.items() if kind == "string"}
        x0, y0, x1, y1 = struct.unpack("<4i", attributes["dataWindow"][1])
        self.width, self.height = x1 - x0 + 1, y1 - y0 + 1
        if attributes["compression"][1] != b"\0":
            raise RuntimeError(f"{path} is compressed")
        self.channels = self._channels(self._kinds(attributes["channels"][1]), at)

    def _attributes(self, at):
        found = {}
        while self.data[at]:
            name, at = self._word(self.data, at)
            kind, at = self._word(self.data, at)
            size, = struct.unpack_from("<i", self.data, at)
            found[name] = (kind, self.data[at + 4:at + 4 + size])
            at += 4 + size
        return found, at + 1

    def _kinds(self, data):
        at, kinds = 0, []
        while data[at]:
            name, at = self._word(data, at)
            kinds.append((name, KINDS[struct.unpack_from("<i", data, at)[0]]))
            at += 16
        return kinds

    def _channels(self, kinds, at):
        """After a table of offsets come rows, each of its number, its size, and one channel after the other."""
        row = np.dtype([("y", "<i4"), ("size", "<i4"), *((name, kind, self.width) for name, kind in kinds)])
        rows = np.frombuffer(self.data, row, self.height, at + 8 * self.height)
        return {name: rows[name][::-1].astype(np.float32) for name, _ in kinds}

    @staticmethod
    def _word(data, at):
        end = data.index(b"\0", at)
        return data[at:end].decode(), end + 1
