"""Blender's images as arrays, and files for the scene."""
import os
import struct
import tempfile
import zlib

import bpy
import numpy as np

from .fields import Field
from .versions import ENCODINGS

FLOATS = {"OPEN_EXR", "HDR"}  # formats of files that hold nothing else


def encoding(image):
    """That dspm has for the numbers of the image's file, or None: of another colour space."""
    return ENCODINGS.get(image.colorspace_settings.name)


def is_plain(image):
    """Files of floats are linear, others sRGB: so they are read where no encoding can be said."""
    return encoding(image) == ("linear" if image.file_format in FLOATS else "sRGB")


def is_missing(image):
    return image is None or image.size[0] == 0


def missing(image):
    return f"{f'{image.filepath} cannot be read' if image else 'it has no image'}; Blender's pink stands in"


def image_field(image, place):
    return Field(pixels(image), place, image)


def pixels(image):
    """Linear, from the lowest row. Blender itself decodes floats, but not bytes."""
    values = numbers_of(image)
    if not image.is_float and encoding(image) is None:
        return decoded_by_blender(values, image.colorspace_settings.name)
    if not image.is_float and encoding(image) == "sRGB":
        values[..., :3] = decoded(values[..., :3])
    return values


def numbers_of(image):
    width, height = image.size
    values = np.empty(width * height * 4, dtype=np.float32)
    image.pixels.foreach_get(values)
    return values.reshape(height, width, 4)


def decoded_by_blender(values, space):
    """By the colour management's own tables: as a file of floats in that colour space."""
    height, width = values.shape[:2]
    with tempfile.TemporaryDirectory(prefix="dspm-") as folder:
        raw = bpy.data.images.new("dspm", width, height, alpha=True, float_buffer=True, is_data=True)
        raw.pixels.foreach_set(values.ravel())
        raw.filepath_raw, raw.file_format = os.path.join(folder, "raw.exr"), "OPEN_EXR"
        raw.save()
        read = bpy.data.images.load(raw.filepath_raw)
        read.colorspace_settings.name = space
        result = numbers_of(read)
    for each in (raw, read):
        bpy.data.images.remove(each)
    return result


def decoded(values):
    """sRGB [IEC 61966-2-1]."""
    return np.where(values <= 0.04045, values / 12.92, ((values + 0.055) / 1.055) ** 2.4)


def file_of(image):
    """The absolute path of the image's file, or None if it is only in the .blend file or has been painted on."""
    path = bpy.path.abspath(image.filepath, library=image.library)
    on_disk = image.source == "FILE" and not image.packed_file and not image.is_dirty and os.path.isfile(path)
    return os.path.realpath(path) if on_disk else None


def write_png(path, values):
    """Linear colours, or numbers if there is no last axis, in 16 bits; row 0 is the lowest."""
    numbers = (np.clip(values, 0, 1)[::-1] * 65535 + 0.5).astype(">u2")
    height, width = numbers.shape[:2]
    rows = numbers.reshape(height, -1)
    scanlines = np.zeros((height, 1 + rows.shape[1] * 2), dtype=np.uint8)
    scanlines[:, 1:] = rows.view(np.uint8)
    header = struct.pack(">IIBBBBB", width, height, 16, 0 if numbers.ndim == 2 else 2, 0, 0, 0)
    with open(path, "wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n")
        for kind, data in ((b"IHDR", header), (b"IDAT", zlib.compress(scanlines, 1)), (b"IEND", b"")):
            file.write(struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data)))

