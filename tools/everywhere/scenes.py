#!/usr/bin/env python3
"""Small scenes that differ in one thing each, of all kinds that dspm has: what two systems are compared by.
usage: scenes.py folder"""
import pathlib
import sys

SCENE = """Frames 3
{camera}
{film}
{integrator}
WorldBegin
{light}
{world}
DynamicBegin "ball" Keyframe 1 Translate -0.7 0.7 0 Keyframe 3 Rotate 30 0 1 0 Translate 0.7 0.7 0 KeyframeEnd
{material}
{shape}
DynamicEnd
"""
USUAL = {
    "camera": 'LookAt 0.2 2 -5  0 0.5 0  0 1 0 Camera "perspective" "float fov" 38',
    "film": 'Film "rgb" "integer xresolution" 48 "integer yresolution" 36',
    "integrator": 'Integrator "dsppm" "integer iterations" 4 "integer photons" 20000',
    "light": 'LightSource "spot" "point3 from" [2 5 -2] "point3 to" [0 0 0] "rgb I" [90 80 70]\n'
             'LightSource "infinite" "rgb L" [0.1 0.15 0.2]',
    "world": 'AttributeBegin Rotate 90 1 0 0 Material "coateddiffuse" "rgb reflectance" [0.5 0.4 0.3] "float roughness" 0.2\n'
             'Shape "disk" "float radius" 4 AttributeEnd\n'
             'AttributeBegin Translate 0 0.4 1.5 Material "conductor" "spectrum eta" "metal-Cu-eta" "spectrum k" "metal-Cu-k"\n'
             'Shape "sphere" "float radius" 0.4 AttributeEnd',
    "material": 'Material "dielectric" "float eta" 1.5',
    "shape": 'Shape "sphere" "float radius" 0.6',
}
CUBE = ('"point3 P" [-1 -1 -1  1 -1 -1  1 1 -1  -1 1 -1  -1 -1 1  1 -1 1  1 1 1  -1 1 1] "integer indices" '
        '[0 2 1 0 3 2 4 5 6 4 6 7 0 1 5 0 5 4 2 3 7 2 7 6 1 2 6 1 6 5 0 4 7 0 7 3]')
SQUARE = '"point3 P" [-0.6 -0.6 0  0.6 -0.6 0  -0.6 0.6 0.3  0.6 0.6 0]'


def textured(texture):
    return f'Texture "t" "spectrum" {texture}\nMaterial "diffuse" "texture reflectance" "t"'


DIFFERENT = {
    "integrator": {
        "sppm": 'Integrator "sppm" "integer iterations" 4 "integer photons" 20000',
        "photonmap": 'Integrator "photonmap" "integer photons" 20000 "integer iterations" 2',
        "path": 'Integrator "path" "integer iterations" 8',
        "vcm": 'Integrator "vcm" "integer iterations" 4',
        "ambientocclusion": 'Integrator "ambientocclusion" "integer iterations" 4',
        "hj09": 'Integrator "dsppm" "integer iterations" 4 "integer photons" 20000 "string estimator" "hj09"',
    },
    "camera": {
        "orthographic": 'LookAt 0 2 -5  0 0.5 0  0 1 0 Camera "orthographic" "float screenwindow" [-2 2 -1.5 1.5]',
        "spherical": 'LookAt 0 1.5 -2  0 0.5 0  0 1 0 Camera "spherical"',
        "lens": 'LookAt 0 2 -5  0 0.5 0  0 1 0 Camera "perspective" "float fov" 38 "float lensradius" 0.1 "float focaldistance" 5',
    },
    "light": {
        "distant": 'LightSource "distant" "point3 from" [1 2 -1] "rgb L" [2 2 2]',
        "point": 'LightSource "point" "point3 from" [1 3 -1] "rgb I" [20 20 20]',
        "infinite": 'LightSource "infinite" "rgb L" [0.6 0.8 1]',
        "area": 'AttributeBegin Translate 0 3 0 Rotate 90 1 0 0 AreaLightSource "diffuse" "rgb L" [9 8 7] "bool twosided" true\n'
                'Shape "disk" "float radius" 0.5 AttributeEnd',
        "sphere light": 'AttributeBegin Translate 1 3 -1 AreaLightSource "diffuse" "rgb L" [30 28 25]\n'
                        'Shape "sphere" "float radius" 0.3 AttributeEnd',
        "blackbody": 'LightSource "point" "point3 from" [1 3 -1] "blackbody I" 4500 "float scale" 30',
    },
    "material": {
        "diffuse": 'Material "diffuse" "rgb reflectance" [0.7 0.3 0.2]',
        "diffusetransmission": 'Material "diffusetransmission"',
        "coateddiffuse": 'Material "coateddiffuse" "float roughness" 0.1',
        "coatedconductor": 'Material "coatedconductor"',
        "conductor": 'Material "conductor" "float roughness" 0.2',
        "brushed": 'Material "conductor" "float uroughness" 0.05 "float vroughness" 0.3',
        "rough glass": 'Material "dielectric" "float roughness" 0.2',
        "thindielectric": 'Material "thindielectric"',
        "principled": 'Material "principled" "rgb basecolor" [0.2 0.5 0.7] "float coat" 0.6 "rgb sheen" [0.3 0.3 0.3] "float roughness" 0.4',
        "soap film": 'Material "principled" "rgb basecolor" [0.1 0.1 0.1] "float roughness" 0.1 "float iridescence" 1',
        "subsurface": 'Material "subsurface" "rgb mfp" [0.2 0.1 0.05] "rgb reflectance" [0.8 0.6 0.5]',
    },
    "texture": {name: textured(text) for name, text in {
        "checkerboard": '"checkerboard" "float uscale" 8 "float vscale" 8',
        "dots": '"dots" "float uscale" 8 "float vscale" 8 "rgb inside" [1 0 0] "rgb outside" [0.2 0.2 0.2]',
        "fbm": '"fbm"',
        "marble": '"marble"',
        "wrinkled": '"wrinkled"',
        "windy": '"windy"',
        "spherical mapping": '"checkerboard" "string mapping" "spherical" "float uscale" 8 "float vscale" 8',
        "cylindrical mapping": '"checkerboard" "string mapping" "cylindrical" "float uscale" 8 "float vscale" 4',
    }.items()},
    "shape": {
        "mesh": f'Scale 0.5 0.5 0.5 Shape "trianglemesh" {CUBE}',
        "loop": f'Scale 0.5 0.5 0.5 Shape "loopsubdiv" "integer levels" 2 {CUBE}',
        "bilinear": f'Shape "bilinearmesh" {SQUARE} "integer indices" [0 1 2 3]',
        "cylinder": 'Shape "cylinder" "float radius" 0.4 "float zmin" -0.5 "float zmax" 0.5 "float phimax" 270',
        "part of a sphere": 'Shape "sphere" "float radius" 0.6 "float zmin" -0.3 "float zmax" 0.5 "float phimax" 300',
        "curve": 'Material "hair" "rgb reflectance" [0.6 0.4 0.2]\nShape "curve" "point3 P" [-0.5 -0.5 0 -0.2 0.5 0 0.2 -0.5 0 0.5 0.5 0] '
                 '"float width" 0.2',
    },
    "film": {
        "gbuffer": 'Film "gbuffer" "integer xresolution" 48 "integer yresolution" 36',
        "gaussian": 'Film "rgb" "integer xresolution" 48 "integer yresolution" 36 PixelFilter "gaussian"',
    },
}

folder = pathlib.Path(sys.argv[1])
folder.mkdir(parents=True, exist_ok=True)
for what, kinds in DIFFERENT.items():
    for name, text in kinds.items():
        parts = USUAL | {"material" if what == "texture" else what: text}
        (folder / f"{what}-{name.replace(' ', '-')}.dsc").write_text(SCENE.format(**parts))
(folder / "usual.dsc").write_text(SCENE.format(**USUAL))
