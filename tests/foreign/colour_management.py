#!/usr/bin/env python3
"""--view ocio against OpenColorIO's own tool: configurations of the test's, and Blender's. Exit code 77: no tool, or dspm was built
without the library.
usage: colour_management.py dspm"""
import os, pathlib, subprocess

from support import Checks, is_there, np, program, read_png

BLENDERS = pathlib.Path("/usr/share/blender/datafiles/colormanagement/config.ocio")
BLENDERS_VIEWS = ["sRGB/Standard", "sRGB/Filmic", "sRGB/False Color", "sRGB/Raw", "XYZ/DCI"]
# A display of exponents, and a view that goes through a matrix and a table.
CONFIGURATION = """ocio_profile_version: 1
search_path: luts
roles:
  default: Linear
  scene_linear: Linear
displays:
  screen:
    - !<View> {name: Film, colorspace: film}
    - !<View> {name: Gamma, colorspace: gamma}
active_displays: [screen]
active_views: [Film, Gamma]
colorspaces:
  - !<ColorSpace>
    name: Linear
    isdata: false
  - !<ColorSpace>
    name: gamma
    isdata: false
    from_reference: !<ExponentTransform> {value: [2.4, 2.2, 2, 1], direction: inverse}
  - !<ColorSpace>
    name: film
    isdata: false
    from_reference: !<GroupTransform>
      children:
        - !<MatrixTransform> {matrix: [.8, .1, .1, 0, .2, .7, .1, 0, .1, .2, .7, 0, 0, 0, 0, 1]}
        - !<AllocationTransform> {allocation: lg2, vars: [-8, 4]}
        - !<FileTransform> {src: film.spi1d, interpolation: linear}
"""
VIEWS = ["screen/Film", "screen/Gamma"]
# As the configurations of ACES are made: another working space, and views in two steps.
ACES = """ocio_profile_version: 2
strictparsing: false
roles:
  aces_interchange: ACES2065-1
  cie_xyz_d65_interchange: CIE-XYZ-D65
  default: Raw
  scene_linear: ACEScg
displays:
  sRGB:
    - !<View> {name: SDR, view_transform: ACES 1.0, display_colorspace: sRGB}
    - !<View> {name: Raw, colorspace: Raw}
active_displays: [sRGB]
active_views: [SDR, Raw]
view_transforms:
  - !<ViewTransform>
    name: ACES 1.0
    from_scene_reference: !<BuiltinTransform> {style: ACES-OUTPUT - ACES2065-1_to_CIE-XYZ-D65 - SDR-VIDEO_1.0}
display_colorspaces:
  - !<ColorSpace>
    name: CIE-XYZ-D65
    isdata: false
  - !<ColorSpace>
    name: sRGB
    isdata: false
    from_display_reference: !<BuiltinTransform> {style: DISPLAY - CIE-XYZ-D65_to_sRGB}
colorspaces:
  - !<ColorSpace>
    name: ACES2065-1
    isdata: false
  - !<ColorSpace>
    name: Raw
    isdata: true
  - !<ColorSpace>
    name: ACEScg
    isdata: false
    to_scene_reference: !<BuiltinTransform> {style: ACEScg_to_ACES2065-1}
  - !<ColorSpace>
    name: Linear
    isdata: false
    from_scene_reference: !<GroupTransform>
      children:
        - !<BuiltinTransform> {style: UTILITY - ACES-AP0_to_CIE-XYZ-D65_BFD}
        - !<MatrixTransform> {matrix: [3.2404542, -1.5371385, -0.4985314, 0, -0.969266, 1.8760108, 0.041556, 0, 0.0556434, -0.2040259, 1.0572252, 0, 0, 0, 0, 1]}
"""


def compare(checks, config, views):
    environment = os.environ | {"OCIO": str(config)}
    for view in views:
        checks.run(program, "--sheet", "own.png", "--no-labels", "--view", f"ocio:{view}", "tiny.0001.exr", env=environment)
        checks.run("ocioconvert", "--view", "tiny.0001.exr", "Linear", "theirs.png", *view.split("/"), env=environment)
        own, theirs = (read_png((checks.folder / name).read_bytes()) for name in ("own.png", "theirs.png"))
        if theirs.max() > 255:
            theirs = (theirs + 128) // 257
        height, width = theirs.shape[:2]
        own = own[8:8 + height, 8:8 + width]  # the sheet's margin
        apart = np.abs(own - theirs).max()
        checks.expect(apart <= 1 and theirs.std() > 5, f"{view} of {config}: {apart} of 255 apart")


def main():
    checks = Checks()
    run = subprocess.run([program, "tiny.dsc", "--check", "--view", "ocio"], cwd=checks.folder, capture_output=True, text=True)
    if "built without OpenColorIO" in run.stderr:
        print("SKIPPED: dspm was built without OpenColorIO")
    elif is_there("ocioconvert", "opencolorio-tools"):
        checks.dspm("--frames", "1")
        (checks.folder / "luts").mkdir()
        curve = "\n".join(str(1 - (1 - i / 32) ** 1.5) for i in range(33))
        (checks.folder / "luts/film.spi1d").write_text(f"Version 1\nFrom 0 1\nLength 33\nComponents 1\n{{\n{curve}\n}}\n")
        for name, text, views in (("small.ocio", CONFIGURATION, VIEWS), ("aces.ocio", ACES, ["sRGB/SDR"])):
            (checks.folder / name).write_text(text)
            compare(checks, checks.folder / name, views)
        if BLENDERS.exists():
            compare(checks, BLENDERS, BLENDERS_VIEWS)
    checks.finish()


main()
