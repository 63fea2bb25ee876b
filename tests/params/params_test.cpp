#include "dspm/base/params/params.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "dspm/base/math/moments.h"
#include "dspm/base/params/registry.h"

namespace dspm {
namespace {

Param param(ParamType type, std::string name, Param::Values values, int key = 0) {
  return {type, std::move(name), key == 0 ? std::nullopt : std::optional(Moment::numbered(key)), std::move(values), {},
          {}};
}
Param number(std::string name, float value, int key = 0) {
  return param(ParamType::number, std::move(name), std::vector<float>{value}, key);
}
Param text(std::string name, std::string value, int key = 0) {
  return param(ParamType::text, std::move(name), std::vector<std::string>{std::move(value)}, key);
}

float number_at(const ParamList& list, std::string_view name, double frames) {
  return numbers_of(*list.at(Moment(frames)).find(name)).front();
}
std::string text_at(const ParamList& list, std::string_view name, double frames) {
  return std::get<std::vector<std::string>>(list.at(Moment(frames)).find(name)->values).front();
}

/// A reader over `list` and the first message it causes.
struct Reading {
  explicit Reading(std::vector<Param> params, bool lenient = false, std::filesystem::path main_directory = {})
      : list{std::move(params)},
        diagnostics(lenient),
        reader(list, "material \"diffuse\"", {}, diagnostics, std::move(main_directory)) {}

  std::string message() const { return diagnostics.all().empty() ? "" : diagnostics.all().front().message; }
  std::string hint() const { return diagnostics.all().empty() ? "" : diagnostics.all().front().hint; }

  ParamList list;
  Diagnostics diagnostics;
  ParamReader reader;
};

TEST(ParamType, WordsGoBothWays) {
  for (const ParamType type : {ParamType::boolean, ParamType::number, ParamType::normal, ParamType::texture})
    EXPECT_EQ(param_type(word_of(type)), type);
  EXPECT_EQ(word_of(ParamType::number), "float");
  EXPECT_EQ(word_of(ParamType::texture), "texture");
  EXPECT_FALSE(param_type("colour"));
}

TEST(ParamList, NumbersAreInterpolatedBetweenKeysAndHeldOutside) {
  const ParamList list{{number("scale", 10, 3), number("scale", 20, 7), number("fixed", 5)}};
  EXPECT_TRUE(list.is_keyed());
  EXPECT_EQ(number_at(list, "scale", 0), 10);
  EXPECT_EQ(number_at(list, "scale", 2), 10);  // moment 2 counts from 0, key 3 from 1
  EXPECT_EQ(number_at(list, "scale", 3), 12.5f);
  EXPECT_EQ(number_at(list, "scale", 6), 20);
  EXPECT_EQ(number_at(list, "scale", 60), 20);
  EXPECT_EQ(number_at(list, "fixed", 6), 5);
  EXPECT_FALSE(list.at(Moment(4)).is_keyed());
}

TEST(ParamList, HasTimesBetweenWholeFrames) {
  Param between = number("scale", 30);
  between.key = Moment(6.5);
  const ParamList list{{number("scale", 10, 3), number("scale", 20, 7), between, text("mapping", "uv", 1),
                        text("mapping", "planar", 3), text("filename", "w%d.ply")}};
  EXPECT_EQ(number_at(list, "scale", 1.5), 10);
  EXPECT_EQ(number_at(list, "scale", 2.5), 11.25f);
  EXPECT_EQ(number_at(list, "scale", 4.5), 16.25f);
  EXPECT_EQ(number_at(list, "scale", 6.25), 25);
  EXPECT_EQ(number_at(list, "scale", 6.5), 30);
  EXPECT_EQ(text_at(list, "mapping", 1.5), "uv");
  EXPECT_EQ(text_at(list, "mapping", 2.5), "planar");
  EXPECT_EQ(text_at(list, "filename", 2.5), "w3.ply") << "the file holds until the next frame";
}

TEST(ParamList, KeysMayStandInAnyOrderAndIntegersAreRounded) {
  const ParamList list{
      {param(ParamType::integer, "n", std::vector<int>{8}, 5), param(ParamType::integer, "n", std::vector<int>{1}, 1)}};
  EXPECT_EQ(number_at(list, "n", 0), 1);
  EXPECT_EQ(number_at(list, "n", 1), 3);  // 2.75
  EXPECT_EQ(number_at(list, "n", 4), 8);
}

TEST(ParamList, WhatIsNoNumberHoldsUntilTheNextKey) {
  const ParamList list{{text("mapping", "uv", 2), text("mapping", "planar", 4)}};
  EXPECT_EQ(text_at(list, "mapping", 0), "uv");
  EXPECT_EQ(text_at(list, "mapping", 2), "uv");
  EXPECT_EQ(text_at(list, "mapping", 3), "planar");
}

TEST(ParamList, KeysOfDifferentKindHold) {
  const ParamList list{{param(ParamType::rgb, "L", std::vector<float>{1, 1, 1}, 1),
                        param(ParamType::blackbody, "L", std::vector<float>{6500}, 3)}};
  EXPECT_EQ(list.at(Moment(1)).find("L")->type, ParamType::rgb);
  EXPECT_EQ(list.at(Moment(2)).find("L")->type, ParamType::blackbody);
}

TEST(ParamList, FileNamesAreNumberedAsTheFrames) {
  const ParamList list{{text("filename", "water.%03d.ply"), text("other", "%03d")}};
  EXPECT_TRUE(list.is_keyed());
  EXPECT_EQ(text_at(list, "filename", 0), "water.001.ply");
  EXPECT_EQ(text_at(list, "filename", 24), "water.025.ply");
  EXPECT_EQ(text_at(list, "other", 24), "%03d");

  const ParamList shifted{{text("filename", "w%d.ply"), param(ParamType::integer, "first", std::vector<int>{0})}};
  EXPECT_EQ(text_at(shifted, "filename", 11), "w11.ply");
  EXPECT_EQ(shifted.at(Moment(0)).find("first"), nullptr);

  const auto stepped = [](int first, int step) {
    return ParamList{{text("filename", "w%02d.ply"), param(ParamType::integer, "step", std::vector<int>{step}),
                      param(ParamType::integer, "first", std::vector<int>{first})}};
  };
  EXPECT_EQ(text_at(stepped(0, 24), "filename", 0), "w00.ply");
  EXPECT_EQ(text_at(stepped(0, 24), "filename", 3), "w72.ply");
  EXPECT_EQ(text_at(stepped(9, -2), "filename", 3), "w03.ply");
  EXPECT_EQ(text_at(stepped(1, 2000000000), "filename", 2), "w4000000001.ply");
  EXPECT_EQ(stepped(0, 24).at(Moment(0)).params.size(), 1u);

  for (const char* plain : {"water.ply", "100%.ply", "%s.ply", "%3d.ply", "%"})
    EXPECT_FALSE((ParamList{{text("filename", plain)}}.is_keyed())) << plain;
}

TEST(ParamList, SameValuesIgnoresPlaceAndOrder) {
  const ParamList a{{number("x", 1), text("y", "t")}};
  ParamList b{{text("y", "t"), number("x", 1)}};
  b.params[0].where.line = 7;
  EXPECT_TRUE(a.same_values(b));
  b.params[1] = number("x", 2);
  EXPECT_FALSE(a.same_values(b));
  EXPECT_FALSE(a.same_values(ParamList{{number("x", 1)}}));
}

TEST(ParamReader, ReadsWhatIsGivenAndElseTheDefault) {
  Reading r({number("fov", 38), param(ParamType::integer, "radius", std::vector<int>{2}),
             param(ParamType::boolean, "twosided", std::vector<bool>{true}),
             param(ParamType::point3, "from", std::vector<float>{1, 2, 3}),
             param(ParamType::point3, "P", std::vector<float>{0, 0, 0, 1, 1, 1})});
  EXPECT_EQ(r.reader.number("fov", 90, "deg", ""), 38);
  EXPECT_EQ(r.reader.number("radius", 1, "", ""), 2);  // an integer will do for a float
  EXPECT_TRUE(r.reader.flag("twosided", false, ""));
  EXPECT_EQ(r.reader.point("from", {}, "", ""), (Vec3{1, 2, 3}));
  EXPECT_EQ(r.reader.points3("P", ""), (std::vector<Vec3>{{0, 0, 0}, {1, 1, 1}}));
  EXPECT_EQ(r.reader.integer("maxdepth", 5, "", ""), 5);
  EXPECT_EQ(r.reader.vector("v1", {1, 0, 0}, "", ""), (Vec3{1, 0, 0}));
  r.reader.finish();
  EXPECT_EQ(r.message(), "");
}

TEST(ParamReader, UnknownParametersAreErrorsThatShowTheWay) {
  Reading r({param(ParamType::rgb, "reflectence", std::vector<float>{.7f, .68f, .65f})});
  r.reader.rgb_or_texture("reflectance", Rgb(.5f), SpectrumRole::albedo, "");
  r.reader.finish();
  EXPECT_EQ(r.message(), "unknown parameter \"reflectence\" of material \"diffuse\"");
  EXPECT_EQ(r.hint(), "did you mean \"reflectance\"? (dspm --describe material:diffuse lists them all)");
  EXPECT_EQ(r.diagnostics.error_count(), 1);
}

TEST(ParamReader, WrongTypesCountsAndValuesAreErrors) {
  {
    Reading r({text("fov", "wide")});
    EXPECT_EQ(r.reader.number("fov", 90, "", ""), 90);
    EXPECT_EQ(r.message(), "parameter \"fov\" of material \"diffuse\" must be float, not string");
  }
  {
    Reading r({number("n", 1.5f)});
    EXPECT_EQ(r.reader.integer("n", 4, "", ""), 4);
    EXPECT_EQ(r.message(), "parameter \"n\" of material \"diffuse\" must be integer, not float");
  }
  {
    Reading r({param(ParamType::number, "fov", std::vector<float>{1, 2, 3})});
    r.reader.number("fov", 90, "", "");
    EXPECT_EQ(r.message(), "parameter \"fov\" of material \"diffuse\" takes 1 value, got 3");
  }
  {
    Reading r({param(ParamType::point3, "P", std::vector<float>{1, 2, 3, 4})});
    EXPECT_TRUE(r.reader.points3("P", "").empty());
    EXPECT_EQ(r.message(), "parameter \"P\" of material \"diffuse\" takes groups of 3 values, got 4");
  }
  {
    Reading r({param(ParamType::text, "mapping", std::vector<float>{1})});
    EXPECT_EQ(r.reader.text("mapping", "uv", ""), "uv");
    EXPECT_EQ(r.diagnostics.error_count(), 1);
  }
  {
    Reading r({text("mapping", "plannar")});
    EXPECT_EQ(r.reader.choice("mapping", "uv", {"uv", "planar"}, ""), "uv");
    EXPECT_EQ(r.message(), "parameter \"mapping\" of material \"diffuse\" cannot be \"plannar\"");
    EXPECT_EQ(r.hint(), "did you mean \"planar\"? choices: uv, planar");
  }
}

TEST(ParamReader, DuplicatesAreErrorsThroughAliasesToo) {
  Reading r({number("photons", 1), number("photonsperiteration", 2)});
  r.reader.alias("photonsperiteration", "photons");
  EXPECT_EQ(r.reader.number("photons", 0, "", ""), 1);
  r.reader.finish();
  EXPECT_EQ(r.message(), "parameter \"photonsperiteration\" of material \"diffuse\" is given twice");

  Reading alone({number("photonsperiteration", 2)});
  alone.reader.alias("photonsperiteration", "photons");
  EXPECT_EQ(alone.reader.number("photons", 0, "", ""), 2);
  alone.reader.finish();
  EXPECT_EQ(alone.message(), "");
}

TEST(ParamReader, UnsupportedIsAnErrorOrLenientlyAWarning) {
  for (const bool lenient : {false, true}) {
    Reading r({text("normalmap", "n.png")}, lenient);
    r.reader.unsupported("normalmap", "normal maps");
    r.reader.unsupported("displacement", "displacement");  // not given: nothing to say
    r.reader.finish();
    EXPECT_EQ(r.diagnostics.all().size(), 1u);
    EXPECT_EQ(r.diagnostics.error_count(), lenient ? 0 : 1);
  }
}

TEST(ParamReader, ColoursInTheirForms) {
  const auto read = [](Param p, SpectrumRole role) {
    Reading r({std::move(p)});
    const Rgb value = r.reader.rgb("c", Rgb(.5f), role, "");
    return std::pair(value, r.message());
  };
  const auto rgb = [](float r, float g, float b) { return param(ParamType::rgb, "c", std::vector<float>{r, g, b}); };
  const std::string who = "parameter \"c\" of material \"diffuse\" ";

  EXPECT_EQ(read(rgb(.1f, .2f, .3f), SpectrumRole::albedo).first, Rgb(.1f, .2f, .3f));
  EXPECT_EQ(read(rgb(40, 38, 34), SpectrumRole::illuminant).first, Rgb(40, 38, 34));
  EXPECT_EQ(read(rgb(40, 38, 34), SpectrumRole::albedo).second, who + "must lie in 0..1");
  EXPECT_EQ(read(rgb(-1, 0, 0), SpectrumRole::illuminant).second, who + "must not be negative");
  EXPECT_EQ(read(number("c", 1.5f), SpectrumRole::unbounded).first, Rgb(1.5f));
  EXPECT_EQ(read(number("c", .5f), SpectrumRole::albedo).first, Rgb(.5f));
  EXPECT_EQ(read(number("c", 40), SpectrumRole::illuminant).first, Rgb(40));
  EXPECT_EQ(read(number("c", 40), SpectrumRole::albedo).second, who + "must lie in 0..1");
  EXPECT_EQ(read(param(ParamType::boolean, "c", std::vector<bool>{true}), SpectrumRole::albedo).second,
            who + "must be float, rgb, spectrum or blackbody, not bool");
  EXPECT_NEAR(
      luminance(read(param(ParamType::blackbody, "c", std::vector<float>{4000}), SpectrumRole::illuminant).first), 1,
      1e-5);
  EXPECT_EQ(read(param(ParamType::blackbody, "c", std::vector<float>{0}), SpectrumRole::illuminant).second,
            who + "must be a temperature above 0 K");

  const auto pairs = [](std::vector<float> v) { return param(ParamType::spectrum, "c", std::move(v)); };
  const Rgb constant = read(pairs({300, .25f, 900, .25f}), SpectrumRole::albedo).first;
  EXPECT_NEAR(constant.r, .25f, 1e-6);
  EXPECT_NEAR(constant.b, .25f, 1e-6);
  EXPECT_EQ(read(pairs({400, 1, 500}), SpectrumRole::albedo).second,
            who + "takes pairs of wavelength (nm) and value, got 3 numbers");
  EXPECT_EQ(read(pairs({500, 1, 400, 1}), SpectrumRole::albedo).second,
            who + "needs ascending wavelengths, got 400 after 500");

  const auto named = [](std::string name) {
    return param(ParamType::spectrum, "c", std::vector<std::string>{std::move(name)});
  };
  EXPECT_EQ(read(named("metal-Au-k"), SpectrumRole::unbounded).first,
            to_rgb(*named_spectrum("metal-Au-k"), SpectrumRole::unbounded));
  EXPECT_EQ(read(named("metal-Ag-etta"), SpectrumRole::unbounded).second,
            "unknown spectrum \"metal-Ag-etta\", and no file has that name");
}

TEST(ParamReader, TexturesAndNamedDefaults) {
  Reading r({param(ParamType::texture, "reflectance", std::vector<std::string>{"wood"}),
             param(ParamType::texture, "roughness", std::vector<std::string>{"rough"})});
  EXPECT_EQ(r.reader.rgb_or_texture("reflectance", Rgb(.5f), SpectrumRole::albedo, "").texture, "wood");
  EXPECT_EQ(r.reader.number_or_texture("roughness", 0, "", "").texture, "rough");
  const auto eta = r.reader.rgb_or_texture("eta", "metal-Cu-eta", SpectrumRole::unbounded, "");
  EXPECT_EQ(eta.texture, "");
  EXPECT_EQ(eta.value, to_rgb(*named_spectrum("metal-Cu-eta"), SpectrumRole::unbounded));
}

class ParamFiles : public testing::Test {
 protected:
  void SetUp() override {
    std::filesystem::create_directories(directory / "parts");
    std::ofstream(directory / "parts" / "here.txt") << "300 .5 # nm, value\n 900 .5\n";
    std::ofstream(directory / "main.txt") << "300 x";
  }
  void TearDown() override { std::filesystem::remove_all(directory); }
  Param naming(ParamType type, const std::string& name, const std::string& value) {
    Param p = param(type, name, std::vector<std::string>{value});
    p.where.file = &source;
    return p;
  }

  const std::filesystem::path directory = std::filesystem::path(testing::TempDir()) / "dspm_param_files";
  const SourceFile source{(directory / "parts" / "include.dsc").string(), ""};
};

TEST_F(ParamFiles, AreFoundBesideTheNamingFileElseBesideTheMainFile) {
  Reading r({naming(ParamType::text, "a", "here.txt"), naming(ParamType::text, "b", "main.txt"),
             naming(ParamType::text, "c", "nowhere.txt"), naming(ParamType::text, "g", "wave.####.ply"),
             naming(ParamType::text, "d", (directory / "main.txt").string())},
            false, directory);
  EXPECT_EQ(Reading({naming(ParamType::text, "h", "")}, false, directory).reader.optional_file("h", ""), "");
  EXPECT_EQ(r.reader.file("a", ""), directory / "parts" / "here.txt");
  EXPECT_EQ(r.reader.file("b", ""), directory / "main.txt");
  EXPECT_EQ(r.reader.file("d", ""), directory / "main.txt");
  EXPECT_EQ(r.reader.optional_file("e", ""), "");
  EXPECT_EQ(r.message(), "");
  EXPECT_EQ(r.reader.file("c", ""), "");
  EXPECT_EQ(r.message(), "there is no file \"nowhere.txt\"");
  EXPECT_EQ(r.reader.file("g", ""), "");
  EXPECT_NE(r.diagnostics.all().back().hint.find("\"wave.%04d.ply\""), std::string::npos);
  EXPECT_EQ(r.reader.file("f", ""), "");
  EXPECT_EQ(r.diagnostics.all().back().message, "material \"diffuse\" needs a file: \"string f\"");
}

TEST_F(ParamFiles, HoldSpectra) {
  Reading r({naming(ParamType::spectrum, "a", "here.txt"), naming(ParamType::spectrum, "b", "main.txt")}, false,
            directory);
  EXPECT_NEAR(r.reader.rgb("a", Rgb(0), SpectrumRole::albedo, "").g, .5f, 1e-6);
  EXPECT_EQ(r.message(), "");
  r.reader.rgb("b", Rgb(0), SpectrumRole::albedo, "");
  EXPECT_EQ(r.diagnostics.error_count(), 1);
}

// A plugin table as every folder has one.
struct Thing {
  float size;
};
using MakeThing = std::unique_ptr<Thing>(ParamReader&, int);
std::unique_ptr<Thing> make_box(ParamReader& reader, int) {
  const float size = reader.number("size", 1.5f, "m", "edge length");
  reader.rgb("eta", "metal-Cu-eta", SpectrumRole::unbounded, "index of refraction");
  reader.choice("kind", "open", {"open", "closed"}, "lid");
  reader.finish();
  ADD_FAILURE_AT(__FILE__, __LINE__) << "finish() did not end the description";
  return std::make_unique<Thing>(Thing{size});
}
std::unique_ptr<Thing> make_ball(ParamReader& reader, int) {
  const float size = reader.number("radius", 1, "m", "radius");
  reader.finish();
  return std::make_unique<Thing>(Thing{size});
}
using Things = PluginTable<Plugin<MakeThing>>;
const Things kThings("thing", {{"box", "a box", make_box}, {"ball", "a ball", make_ball}}, {"teapot"});

TEST(Registry, FindsOrListsWhatThereIs) {
  Diagnostics diagnostics(true);
  ASSERT_NE(kThings.find("ball", {}, diagnostics), nullptr);
  EXPECT_EQ(kThings.find("ball"), kThings.find("ball", {}, diagnostics));
  EXPECT_EQ(kThings.find("bal", {}, diagnostics), nullptr);
  EXPECT_EQ(diagnostics.all().back().message, "unknown thing \"bal\"");
  EXPECT_EQ(diagnostics.all().back().hint, "did you mean \"ball\"? available: box, ball");
  EXPECT_EQ(kThings.find("teapot", {}, diagnostics), nullptr);
  EXPECT_EQ(diagnostics.all().back().message, "thing \"teapot\" is not supported by dspm");
  EXPECT_EQ(diagnostics.error_count(), 1);
}

TEST(Registry, PluginsDescribeTheirParameters) {
  const std::vector<ParamInfo> described = describe(kThings.front(), 0);
  ASSERT_EQ(described.size(), 3u);
  EXPECT_EQ(described[0].type, "float");
  EXPECT_EQ(described[0].name, "size");
  EXPECT_EQ(described[0].default_value, "1.5");
  EXPECT_EQ(described[0].unit, "m");
  EXPECT_EQ(described[0].sentence, "edge length");
  EXPECT_EQ(described[1].type, "float, rgb, spectrum or blackbody");
  EXPECT_EQ(described[1].default_value, "\"metal-Cu-eta\"");
  EXPECT_EQ(described[2].sentence, "lid (open, closed)");
}

}  // namespace
}  // namespace dspm
