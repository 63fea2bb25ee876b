"""Fields as parameters: a value, or a Texture with its picture in a file."""
import itertools
import os
import re

from .directive import Directive
from .fields import luminance
from .image_fields import encoding, file_of, write_png
from .write_pfm import write_pfm


def file_name(name):
    return re.sub(r"[^\w.-]", "_", name)


class Textures:
    """All textures of a scene."""

    def __init__(self, folder):
        self.folder, self.names, self.lines, self.taken = folder, {}, [], set()

    def colour(self, name, field, wanted):
        """{"rgb name" or "texture name": value}; `wanted` names the texture if there is one."""
        if field.is_constant():
            return {f"rgb {name}": [max(value, 0.0) for value in field.colour()]}
        return {f"texture {name}": self._texture("spectrum", field, wanted)}

    def number(self, name, field, wanted):
        if field.is_constant():
            return {f"float {name}": field.number()}
        return {f"texture {name}": self._texture("float", field, wanted)}

    def scaled(self, name, factor, wanted):
        """The name of a texture of numbers, times a factor."""
        scaled = self._new(wanted)
        self.lines.append(str(Directive("Texture", scaled, "float", "scale").with_params(
            {"texture tex": name, "float scale": factor})))
        return scaled

    def picture(self, field, wanted):
        """The file of a field's colours, relative to the scene, and its encoding."""
        found = file_of(field.image) if field.image and encoding(field.image) else None
        if found:
            return os.path.relpath(found, os.path.dirname(self.folder)), encoding(field.image)
        return self._written(field.values[..., :3], wanted), "linear"

    def _texture(self, kind, field, wanted):
        whose = field.of_vertices or ((field.image.name_full, field.place) if field.image else id(field))
        if (kind, whose) not in self.names:
            name = self._new(wanted)
            self.names[kind, whose] = (name, field)  # the field is kept, and so its id
            self.lines.append(str(self._directive(kind, field, name)))
        return self.names[kind, whose][0]

    def _directive(self, kind, field, wanted):
        if field.of_vertices:
            return self._of_vertices(kind, field, wanted)
        # dspm takes the alpha of a picture for a number, so numbers have a picture of their own.
        file, encoding = self.picture(field, wanted) if kind == "spectrum" else (
            self._written(luminance(field.values), wanted), "linear")
        place = field.place
        params = {"string filename": file, "string encoding": encoding, "string wrap": place.wrap, "string filter": place.filter}
        if place.uv_set != 1:
            params["integer uvset"] = place.uv_set
        names = ("uscale", "vscale", "udelta", "vdelta", "rotation")
        for name, value, default in zip(names, (*place.scale, *place.offset, place.rotation), (1, 1, 0, 0, 0)):
            if value != default:
                params[f"float {name}"] = value
        return Directive("Texture", wanted, kind, "imagemap").with_params(params)

    def _of_vertices(self, kind, field, wanted):
        channel = "alpha" if field.of_vertices == "Alpha" else "green"
        return Directive("Texture", wanted, kind, "vertexcolor").with_params({"string channel": channel} if kind == "float" else {})

    def _new(self, wanted):
        """A name for a texture or a file that is not taken."""
        names = itertools.chain([wanted], (f"{wanted}.{i}" for i in itertools.count(2)))
        name = next(each for each in names if each not in self.taken)
        self.taken.add(name)
        return name

    def _written(self, values, wanted):
        name = self._new(file_name(wanted))
        os.makedirs(self.folder, exist_ok=True)
        in_bytes = values.min() >= 0 and values.max() <= 1
        file, write = (f"{name}.png", write_png) if in_bytes else (f"{name}.pfm", write_pfm)
        write(os.path.join(self.folder, file), values)
        return f"{os.path.basename(self.folder)}/{file}"
