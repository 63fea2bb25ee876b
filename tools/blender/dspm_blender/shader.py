"""A shader as one material of dspm, before its textures are written."""
from dataclasses import dataclass, field, replace

from .fields import Field, is_one, is_zero, product

COLOURS = {"eta", "k", "basecolor", "reflectance", "transmittance", "specularcolor", "sheen", "emission", "tint", "mfp"}


@dataclass(frozen=True)
class Shader:
    kind: str
    fields: dict = field(default_factory=dict)  # parameters that may be textures
    plain: dict = field(default_factory=dict)   # "type name": value of the others
    alpha: Field = Field.of(1)
    emission: Field = Field.of(0)               # radiance

    def is_plain(self):
        """It neither emits nor has holes."""
        return is_one(self.alpha) and is_zero(self.emission)

    def shines_only(self):
        return self.kind == "black"

    def is_hole(self):
        return is_zero(self.alpha)

    def with_holes(self, alpha):
        return replace(self, alpha=product(self.alpha, alpha))

    def dimmed(self, share):
        """What it scatters, times a share; its emission stays."""
        return replace(self, fields={name: product(value, share) if name in {"basecolor", "reflectance", "specular", "coat"}
                                     else value for name, value in self.fields.items()})

    def principled(self):
        """The same as the material that can emit and have holes, or None."""
        if self.kind == "principled":
            return self
        if self.kind == "black":
            return replace(self, kind="principled", fields={"basecolor": Field.of(0), "specular": Field.of(0)})
        if self.kind == "diffuse":
            return replace(self, kind="principled", fields={
                "basecolor": self.fields["reflectance"], "specular": Field.of(0), "roughness": Field.of(1)})
        if self.kind == "dielectric":
            return replace(self, kind="principled", fields={"basecolor": Field.of(1), "transmission": Field.of(1)},
                           plain={name: value for name, value in self.plain.items() if "roughness" not in name} |
                                 {"float roughness": self.plain.get("float roughness", 0.0) ** 0.5})
        return None


def black(emission=Field.of(0)):
    return Shader("black", emission=emission)


def diffuse(reflectance):
    return Shader("diffuse", {"reflectance": reflectance})


HOLE = Shader("black", alpha=Field.of(0))
