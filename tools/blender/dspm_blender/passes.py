"""Blender's passes and the outputs of dspm that they are."""
from dataclasses import dataclass

import numpy as np

from .light_groups import group_name


@dataclass(frozen=True)
class Pass:
    name: str       # Blender's
    letters: str    # one for each of its channels
    kind: str       # of its socket
    output: str     # dspm's --aov; empty: radiance as it is before it is denoised
    channels: tuple  # "-" before a name: with the other sign


def passes(layer, denoise):
    """Those that a view layer asks for, besides Combined."""
    if denoise:
        yield Pass("Noisy Image", "RGBA", "COLOR", "", ())  # as Cycles calls what Combined would be
    if layer.use_pass_z:
        yield Pass("Depth", "Z", "VALUE", "Z", ("Z",))
    if layer.use_pass_normal:
        yield Pass("Normal", "XYZ", "VECTOR", "N", ("N.X", "N.Y", "N.Z"))
    if layer.use_pass_position:
        yield Pass("Position", "XYZ", "VECTOR", "P", ("P.X", "P.Y", "P.Z"))
    if layer.use_pass_uv:
        yield Pass("UV", "UVA", "VECTOR", "uv", ("u", "v"))
    if layer.use_pass_vector:  # as Cycles has it: to where it was, and from where it will be
        yield Pass("Vector", "XYZW", "VECTOR", "motion", ("backward.u", "backward.v", "-forward.u", "-forward.v"))
    if layer.dspm.albedo:
        yield Pass("Albedo", "RGB", "COLOR", "albedo", ("Albedo.R", "Albedo.G", "Albedo.B"))
    if layer.dspm.variance:
        yield Pass("Variance", "RGB", "COLOR", "variance", ("variance.R", "variance.G", "variance.B"))
    if layer.dspm.denoising_data:
        yield Pass("Denoising Normal", "XYZ", "VECTOR", "denoisingN", tuple(f"DenoisingN.{letter}" for letter in "XYZ"))
        yield Pass("Denoising Albedo", "RGB", "COLOR", "denoisingalbedo", tuple(f"DenoisingAlbedo.{letter}" for letter in "RGB"))
        yield Pass("Denoising Depth", "Z", "VALUE", "denoisingZ", ("DenoisingZ.Z",))
    for wanted, output, name in ((layer.use_pass_cryptomatte_object, "cryptoobject", "CryptoObject"),
                                 (layer.use_pass_cryptomatte_material, "cryptomaterial", "CryptoMaterial")):
        for i in range(3 if wanted else 0):
            yield Pass(f"{name}{i:02}", "RGBA", "COLOR", output, tuple(f"{name}{i:02}.{letter}" for letter in "rgba"))
    for group in layer.lightgroups:
        channels = tuple(f"light_{group_name(group.name)}.{letter}" for letter in "RGB")
        yield Pass(f"Combined_{group.name}", "RGB", "COLOR", "lights", channels)


COVERED = {"use_pass_combined", "use_pass_z", "use_pass_normal", "use_pass_position", "use_pass_uv", "use_pass_vector",
           "use_pass_cryptomatte_object", "use_pass_cryptomatte_material", "use_pass_cryptomatte_accurate"}


def lacking(layer):
    """Names of the passes that a view layer asks for in vain."""
    for owner in (layer, getattr(layer, "cycles", None), getattr(layer, "eevee", None)):
        for each in owner.bl_rna.properties if owner else ():
            if each.identifier.startswith("use_pass_") and each.identifier not in COVERED and getattr(owner, each.identifier):
                yield each.name
    yield from (each.name for each in layer.aovs)


def picture(exr, channels, width):
    """Rows of pixels, `width` numbers in each; what the file does not have is 0."""
    nothing = np.zeros((exr.height, exr.width), dtype=np.float32)
    columns = [-exr.channels.get(name[1:], nothing) if name[0] == "-" else exr.channels.get(name, nothing) for name in channels]
    return np.dstack(columns + [nothing] * (width - len(columns))).reshape(-1, width)


def combined(exr):
    alpha = exr.channels.get("A", np.ones((exr.height, exr.width), dtype=np.float32))
    return np.dstack([*(exr.channels[name] for name in "RGB"), alpha]).reshape(-1, 4)
