"""Blender's arithmetic on colours and numbers, for arrays."""
import numpy as np

BLENDS = {
    "MIX": lambda a, b: b,
    "ADD": lambda a, b: a + b,
    "SUBTRACT": lambda a, b: a - b,
    "MULTIPLY": lambda a, b: a * b,
    "SCREEN": lambda a, b: 1 - (1 - a) * (1 - b),
    "DIVIDE": lambda a, b: a / np.where(b == 0, 1, b),
    "DIFFERENCE": lambda a, b: np.abs(a - b),
    "DARKEN": np.minimum,
    "LIGHTEN": np.maximum,
    "OVERLAY": lambda a, b: np.where(a < 0.5, 2 * a * b, 1 - 2 * (1 - a) * (1 - b)),
}


def blended(kind, share, a, b, clamped):
    """Kinds that are not in the table mix."""
    result = a + share * (BLENDS.get(kind, BLENDS["MIX"])(a, b) - a)
    result = np.array(result, dtype=np.float32)
    result[..., 3] = np.broadcast_to(a[..., 3], result.shape[:-1])
    return np.clip(result, 0, 1) if clamped else result


OPERATIONS = {
    "ADD": lambda a, b, c: a + b,
    "SUBTRACT": lambda a, b, c: a - b,
    "MULTIPLY": lambda a, b, c: a * b,
    "DIVIDE": lambda a, b, c: a / np.where(b == 0, 1, b),
    "MULTIPLY_ADD": lambda a, b, c: a * b + c,
    "POWER": lambda a, b, c: np.maximum(a, 0) ** b,
    "SQRT": lambda a, b, c: np.sqrt(np.maximum(a, 0)),
    "ABSOLUTE": lambda a, b, c: np.abs(a),
    "MINIMUM": lambda a, b, c: np.minimum(a, b),
    "MAXIMUM": lambda a, b, c: np.maximum(a, b),
    "LESS_THAN": lambda a, b, c: (a < b) * 1.0,
    "GREATER_THAN": lambda a, b, c: (a > b) * 1.0,
    "SINE": lambda a, b, c: np.sin(a),
    "COSINE": lambda a, b, c: np.cos(a),
    "ROUND": lambda a, b, c: np.round(a),
    "FLOOR": lambda a, b, c: np.floor(a),
    "CEIL": lambda a, b, c: np.ceil(a),
    "FRACT": lambda a, b, c: a - np.floor(a),
    "MODULO": lambda a, b, c: np.fmod(a, np.where(b == 0, 1, b)),
}


def computed(operation, a, b, c):
    """None: not known."""
    return OPERATIONS[operation](a, b, c) if operation in OPERATIONS else None


def hue_shifted(colour, turn, saturation, strength):
    """By hue, saturation and value [Smith 1978]; `turn` is 0.5 for none."""
    rgb = colour[..., :3]
    high, low = rgb.max(axis=-1), rgb.min(axis=-1)
    span = high - low
    safe = np.where(span == 0, 1, span)
    red, green, blue = ((high - rgb[..., i]) / safe for i in range(3))
    hue = np.where(rgb[..., 0] == high, blue - green, np.where(rgb[..., 1] == high, 2 + red - blue, 4 + green - red)) / 6
    hue = (hue + turn - 0.5) % 1
    saturated = np.clip(np.where(high > 0, span / np.where(high > 0, high, 1), 0) * saturation, 0, 1)
    value = high * strength
    away = [np.clip(np.abs((hue * 6 + shift) % 6 - 3) - 1, 0, 1) for shift in (0, 4, 2)]
    rgb = [value * (1 - saturated * (1 - each)) for each in away]
    return np.stack([*rgb, np.broadcast_to(colour[..., 3], value.shape)], axis=-1)
