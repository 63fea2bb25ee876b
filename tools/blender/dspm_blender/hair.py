"""Hair over the frames: a file of strands whenever they are not what they were in the frame before."""
import os

from .blocks import dynamic, in_block, placed
from .directive import quoted
from .geometry import runs
from .mesh_arrays import digest
from .strands import curve_line


class Hair:
    """The strands of one object, of one material, in the object's space."""

    def __init__(self, stem, folder, name, material, block):
        self.stem, self.folder, self.name, self.material, self.block = stem, folder, name, material, block
        self.files, self.matrices, self.seen = {}, [], None

    def see(self, frame, matrix, strands):
        text = "\n".join(curve_line(*strand) for strand in strands)
        seen = digest(text.encode())
        if seen != self.seen:
            self.seen, self.current = seen, frame
            os.makedirs(self.folder, exist_ok=True)
            with open(os.path.join(self.folder, self._file(frame)), "w") as file:
                file.write(text + "\n")
        self.files[frame] = self.current
        self.matrices.append((frame, matrix))

    def lines(self, all_frames, between):
        return in_block(self.block, placed(self.name, self.matrices, all_frames, lambda frames: self._inside(frames, all_frames),
                                           len(set(self.files.values())) > 1, between))

    def _inside(self, frames, all_frames):
        lines = [f"NamedMaterial {quoted(self.material)}", f'Attribute "shape" "string name" {quoted(self.name)}']
        for first, last, same in runs([(frame, self.files[frame]) for frame in frames]):
            for begin, end in [(first, last)] if same else [(frame, frame) for frame in range(first, last + 1)]:
                include = f"Include {quoted(f'{os.path.basename(self.folder)}/{self._file(self.files[begin])}')}"
                whole = (begin, end) == (frames[0], frames[-1])
                lines += [include] if whole else dynamic(self.name, begin, end, all_frames, [include])
        return lines

    def _file(self, frame):
        return f"{self.stem}.{frame:04}.dsc"
