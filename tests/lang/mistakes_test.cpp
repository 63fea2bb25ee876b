// What bad input gets: the whole text of every message, as the user sees it.
#include "tests/lang/parsing.h"

namespace dspm::test {
namespace {

struct Mistake {
  const char* text;
  const char* messages;
};

class Mistakes : public testing::TestWithParam<Mistake> {};

TEST_P(Mistakes, AreTold) { EXPECT_EQ(parse(GetParam().text).messages(), GetParam().messages); }

const Mistake kSyntax[] = {
    {"WorldBegin\nShape \"a\" \"float f\"\nShape \"b\"",
     "scene.dsc:2:11: error: this parameter has no value\n"
     "    2 | Shape \"a\" \"float f\"\n"
     "      |           ^~~~~~~~~\n"},
    {"WorldBegin\nShap \"sphere\"",
     "scene.dsc:2:1: error: unknown directive Shap\n"
     "    2 | Shap \"sphere\"\n"
     "      | ^~~~\n"
     "  did you mean \"Shape\"?\n"},
    {"WorldBegin\n  Shape",
     "scene.dsc:2:3: error: Shape must be followed by a name in quotes\n"
     "    2 |   Shape\n"
     "      |   ^~~~~\n"},
    {"WorldBegin 12",
     "scene.dsc:1:12: error: WorldBegin does not take 12 here\n"
     "    1 | WorldBegin 12\n"
     "      |            ^~\n"},
    {"WorldBegin \"a\"",
     "scene.dsc:1:12: error: WorldBegin does not take \"a\" here\n"
     "    1 | WorldBegin \"a\"\n"
     "      |            ^~~\n"},
    {"WorldBegin\nShape \"sphere\" \"flaot radius\" 1",
     "scene.dsc:2:16: error: unknown parameter type \"flaot\"\n"
     "    2 | Shape \"sphere\" \"flaot radius\" 1\n"
     "      |                ^~~~~~~~~~~~~~\n"
     "  did you mean \"float\"?\n"},
    {"WorldBegin\nShape \"sphere\" \"color c\" 1",
     "scene.dsc:2:16: error: unknown parameter type \"color\"\n"
     "    2 | Shape \"sphere\" \"color c\" 1\n"
     "      |                ^~~~~~~~~\n"
     "  did you mean \"rgb\"?\n"},
    {"WorldBegin\nShape \"sphere\" \"radius\" 1",
     "scene.dsc:2:16: error: expected a type and a name, as in \"float radius\"\n"
     "    2 | Shape \"sphere\" \"radius\" 1\n"
     "      |                ^~~~~~~~\n"},
    {"WorldBegin\nShape \"sphere\" \"float \" 1",
     "scene.dsc:2:16: error: a name is missing after the parameter's type\n"
     "    2 | Shape \"sphere\" \"float \" 1\n"
     "      |                ^~~~~~~~\n"},
    {"WorldBegin\nShape \"sphere\" \"float radius\"",
     "scene.dsc:2:16: error: this parameter has no value\n"
     "    2 | Shape \"sphere\" \"float radius\"\n"
     "      |                ^~~~~~~~~~~~~~\n"},
    {"WorldBegin\nShape \"sphere\" \"float radius\" \"wood\"",
     "scene.dsc:2:31: error: expected a number for \"float radius\"\n"
     "    2 | Shape \"sphere\" \"float radius\" \"wood\"\n"
     "      |                               ^~~~~~\n"
     "  a texture is given as \"texture radius\" \"wood\"\n"},
    {"WorldBegin\nShape \"a\" \"string s\" 4",
     "scene.dsc:2:22: error: expected a string in quotes\n"
     "    2 | Shape \"a\" \"string s\" 4\n"
     "      |                      ^\n"},
    {"WorldBegin\nShape \"a\" \"bool b\" [yes]",
     "scene.dsc:2:21: error: expected true or false\n"
     "    2 | Shape \"a\" \"bool b\" [yes]\n"
     "      |                     ^~~\n"},
    {"WorldBegin\nShape \"a\" \"integer i\" 1.5",
     "scene.dsc:2:23: error: expected an integer\n"
     "    2 | Shape \"a\" \"integer i\" 1.5\n"
     "      |                       ^~~\n"},
    {"WorldBegin\nShape \"a\" \"integer i\" 3e0",
     "scene.dsc:2:23: error: expected an integer\n"
     "    2 | Shape \"a\" \"integer i\" 3e0\n"
     "      |                       ^~~\n"
     "  write 3\n"},
    {"WorldBegin\nShape \"a\" \"float f\" [1 nan]",
     "scene.dsc:2:24: error: numbers must be finite\n"
     "    2 | Shape \"a\" \"float f\" [1 nan]\n"
     "      |                        ^~~\n"},
    {"WorldBegin\nShape \"a\" \"point3 P\" [1 2 3 4]",
     "scene.dsc:2:11: error: 4 numbers cannot be values of type point3\n"
     "    2 | Shape \"a\" \"point3 P\" [1 2 3 4]\n"
     "      |           ^~~~~~~~~~\n"
     "  each value has 3 numbers\n"},
    {"WorldBegin\nShape \"a\" \"spectrum s\" [1 2 3]",
     "scene.dsc:2:11: error: 3 numbers cannot be values of type spectrum\n"
     "    2 | Shape \"a\" \"spectrum s\" [1 2 3]\n"
     "      |           ^~~~~~~~~~~~\n"
     "  a sampled spectrum is a list of wavelength and value pairs\n"},
    {"WorldBegin\nShape \"a\" \"rgb c\" 1 2 3",
     "scene.dsc:2:11: error: 1 number cannot be values of type rgb\n"
     "    2 | Shape \"a\" \"rgb c\" 1 2 3\n"
     "      |           ^~~~~~~\n"
     "  put several numbers in brackets\n"},
    {"WorldBegin\nShape \"a\" \"float f\" 1 2",
     "scene.dsc:2:23: error: expected a parameter or a directive, not 2\n"
     "    2 | Shape \"a\" \"float f\" 1 2\n"
     "      |                       ^\n"
     "  put several numbers in brackets\n"},
    {"WorldBegin\nShape \"a\" \"float f\" [1 2\nShape \"b\"",
     "scene.dsc:3:1: error: expected a number, or ] to end the list\n"
     "    3 | Shape \"b\"\n"
     "      | ^\n"},
    {"WorldBegin\nShape \"a\" \"float f\" [1 2",
     "scene.dsc:2:21: error: this list is not closed\n"
     "    2 | Shape \"a\" \"float f\" [1 2\n"
     "      |                     ^\n"},
    {"WorldBegin\nShape \"a\" \"string s\" [\"b\"",
     "scene.dsc:2:22: error: this list is not closed\n"
     "    2 | Shape \"a\" \"string s\" [\"b\"\n"
     "      |                      ^\n"},
    {"WorldBegin\nShape \"sphere\nShape \"b\"",
     "scene.dsc:2:7: error: this string is not closed on its line\n"
     "    2 | Shape \"sphere\n"
     "      |       ^\n"},
    {"WorldBegin\nShape \"a\\q\"",
     "scene.dsc:2:9: error: unknown escape\n"
     "    2 | Shape \"a\\q\"\n"
     "      |         ^~\n"
     "  available: \\b \\f \\n \\r \\t \\\\ \\' \\\"\n"},
    {"WorldBegin\nShape \"a\" \"float f\" 1 \"float f\" 2",
     "scene.dsc:2:23: error: parameter \"f\" is given twice\n"
     "    2 | Shape \"a\" \"float f\" 1 \"float f\" 2\n"
     "      |                       ^~~~~~~~~\n"
     "  first on line 2\n"},
    {"WorldBegin\nMaterial \"a\" \"float f@2\" 1 \"float f\" 2",
     "scene.dsc:2:14: error: parameter \"f\" is given both with and without a frame\n"
     "    2 | Material \"a\" \"float f@2\" 1 \"float f\" 2\n"
     "      |              ^~~~~~~~~~~\n"
     "  first on line 2\n"},
    {"WorldBegin\nMaterial \"a\" \"float f@x\" 1",
     "scene.dsc:2:14: error: expected a frame after @, counted from 1, but found \"x\"\n"
     "    2 | Material \"a\" \"float f@x\" 1\n"
     "      |              ^~~~~~~~~~~\n"},
    {"WorldBegin\nMaterial \"a\" \"float f@0\" 1",
     "scene.dsc:2:14: error: expected a frame after @, counted from 1, but found \"0\"\n"
     "    2 | Material \"a\" \"float f@0\" 1\n"
     "      |              ^~~~~~~~~~~\n"},
};
INSTANTIATE_TEST_SUITE_P(Syntax, Mistakes, testing::ValuesIn(kSyntax));

const Mistake kTransforms[] = {
    {"WorldBegin\nTranslate 1 2",
     "scene.dsc:2:1: error: Translate takes 3 numbers, but 2 follow\n"
     "    2 | Translate 1 2\n"
     "      | ^~~~~~~~~\n"},
    {"WorldBegin\nTranslate 1 2 3 4",
     "scene.dsc:2:17: error: Translate does not take 4 here\n"
     "    2 | Translate 1 2 3 4\n"
     "      |                 ^\n"},
    {"WorldBegin\nRotate inf 0 0 1",
     "scene.dsc:2:8: error: numbers must be finite\n"
     "    2 | Rotate inf 0 0 1\n"
     "      |        ^~~\n"},
    {"WorldBegin\nTransform [1 0 0]",
     "scene.dsc:2:11: error: Transform takes 16 numbers, but this list has 3\n"
     "    2 | Transform [1 0 0]\n"
     "      |           ^\n"},
    {"WorldBegin\nTransform 1 0 0",
     "scene.dsc:2:1: error: Transform takes 16 numbers in brackets\n"
     "    2 | Transform 1 0 0\n"
     "      | ^~~~~~~~~\n"},
    {"WorldBegin\nScale 0 1 1",
     "scene.dsc:2:1: error: Scale is singular\n"
     "    2 | Scale 0 1 1\n"
     "      | ^~~~~\n"
     "  none of its factors may be 0\n"},
    {"WorldBegin\nRotate 30 0 0 0",
     "scene.dsc:2:1: error: Rotate is singular\n"
     "    2 | Rotate 30 0 0 0\n"
     "      | ^~~~~~\n"
     "  its axis must not be 0 0 0\n"},
    {"WorldBegin\nLookAt 0 0 0  0 2 0  0 1 0",
     "scene.dsc:2:1: error: LookAt is singular\n"
     "    2 | LookAt 0 0 0  0 2 0  0 1 0\n"
     "      | ^~~~~~\n"
     "  eye and target must differ, and up must not be parallel to the view direction\n"},
    {"WorldBegin\nTransform [1 0 0 0 1 0 0 0 0 0 1 0 0 0 0 1]",
     "scene.dsc:2:1: error: Transform is singular\n"
     "    2 | Transform [1 0 0 0 1 0 0 0 0 0 1 0 0 0 0 1]\n"
     "      | ^~~~~~~~~\n"
     "  it must have an inverse\n"},
    {"WorldBegin\nTransform [1 0 0 1 0 1 0 0 0 0 1 0 0 0 0 1]",
     "scene.dsc:2:1: error: Transform is not affine\n"
     "    2 | Transform [1 0 0 1 0 1 0 0 0 0 1 0 0 0 0 1]\n"
     "      | ^~~~~~~~~\n"
     "  values 4, 8 and 12 must be 0, value 16 must be 1\n"},
    {"WorldBegin\nScale 1e25 1e25 1e25 Scale 1e25 1e25 1e25",
     "scene.dsc:2:22: error: this Scale makes the current transform singular\n"
     "    2 | Scale 1e25 1e25 1e25 Scale 1e25 1e25 1e25\n"
     "      |                      ^~~~~\n"},
    {"WorldBegin\nCoordSysTransform \"camrea\"",
     "scene.dsc:2:19: error: unknown coordinate system \"camrea\"\n"
     "    2 | CoordSysTransform \"camrea\"\n"
     "      |                   ^~~~~~~~\n"
     "  did you mean \"camera\"?\n"},
    {"WorldBegin\nActiveTransform EndTime\nScale 2 2 2\nShape \"sphere\"",
     "scene.dsc:4:1: error: this Shape moves, but is not in a Dynamic block\n"
     "    4 | Shape \"sphere\"\n"
     "      | ^~~~~\n"
     "  put it and its keys between DynamicBegin \"a name\" and DynamicEnd\n"},
    {"TransformTimes 1 1\nWorldBegin",
     "scene.dsc:1:1: error: the second time of TransformTimes must be after the first\n"
     "    1 | TransformTimes 1 1\n"
     "      | ^~~~~~~~~~~~~~\n"},
};
INSTANTIATE_TEST_SUITE_P(Transforms, Mistakes, testing::ValuesIn(kTransforms));

const Mistake kNesting[] = {
    {"WorldBegin\n\nDynamicBegin \"horse\"\n  Shape \"a\"\nAttributeEnd",
     "scene.dsc:5:1: error: AttributeEnd does not match DynamicBegin \"horse\" (line 3)\n"
     "    5 | AttributeEnd\n"
     "      | ^~~~~~~~~~~~\n"
     "  DynamicBegin ends with DynamicEnd\n"},
    {"WorldBegin\nAttributeBegin\nObjectBegin \"leg\"\nAttributeEnd",
     "scene.dsc:4:1: error: AttributeEnd does not match ObjectBegin \"leg\" (line 3)\n"
     "    4 | AttributeEnd\n"
     "      | ^~~~~~~~~~~~\n"
     "  ObjectBegin ends with ObjectEnd\n"},
    {"WorldBegin\nAttributeEnd",
     "scene.dsc:2:1: error: AttributeEnd without AttributeBegin\n"
     "    2 | AttributeEnd\n"
     "      | ^~~~~~~~~~~~\n"},
    {"WorldBegin\nAttributeBegin\n  DynamicBegin \"horse\"",
     "scene.dsc:2:1: error: AttributeBegin is not closed\n"
     "    2 | AttributeBegin\n"
     "      | ^~~~~~~~~~~~~~\n"
     "  AttributeEnd is missing\n"
     "scene.dsc:3:3: error: DynamicBegin \"horse\" is not closed\n"
     "    3 |   DynamicBegin \"horse\"\n"
     "      |   ^~~~~~~~~~~~\n"
     "  DynamicEnd is missing\n"},
    {"WorldBegin\nObjectBegin \"a\"\nObjectBegin \"b\"\nObjectEnd\nObjectInstance \"c\"\nObjectEnd",
     "scene.dsc:3:1: error: ObjectBegin inside ObjectBegin \"a\" (line 2)\n"
     "    3 | ObjectBegin \"b\"\n"
     "      | ^~~~~~~~~~~\n"
     "  objects cannot hold objects\n"
     "scene.dsc:5:1: error: ObjectInstance inside ObjectBegin \"a\" (line 2)\n"
     "    5 | ObjectInstance \"c\"\n"
     "      | ^~~~~~~~~~~~~~\n"
     "  objects cannot hold objects\n"},
    {"WorldBegin\nFilm \"rgb\"",
     "scene.dsc:2:1: error: Film must come before WorldBegin\n"
     "    2 | Film \"rgb\"\n"
     "      | ^~~~\n"
     "  the world begins on line 1\n"},
    {"Shape \"a\"\nShape \"b\"",
     "scene.dsc:1:1: error: Shape must come after WorldBegin\n"
     "    1 | Shape \"a\"\n"
     "      | ^~~~~\n"
     "  WorldBegin is missing before it, unless this file is meant to be included by another\n"},
    {"WorldBegin\nWorldBegin",
     "scene.dsc:2:1: error: a second WorldBegin\n"
     "    2 | WorldBegin\n"
     "      | ^~~~~~~~~~\n"
     "  the first is on line 1\n"},
    {"Film \"rgb\"", "scene.dsc: error: there is no WorldBegin, so there is nothing to render\n"},
    {"", "scene.dsc: error: there is no WorldBegin, so there is nothing to render\n"},
};
INSTANTIATE_TEST_SUITE_P(Nesting, Mistakes, testing::ValuesIn(kNesting));

const Mistake kNames[] = {
    {"WorldBegin\nMakeNamedMaterial \"a\" \"string type\" \"b\"\nMakeNamedMaterial \"a\" \"string type\" \"c\"",
     "scene.dsc:3:19: error: MakeNamedMaterial \"a\" appears twice\n"
     "    3 | MakeNamedMaterial \"a\" \"string type\" \"c\"\n"
     "      |                   ^~~\n"
     "  the first is at scene.dsc:2\n"},
    {"WorldBegin\nMakeNamedMaterial \"a\"",
     "scene.dsc:2:1: error: MakeNamedMaterial \"a\" needs a \"string type\"\n"
     "    2 | MakeNamedMaterial \"a\"\n"
     "      | ^~~~~~~~~~~~~~~~~\n"},
    {"WorldBegin\nTexture \"t\" \"rgb\" \"constant\"",
     "scene.dsc:2:13: error: a texture cannot be of type \"rgb\"\n"
     "    2 | Texture \"t\" \"rgb\" \"constant\"\n"
     "      |             ^~~~~\n"
     "  available: float, spectrum\n"},
    {"WorldBegin\nAttribute \"sahpe\" \"float r\" 1",
     "scene.dsc:2:11: error: unknown target \"sahpe\" of Attribute\n"
     "    2 | Attribute \"sahpe\" \"float r\" 1\n"
     "      |           ^~~~~~~\n"
     "  did you mean \"shape\"?\n"},
    {"Option \"sede\" 1\nWorldBegin",
     "scene.dsc:1:8: error: unknown Option \"sede\"\n"
     "    1 | Option \"sede\" 1\n"
     "      |        ^~~~~~\n"
     "  did you mean \"seed\"?\n"},
    {"Option \"colour\" \"red\"\nWorldBegin",
     "scene.dsc:1:17: error: expected \"rgb\" or \"spectral\"\n"
     "    1 | Option \"colour\" \"red\"\n"
     "      |                 ^~~~~\n"},
    {"Option \"seed\" 1.5\nWorldBegin",
     "scene.dsc:1:15: error: expected an integer\n"
     "    1 | Option \"seed\" 1.5\n"
     "      |               ^~~\n"},
    {"Option \"forcediffuse\" true\nWorldBegin",
     "scene.dsc:1:8: error: dspm has no Option \"forcediffuse\"\n"
     "    1 | Option \"forcediffuse\" true\n"
     "      |        ^~~~~~~~~~~~~~\n"
     "  with --lenient, it has no effect\n"},
    {"Option \"forcediffuse\" false\nOption \"sede\" 1\nWorldBegin",
     "scene.dsc:2:8: error: unknown Option \"sede\"\n"
     "    2 | Option \"sede\" 1\n"
     "      |        ^~~~~~\n"
     "  did you mean \"seed\"?\n"},
    {"Option \"displacementedgescale\" 0\nWorldBegin",
     "scene.dsc:1:32: error: expected a number above 0\n"
     "    1 | Option \"displacementedgescale\" 0\n"
     "      |                                ^\n"},
    {"ColorSpace \"rec2022\"\nWorldBegin",
     "scene.dsc:1:12: error: unknown ColorSpace \"rec2022\"\n"
     "    1 | ColorSpace \"rec2022\"\n"
     "      |            ^~~~~~~~~\n"
     "  did you mean \"rec2020\"? available: srgb, rec2020, aces2065-1, dci-p3\n"},
    {"WorldBegin\nShape \"a\" \"float f\" $radius",
     "scene.dsc:2:21: error: $radius has no value\n"
     "    2 | Shape \"a\" \"float f\" $radius\n"
     "      |                     ^~~~~~~\n"
     "  give it one: Default radius 1 before it, or -D radius=1 on the command line\n"},
};
INSTANTIATE_TEST_SUITE_P(Names, Mistakes, testing::ValuesIn(kNames));

const Mistake kAnimation[] = {
    {"Frames 0\nWorldBegin",
     "scene.dsc:1:1: error: expected a number of frames from 1 to 100000\n"
     "    1 | Frames 0\n"
     "      | ^~~~~~\n"},
    {"Frames 4 \"float fsp\" 25\nWorldBegin",
     "scene.dsc:1:10: error: unknown parameter \"fsp\" of Frames\n"
     "    1 | Frames 4 \"float fsp\" 25\n"
     "      |          ^~~~~~~~~~~\n"
     "  did you mean \"fps\"? (known parameters: fps, first)\n"},
    {"Frames 4\nFrames 5\nWorldBegin",
     "scene.dsc:2:1: error: a second Frames directive\n"
     "    2 | Frames 5\n"
     "      | ^~~~~~\n"
     "  the first is on line 1\n"},
    {"Film \"rgb\" \"integer xresolution@2\" 3\nWorldBegin",
     "scene.dsc:1:12: error: parameters of Film cannot change between frames\n"
     "    1 | Film \"rgb\" \"integer xresolution@2\" 3\n"
     "      |            ^~~~~~~~~~~~~~~~~~~~~~~\n"
     "  those of Camera, materials, media, textures, lights and shapes in Dynamic blocks can\n"},
    {"Frames 4\nWorldBegin\nShape \"sphere\" \"float radius@2\" 3",
     "scene.dsc:3:16: error: only shapes in a Dynamic block may differ between frames\n"
     "    3 | Shape \"sphere\" \"float radius@2\" 3\n"
     "      |                ^~~~~~~~~~~~~~~~\n"
     "  put it between DynamicBegin \"a name\" and DynamicEnd\n"},
    {"Frames 4\nWorldBegin\nShape \"plymesh\" \"string filename\" \"a.%03d.ply\"",
     "scene.dsc:3:17: error: only shapes in a Dynamic block may differ between frames\n"
     "    3 | Shape \"plymesh\" \"string filename\" \"a.%03d.ply\"\n"
     "      |                 ^~~~~~~~~~~~~~~~~\n"
     "  put it between DynamicBegin \"a name\" and DynamicEnd\n"},
    {"Frames 9\nWorldBegin\nKeyframe 1 KeyframeEnd",
     "scene.dsc:3:1: error: Keyframe must be in a Dynamic block or before Camera\n"
     "    3 | Keyframe 1 KeyframeEnd\n"
     "      | ^~~~~~~~\n"},
    {"Frames 9\nCamera \"perspective\"\nKeyframe 1 KeyframeEnd\nWorldBegin",
     "scene.dsc:3:1: error: Keyframe must be in a Dynamic block or before Camera\n"
     "    3 | Keyframe 1 KeyframeEnd\n"
     "      | ^~~~~~~~\n"},
    {"Frames 9\nKeyframe 3 Keyframe 3 KeyframeEnd\nWorldBegin",
     "scene.dsc:2:12: error: Keyframe 3 comes after Keyframe 3\n"
     "    2 | Keyframe 3 Keyframe 3 KeyframeEnd\n"
     "      |            ^~~~~~~~\n"
     "  keys must be in ascending order\n"},
    {"Frames 9\nKeyframe 0\nWorldBegin",
     "scene.dsc:2:10: error: expected a frame from 1 to 1000000, or seconds, such as 1.5s\n"
     "    2 | Keyframe 0\n"
     "      |          ^\n"},
    {"Frames 9 Keyframe nan Translate 1 0 0\nWorldBegin",
     "scene.dsc:1:19: error: expected a frame from 1 to 1000000, or seconds, such as 1.5s\n"
     "    1 | Frames 9 Keyframe nan Translate 1 0 0\n"
     "      |                   ^~~\n"},
    {"Frames 9\nKeyframe 1s Translate 1 0 0\nWorldBegin",
     "scene.dsc:2:10: error: seconds need the number of frames per second\n"
     "    2 | Keyframe 1s Translate 1 0 0\n"
     "      |          ^~\n"
     "  give it before the first key: Frames 48 \"float fps\" 24\n"},
    {"Frames 9 \"integer first\" 999999\nWorldBegin",
     "scene.dsc:1:10: error: frames have numbers from 0 to 1000000\n"
     "    1 | Frames 9 \"integer first\" 999999\n"
     "      |          ^~~~~~~~~~~~~~~\n"},
    {"Frames 9\nKeyframe 1.5 Keyframe 1.5 KeyframeEnd\nWorldBegin",
     "scene.dsc:2:14: error: Keyframe 1.5 comes after Keyframe 1.5\n"
     "    2 | Keyframe 1.5 Keyframe 1.5 KeyframeEnd\n"
     "      |              ^~~~~~~~\n"
     "  keys must be in ascending order\n"},
    {"Frames 9\nKeyframe 1 Translate 1 0 0 KeyframeEnd \"string after\" \"repeat\"\nWorldBegin",
     "scene.dsc:2:1: error: one key makes no cycle\n"
     "    2 | Keyframe 1 Translate 1 0 0 KeyframeEnd \"string after\" \"repeat\"\n"
     "      | ^~~~~~~~\n"
     "  the way from the first key to the last is repeated\n"},
    {"Frames 9\nKeyframe 1 \"integer turns\" 2 Rotate 0 0 1 0 Keyframe 5 Rotate 9 0 1 0 KeyframeEnd\nWorldBegin",
     "scene.dsc:2:12: error: turns are for matrices, and for keys whose transforms differ\n"
     "    2 | Keyframe 1 \"integer turns\" 2 Rotate 0 0 1 0 Keyframe 5 Rotate 9 0 1 0 KeyframeEnd\n"
     "      |            ^~~~~~~~~~~~~~~\n"
     "  the angle of Rotate says how often it turns: Rotate 720 0 1 0 is two full turns\n"},
    {"Frames 9\nKeyframe 1 \"integer turns\" 2 Identity Keyframe 5 Identity KeyframeEnd\nWorldBegin",
     "scene.dsc:2:12: error: the rotation is the same at this key and the next, so there is no axis for turns\n"
     "    2 | Keyframe 1 \"integer turns\" 2 Identity Keyframe 5 Identity KeyframeEnd\n"
     "      |            ^~~~~~~~~~~~~~~\n"
     "  write it as Rotate: Rotate 720 0 1 0 is two full turns\n"},
    {"Frames 9\nKeyframe 1 \"float tangent\" [1 0] Translate 0 0 0 Keyframe 5 Translate 1 0 0 KeyframeEnd\nWorldBegin",
     "scene.dsc:2:12: error: the tangent has 2 numbers, but the transforms of this key have 3\n"
     "    2 | Keyframe 1 \"float tangent\" [1 0] Translate 0 0 0 Keyframe 5 Translate 1 0 0 KeyframeEnd\n"
     "      |            ^~~~~~~~~~~~~~~\n"
     "  it says for each of their numbers how it changes per frame, in their order\n"},
    {"LookAt 0 1 -5 \"bal\" 0 1 0\nCamera \"perspective\"\nWorldBegin DynamicBegin \"ball\" DynamicEnd",
     "scene.dsc:1:15: error: nothing to look at is named \"bal\"\n"
     "    1 | LookAt 0 1 -5 \"bal\" 0 1 0\n"
     "      |               ^~~~~\n"
     "  did you mean \"ball\"?\n"},
    {"WorldBegin\nDynamicBegin \"a\" LookAt 0 0 0 \"b\" 0 1 0 DynamicEnd DynamicBegin \"b\"\n"
     "LookAt 0 0 5 \"a\" 0 1 0 DynamicEnd",
     "scene.dsc:3:14: error: the place of \"a\" depends on LookAts that lead back to it, or on more than 3\n"
     "    3 | LookAt 0 0 5 \"a\" 0 1 0 DynamicEnd\n"
     "      |              ^~~\n"
     "  give one of them its eye and target in numbers\n"
     "scene.dsc:2:31: error: the place of \"b\" depends on LookAts that lead back to it, or on more than 3\n"
     "    2 | DynamicBegin \"a\" LookAt 0 0 0 \"b\" 0 1 0 DynamicEnd DynamicBegin \"b\"\n"
     "      |                               ^~~\n"
     "  give one of them its eye and target in numbers\n"},
    {"Frames 9\nKeyframe 1 KeyframeEnd\nKeyframe 2 KeyframeEnd\nWorldBegin",
     "scene.dsc:3:1: error: a second group of keys in this block\n"
     "    3 | Keyframe 2 KeyframeEnd\n"
     "      | ^~~~~~~~\n"
     "  AttributeBegin opens another block\n"},
    {"Frames 9\nKeyframe 1 Translate 0 1 0\nCamera \"perspective\"\nWorldBegin",
     "scene.dsc:3:1: error: only transforms are allowed between keys, not Camera\n"
     "    3 | Camera \"perspective\"\n"
     "      | ^~~~~~\n"
     "  KeyframeEnd is missing: the keys began on line 2\n"},
    {"Frames 9\nKeyframe 1 \"string ease\" \"bouncy\" KeyframeEnd\nWorldBegin",
     "scene.dsc:2:26: error: parameter \"ease\" of Keyframe cannot be \"bouncy\"\n"
     "    2 | Keyframe 1 \"string ease\" \"bouncy\" KeyframeEnd\n"
     "      |                          ^~~~~~~~\n"
     "  choices: linear, smooth, step, cubic\n"},
    {"KeyframeEnd\nWorldBegin",
     "scene.dsc:1:1: error: KeyframeEnd without Keyframe\n"
     "    1 | KeyframeEnd\n"
     "      | ^~~~~~~~~~~\n"},
    {"WorldBegin\nDynamicBegin \"a\"\nKeyframe 1\n",
     "scene.dsc:3:1: error: these keys are not closed\n"
     "    3 | Keyframe 1\n"
     "      | ^~~~~~~~\n"
     "  KeyframeEnd is missing\n"
     "scene.dsc:2:1: error: DynamicBegin \"a\" is not closed\n"
     "    2 | DynamicBegin \"a\"\n"
     "      | ^~~~~~~~~~~~\n"
     "  DynamicEnd is missing\n"},
    {"Frames 3\nKeyframe 1 Scale 1 1 1 Keyframe 3 Scale 1 1 -1 KeyframeEnd\nWorldBegin",
     "scene.dsc:2:1: error: the transform between these keys is singular at frame 2\n"
     "    2 | Keyframe 1 Scale 1 1 1 Keyframe 3 Scale 1 1 -1 KeyframeEnd\n"
     "      | ^~~~~~~~\n"},
    {"Frames 3\nWorldBegin\nDynamicBegin \"a\" \"integer frames\" [2 1] DynamicEnd",
     "scene.dsc:3:18: error: expected the first and the last frame, counted from 1\n"
     "    3 | DynamicBegin \"a\" \"integer frames\" [2 1] DynamicEnd\n"
     "      |                  ^~~~~~~~~~~~~~~~\n"},
};
INSTANTIATE_TEST_SUITE_P(Animation, Mistakes, testing::ValuesIn(kAnimation));

TEST(MistakesInARow, AreAllFoundUpToTwenty) {
  std::string text = "WorldBegin\n";
  for (int i = 0; i < 15; ++i) text += "Shape \"a\" \"float f\" oops\nTranslate 1\n";
  const Parsed parsed = parse(text);
  EXPECT_EQ(parsed.diagnostics.error_count(), 20);
  for (int i = 0; i < 20; ++i) EXPECT_EQ(parsed.diagnostics.all()[static_cast<std::size_t>(i)].where.line, i + 2);
}

TEST(OldPbrt, IsOneMessage) {
  const auto messages = [](const std::string& text) { return parse(text, {}, "old.pbrt").messages(); };
  EXPECT_EQ(
      messages("SurfaceIntegrator \"path\"\nNonsense"),
      "old.pbrt:1:1: error: this is a scene for pbrt-v1 or v2; dspm reads the formats of pbrt-v4 and v3, which do "
      "not know \"SurfaceIntegrator\"\n"
      "    1 | SurfaceIntegrator \"path\"\n"
      "      | ^~~~~~~~~~~~~~~~~\n"
      "  pbrt-v3's documentation explains how to convert it to v3\n");
}

TEST(OldPbrt, IsNotSuspectedWhereTheSceneIsCertainlyNew) {
  EXPECT_EQ(parse("Film \"rgb\"\nWorldBegin\nMaterial \"glass\"", {}, "new.pbrt").messages(), "");
  EXPECT_EQ(parse("Film \"rgb\"\nWorldBegin\nWorldEnd", {}, "new.pbrt").messages(),
            "new.pbrt:3:1: error: unknown directive WorldEnd\n"
            "    3 | WorldEnd\n"
            "      | ^~~~~~~~\n"
            "  pbrt-v4 no longer has this directive\n");
}

}  // namespace
}  // namespace dspm::test
