#!/usr/bin/env python3
"""What exrinfo, ffmpeg, apngdis, WebP's tools, pngcheck and exiftool read in files of dspm. Exit code 77: none of them is there.
usage: files.py dspm"""
import json, pathlib, subprocess, sys

sys.path.insert(0, str(pathlib.Path(__file__).parents[2] / "tools/blender/dspm_blender"))
from support import Checks, is_there, np, read_png
from exr import Exr  # after support, which says what is missing

FRAMES, RATE, WIDTH, HEIGHT, MARGIN = 3, 8, 48, 32, 8
EXR_FORMATS = [["--compression", "none", "--float"], ["--compression", "zips"], ["--compression", "rle", "--float"],
               ["--compression", "zip", "--tiles", "16"], ["--compression", "piz", "--float", "--tiles", "16"]]
# dspm's channels in ffmpeg's order, by ffmpeg's layers.
EXR_LAYERS = {"": "GBR", "Albedo": ("Albedo.G", "Albedo.B", "Albedo.R"), "N": ("N.Y", "N.Z", "N.X")}


def frame_of(checks, number):
    return read_png((checks.folder / f"tiny.{number:04}.png").read_bytes())


def in_sheet(picture):
    """The frame in one picture of a sheet that moves, which has a margin around it."""
    return picture[MARGIN:MARGIN + HEIGHT, MARGIN:MARGIN + WIDTH, :3]


def check_streams(checks):
    """The rate, and as many pictures as there are frames."""
    for name in ("page.apng", "page.mp4"):
        text = checks.run("ffprobe", "-v", "error", "-count_frames", "-show_streams", "-of", "json", name)
        stream = json.loads(text)["streams"][0]
        checks.expect((stream["r_frame_rate"], stream["nb_read_frames"]) == (f"{RATE}/1", str(FRAMES)), f"{name} is a stream of {stream}")
    checks.expect([stream[key] for key in ("color_space", "color_primaries", "color_transfer", "color_range", "pix_fmt")]
                  == ["bt709", "bt709", "iec61966-2-1", "tv", "yuv420p"], f"the video says its colours: {stream}")
    for i in range(FRAMES):
        seen = checks.run("ffmpeg", "-v", "error", "-i", "page.mp4", "-vf", f"select=eq(n\\,{i})", "-frames:v", "1", "-c:v", "png", "-f", "image2pipe", "-")
        checks.expect(np.abs(read_png(seen) - frame_of(checks, i + 1)).mean() < 5, f"ffmpeg sees frame {i + 1} in the video")


def check_apng(checks):
    checks.run("apngdis", "page.apng", "part")
    parts = sorted(checks.folder.glob("part*.png"))
    checks.expect(len(parts) == FRAMES, f"apngdis finds {parts}")
    for i, part in enumerate(parts):
        checks.expect(np.array_equal(in_sheet(read_png(part.read_bytes())), frame_of(checks, i + 1)), f"picture {i + 1} of the APNG is the frame")


def check_webp(checks):
    info = checks.run("webpmux", "-info", "page.webp").decode()
    rows = [line.split() for line in info.splitlines() if line.strip()[:1].isdigit()]
    checks.expect([row[6] for row in rows] == [str(1000 // RATE)] * FRAMES and "Loop Count : 0" in info, f"the WebP moves at its rate: {info}")
    checks.run("webpmux", "-get", "frame", "1", "page.webp", "-o", "first.webp")
    seen = in_sheet(read_png(checks.run("dwebp", "-quiet", "first.webp", "-o", "-")))
    checks.expect(np.abs(seen - frame_of(checks, 1)).mean() < 5, "the first picture of the WebP is the frame")


def check_png(checks):
    """pngcheck 3.0.3 is older than the chunk cICP."""
    checks.run("pngcheck", "-q", "tiny.0001.png")
    run = subprocess.run(["pngcheck", "-v", "p3.0001.png"], cwd=checks.folder, capture_output=True, text=True)
    faults = [line for line in run.stdout.splitlines() if any(word in line.lower() for word in ("illegal", "invalid", "must", "error:"))]
    checks.expect(all("cICP" in line for line in faults) and "48-bit RGB" in run.stdout, f"pngcheck finds nothing: {run.stdout}")


def check_colours(checks):
    found = json.loads(checks.run("exiftool", "-json", "-n", "p3.0001.png"))[0]
    wanted = {"BitDepth": 16, "ProfileDescription": "Display P3", "ColorPrimaries": 12, "TransferCharacteristics": 13, "MatrixCoefficients": 0,
              "VideoFullRangeFlag": 1, "RedX": 0.68, "RedY": 0.32, "GreenX": 0.265, "GreenY": 0.69, "BlueX": 0.15, "BlueY": 0.06}
    checks.expect({key: found.get(key) for key in wanted} == wanted, f"exiftool reads Display P3 in {found}")


def check_exr(checks):
    reference = None
    for i, words in enumerate(EXR_FORMATS):
        checks.dspm("--frames", "2", "--aov", "N,albedo", "-o", f"{i}.####.exr", *words)
        reference = reference or Exr(checks.folder / "0.0002.exr")
        for layer, channels in EXR_LAYERS.items():
            seen = np.frombuffer(checks.run("ffmpeg", "-v", "error", *(["-layer", layer] if layer else []), "-i", f"{i}.0002.exr",
                                            "-f", "rawvideo", "-pix_fmt", "gbrpf32le", "-"), "<f4")
            own = np.stack([reference.channels[name][::-1] for name in channels]).ravel()
            apart = 0 if "--float" in words else 2 ** -11 * np.abs(own)
            checks.expect((np.abs(seen - own) <= apart).all(), f"ffmpeg reads layer {layer or 'RGB'} of {words}")


def check_headers(checks):
    """No attribute has a name or a type that OpenEXR keeps for something else."""
    checks.dspm("--frames", "2", "--aov", "N,Z,object,cryptoobject,lights", "-o", "all.####.exr")
    run = subprocess.run(["exrinfo", "--strict", "all.0002.exr"], cwd=checks.folder, capture_output=True, text=True)
    checks.expect(run.returncode == 0, f"OpenEXR's strict reader takes the header: {run.stdout} {run.stderr}")


def main():
    checks = Checks()
    if is_there("exrinfo", "openexr"):
        check_headers(checks)
    checks.dspm("--png", "--contact-sheet", "page.apng")
    if is_there("apngdis", "apngdis"):
        check_apng(checks)
    if is_there("webpmux", "webp"):
        checks.dspm("--contact-sheet", "page.webp")
        check_webp(checks)
    checks.dspm("--frames", "1", "--png", "--png-bits", "16", "--png-space", "display-p3", "-o", "p3.####.exr")
    if is_there("pngcheck", "pngcheck"):
        check_png(checks)
    if is_there("exiftool", "libimage-exiftool-perl"):
        check_colours(checks)
    if is_there("ffmpeg", "ffmpeg"):
        checks.dspm("--video", "page.mp4")
        check_streams(checks)
        check_exr(checks)
    checks.finish()


main()
