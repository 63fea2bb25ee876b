"""Bodies that scatter light inside, as Cycles' random walk has them."""
import numpy as np

from .fields import Field, is_zero, product, together
from .shader import Shader, diffuse
from .versions import extent_depends_on_colour

SHORTEST = 1e-5  # of mean free paths


def body(node, colour, radius, anisotropy, ior, eta, roughness):
    """`colour` is what a thick body reflects, `radius` says by channel how far light comes; `eta` and `roughness` are the surface's."""
    if is_zero(radius):
        return diffuse(colour)
    factor = Field.of(1 / (4 * np.pi))
    if extent_depends_on_colour(node):
        values = np.sqrt(3 * (1 - scattered_share(np.clip(colour.values, 0, 1), ior)))
        factor = colour.with_values(values)
    (lengths, scale), leader = together([radius, factor])
    mfp = leader.with_values(np.maximum(lengths * scale * (1 - anisotropy), SHORTEST))
    return Shader("subsurface", {"reflectance": colour, "mfp": mfp, "roughness": product(roughness, roughness)},
                  {"float g": anisotropy, "float eta": eta, "bool remaproughness": False})


def scattered_share(reflectance, eta):
    """The reduced albedo of a medium whose thick body reflects this [Jensen et al. 2001, (15), with its Fdr]."""
    fdr = -1.44 / eta**2 + 0.71 / eta + 0.668 + 0.0636 * eta
    four_thirds_a = 4 / 3 * (1 + fdr) / (1 - fdr)
    low, high = np.zeros_like(reflectance), np.ones_like(reflectance)
    for _ in range(24):
        middle = (low + high) / 2
        root = np.sqrt(3 * (1 - middle))
        is_less = middle / 2 * (1 + np.exp(-four_thirds_a * root)) * np.exp(-root) < reflectance
        low, high = np.where(is_less, middle, low), np.where(is_less, high, middle)
    return (low + high) / 2
