"""Runs in Blender: its compositor sees in dspm's EXR files what dspm has written, whatever the compression, and its Cryptomatte node
picks what a decoder by the specification picks.
usage: blender -b --factory-startup --python compositor.py -- dspm folder"""
import json
import os
import struct
import subprocess
import sys

import bpy
import numpy as np

here = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(here, "../../tools/blender"))
from dspm_blender.exr import Exr

program, folder = sys.argv[sys.argv.index("--") + 1:][:2]
WIDTH, HEIGHT = 48, 32
# Names as people give them: beyond ASCII, with what JSON escapes, and with the commas by which Blender separates names. (Blender
# 3.4 loses backslashes.)
BALL, BOX, WALL = "ball", 'Würfel "2", grün', "壁"
SCENE = f"""
Integrator "path" "integer iterations" 4 "integer seed" 3
LookAt 0 0 -4  0 0 0  0 1 0
Camera "perspective" "float fov" 45
Film "rgb" "integer xresolution" {WIDTH} "integer yresolution" {HEIGHT} "string filename" "image.exr"
WorldBegin
  LightSource "point" "string group" "key" "point3 from" [2 2 -3] "rgb I" [9 8 7]
  LightSource "point" "point3 from" [-2 1 -3] "rgb I" [1 2 4]
  Material "diffuse" "rgb reflectance" [.7 .6 .5]
  Shape "sphere" "string name" "{BALL}" "float radius" 0.7
  Shape "disk" "string name" {json.dumps(WALL, ensure_ascii=False)} "float height" 2 "float radius" 1.5
  Translate .5 .3 -.6
  Shape "sphere" "string name" {json.dumps(BOX, ensure_ascii=False)} "float radius" 0.4
"""
OUTPUTS = "N,P,Z,albedo,cryptoobject,lights,alpha"
# Blender's socket, and dspm's channels in it.
SOCKETS = {"Combined": "RGB", "Depth": "Z", "N": ("N.X", "N.Y", "N.Z"), "P": ("P.X", "P.Y", "P.Z"),
           "Albedo": ("Albedo.R", "Albedo.G", "Albedo.B"), "CryptoObject00": ("CryptoObject00.r", "CryptoObject00.g", "CryptoObject00.b"),
           "light_key": ("light_key.R", "light_key.G", "light_key.B")}
# How a file is written, and whether colours lose nothing.
FORMATS = {"none": (["--compression", "none"], True), "zip tiles": (["--compression", "zip", "--tiles", "16"], True),
           "zips": (["--compression", "zips"], True), "rle": (["--compression", "rle"], True),
           "piz tiles": (["--compression", "piz", "--tiles", "16"], True), "dwaa": (["--compression", "dwaa"], False),
           "dwab tiles": (["--compression", "dwab", "--tiles", "16"], False)}
failures = []


def expect(holds, text):
    if not holds:
        failures.append(text)
        print("FAILED:", text)


def murmur3(data):
    """MurmurHash3_x86_32 with seed 0."""
    def turned(x, by):
        return (x << by | x >> 32 - by) & 0xffffffff

    def mixed(block):
        return turned(block * 0xcc9e2d51 & 0xffffffff, 15) * 0x1b873593 & 0xffffffff

    whole, hash = len(data) // 4 * 4, 0
    for block, in struct.iter_unpack("<I", data[:whole]):
        hash = turned(hash ^ mixed(block), 13) * 5 + 0xe6546b64 & 0xffffffff
    hash ^= mixed(int.from_bytes(data[whole:], "little")) ^ len(data)
    hash = (hash ^ hash >> 16) * 0x85ebca6b & 0xffffffff
    hash = (hash ^ hash >> 13) * 0xc2b2ae35 & 0xffffffff
    return hash ^ hash >> 16


def id_bits(name):
    """Of the float that stands for a name: neither tiny, nor infinite, nor NaN."""
    bits = murmur3(name.encode())
    return bits ^ 1 << 23 if bits >> 23 & 255 in (0, 255) else bits


def coverage(exr, name):
    """The specification's decoder: the shares of all ranks whose id is the name's."""
    total = np.zeros((exr.height, exr.width), np.float32)
    for layer in range(3):
        for id, share in ("rg", "ba"):
            ids = exr.channels[f"CryptoObject{layer:02}.{id}"]
            total += np.where(ids.view(np.uint32) == id_bits(name), exr.channels[f"CryptoObject{layer:02}.{share}"], 0)
    return total


def rendered(name, words):
    path = os.path.join(folder, name.replace(" ", "_") + ".exr")
    subprocess.run([program, "scene.dsc", "-o", path, "--quiet", "--aov", OUTPUTS, "--float", *words], check=True, cwd=folder)
    return path


def written_by(scene, tree, wanted):
    """What arrives at sockets, as Blender writes it, by their names."""
    writer = tree.nodes.new("CompositorNodeOutputFile")
    writer.base_path, writer.format.file_format = folder, "OPEN_EXR"
    writer.format.color_depth, writer.format.exr_codec = "32", "NONE"
    writer.file_slots.clear()
    for i, socket in enumerate(wanted.values()):
        writer.file_slots.new(f"socket{i}_")
        tree.links.new(socket, writer.inputs[i])
    tree.links.new(next(iter(wanted.values())), tree.nodes.new("CompositorNodeComposite").inputs[0])
    bpy.ops.render.render()
    tree.nodes.clear()
    return {name: Exr(os.path.join(folder, f"socket{i}_{scene.frame_current:04}.exr")).channels for i, name in enumerate(wanted)}


def compare_sockets(scene, tree, reference):
    wanted = {}
    for name, (words, _) in FORMATS.items():
        node = tree.nodes.new("CompositorNodeImage")
        node.image = bpy.data.images.load(rendered(name, words))
        for socket in SOCKETS:
            expect(socket in node.outputs, f"{name} has {socket} among {node.outputs.keys()}")
            wanted[name, socket] = node.outputs[socket]
    for (name, socket), seen in written_by(scene, tree, wanted).items():
        for theirs, own in zip("RGB", SOCKETS[socket]):
            apart = np.abs(seen[theirs] - reference.channels[own]).max() / np.abs(reference.channels[own]).max()
            lossy = not FORMATS[name][1] and own.split(".")[-1] in "RGBY"
            expect(apart <= (0.06 if lossy else 0), f"{name}: Blender's {socket}.{theirs} is off by {apart:.2g} of the largest")


def compare_mattes(scene, tree, path, reference):
    manifest = next(json.loads(text) for name, text in reference.texts.items() if name.endswith("/manifest"))
    wanted = {}
    for name in (BALL, BOX, WALL):
        expect(manifest.get(name) == f"{id_bits(name):08x}", f"the manifest has {name} as {id_bits(name):08x}: {manifest}")
        node = tree.nodes.new("CompositorNodeCryptomatteV2")
        node.source, node.image = "IMAGE", bpy.data.images.load(path, check_existing=True)
        node.layer_name = "CryptoObject"
        node.add = struct.unpack("<f", struct.pack("<I", id_bits(name))) + (0, 0)  # as if picked by mouse
        picked = [entry.name for entry in node.entries]
        expect(picked == [name], f"Blender finds {name} by its id, in the manifest, not {picked}")
        wanted[name] = node.outputs["Matte"]
    node = tree.nodes.new("CompositorNodeCryptomatteV2")
    node.source, node.image, node.layer_name, node.matte_id = "IMAGE", bpy.data.images.load(path, check_existing=True), "CryptoObject", BALL
    wanted["by name"] = node.outputs["Matte"]
    for name, seen in written_by(scene, tree, wanted).items():
        own = coverage(reference, BALL if name == "by name" else name)
        expect(0 < own.sum() < own.size and own.max() > 0.99, f"{name} shows")
        expect(((own > 0) & (own < 1)).any(), f"{name} has soft edges")
        expect(np.array_equal(seen["R"], own), f"the matte of {name} is the decoder's")
    everything = sum(coverage(reference, name) for name in (BALL, BOX, WALL))
    expect(np.abs(everything - reference.channels["A"]).max() < 1e-6, "all mattes add up to alpha")


def main():
    with open(os.path.join(folder, "scene.dsc"), "w", encoding="utf-8") as file:
        file.write(SCENE)
    expect(murmur3(b"") == 0 and murmur3(b"hello") == 0x248bfa47, "the hash is MurmurHash3")
    scene = bpy.context.scene
    scene.use_nodes, scene.render.resolution_x, scene.render.resolution_y, scene.render.resolution_percentage = True, WIDTH, HEIGHT, 100
    tree = scene.node_tree
    tree.nodes.clear()
    path = rendered("reference", ["--compression", "none"])
    reference = Exr(path)
    compare_sockets(scene, tree, reference)
    compare_mattes(scene, tree, path, reference)
    print(f"{len(SOCKETS)} sockets of {len(FORMATS)} formats, and mattes: {len(failures)} failures")
    sys.exit(1 if failures else 0)


main()
