"""What a socket gives: a colour or number, the same everywhere or over a picture."""
from dataclasses import dataclass, replace
from typing import Any

import numpy as np


@dataclass(frozen=True)
class Place:
    """How a picture lies on texture coordinates: those times `scale`, turned, plus `offset`; what is outside of 0..1."""
    scale: tuple = (1.0, 1.0)
    offset: tuple = (0.0, 0.0)
    rotation: float = 0.0  # in degrees, from u towards v
    wrap: str = "repeat"
    filter: str = "bilinear"
    uv_set: int = 1


@dataclass(frozen=True, eq=False)
class Field:
    """Linear red, green, blue and alpha in the last axis; with a picture, rows from below and columns before it."""
    values: np.ndarray
    place: Place | None = None
    image: Any = None  # whose colours these are, unchanged
    of_vertices: str = ""  # they are what the vertices have instead, their colour or alpha; `values` stand in

    @staticmethod
    def of(*numbers):
        """A number is grey."""
        rgb = numbers * 3 if len(numbers) == 1 else numbers[:3]
        return Field(np.array([*rgb, numbers[3] if len(numbers) == 4 else 1.0], dtype=np.float32))

    def is_constant(self):
        return self.values.ndim == 1

    def colour(self):
        return [float(value) for value in self.values[:3]]

    def number(self):
        return float(luminance(self.values[:3])) if self.is_constant() else float(luminance(self.values).mean())

    def mean(self):
        return self if self.is_constant() else Field(self.values.reshape(-1, 4).mean(axis=0))

    def with_values(self, values):
        return replace(self, values=values, image=None, of_vertices="")


def luminance(rgb):
    """As Blender makes numbers of colours."""
    return rgb[..., 0] * 0.2126 + rgb[..., 1] * 0.7152 + rgb[..., 2] * 0.0722


def grey(numbers):
    return np.stack([numbers] * 3 + [np.ones_like(numbers)], axis=-1).astype(np.float32)


def together(fields, notes=None, whose=""):
    """Their values on one grid, and the field whose place that is."""
    pictures = [field for field in fields if not field.is_constant()]
    if not pictures:
        return [field.values for field in fields], Field.of(0)
    leader = max(pictures, key=lambda field: field.values.size)
    if notes and any(field.place != leader.place for field in pictures):
        notes.add(f"{whose}: it joins pictures that lie differently; both lie as one of them")
    return [field.values if field.is_constant() else resampled(field.values, leader.values.shape[:2])
            for field in fields], leader


def product(*fields):
    """One field unchanged, if the others are one."""
    factors = [field for field in fields if not is_one(field)]
    if len(factors) < 2:
        return factors[0] if factors else fields[0]
    values, leader = together(factors)
    result = values[0]
    for each in values[1:]:
        result = result * each
    return leader.with_values(result)


def total(a, b):
    values, leader = together([a, b])
    return b if is_zero(a) else leader.with_values(values[0] + values[1])


def complement(field):
    return field.with_values(1 - field.values)


def is_one(field):
    return field.is_constant() and bool((field.values[:3] == 1).all())


def is_zero(field):
    return field.is_constant() and not field.values[:3].any()


def resampled(values, size):
    """The nearest pixels."""
    rows, columns = (np.arange(new) * old // new for new, old in zip(size, values.shape[:2]))
    return values if values.shape[:2] == size else values[rows][:, columns]
