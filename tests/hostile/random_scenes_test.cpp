// Scenes at random from the plugins' own descriptions render without crash, without a value that is no number and
// without more light than there is. DSPM_RANDOM_SCENES says how many (default 30), DSPM_FIRST_SCENE which is the first.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <map>
#include <regex>
#include <set>

#include "dspm/base/math/moments.h"
#include "dspm/lang/parse.h"
#include "dspm/session/job/job.h"
#include "dspm/testing/test_scene.h"
#include "dspm/world/world.h"
#include "tests/hostile/described_scene.h"

namespace dspm::test {
namespace {

int number_from(const char* variable, int usual) {
  const char* const text = std::getenv(variable);
  return text != nullptr ? std::atoi(text) : usual;
}

/// The lines at which the scene is wrong; -1: at none of its lines.
std::vector<int> wrong_lines(const std::string& text, std::string& messages) {
  Diagnostics diagnostics;
  const SceneDescription description = parse_text("random.dsc", text, {}, diagnostics);
  if (diagnostics.error_count() == 0) {
    const Job job = make_job(description, {}, diagnostics);
    const World world(description, {job.film.width, job.film.height, "", true}, diagnostics);
  }
  std::vector<int> lines;
  for (const Diagnostic& each : diagnostics.all()) {
    if (each.severity != Severity::error) continue;
    messages += to_string(each);
    lines.push_back(each.where.file != nullptr && each.where.line > 0 ? each.where.line : -1);
  }
  std::sort(lines.rbegin(), lines.rend());
  lines.erase(std::unique(lines.begin(), lines.end()), lines.end());
  return lines;
}

/// Without what its plugins refuse.
std::string mended(DescribedScene& scene) {
  constexpr int kRounds = 200;
  std::string messages;
  for (int round = 0; round < kRounds; ++round) {
    messages.clear();
    const std::vector<int> lines = wrong_lines(scene.text(), messages);
    if (lines.empty()) return scene.text();
    bool any = false;
    for (const int line : lines) any = scene.take_out(line) || any;
    if (!any) break;
  }
  ADD_FAILURE() << "what is refused cannot be taken out:\n" << messages << scene.text();
  return {};
}

struct Seen {
  double mean = 0;
  std::uint64_t rejected = 0;  // contributions that were not finite
};

enum class Colours { rgb, spectral };

/// Some iterations of all frames. Spectral ones may be negative.
Seen render(const std::string& text, int iterations = 2, Colours colours = Colours::rgb) {
  TestScene scene(text, "random.dsc");
  Seen seen;
  std::size_t pixels = 0;
  for (const std::vector<FileFrame>& interval : scene.intervals()) {
    const auto part = scene.scene(interval);
    const bool spectral = colours == Colours::spectral;
    const auto show = [&](int iteration) {
      if (spectral) part->set_palette(Palette::of_iteration(1, static_cast<std::uint64_t>(iteration)));
    };
    show(0);
    const auto integrator = scene.integrator(*part);
    for (int iteration = 0; iteration < iterations; ++iteration) {
      show(iteration);
      integrator->iterate({iteration, *part});
    }
    const Statistics statistics = integrator->statistics();
    seen.rejected += statistics.rejections.count();
    for (const Rejections::Entry& entry : statistics.rejections.entries())
      ADD_FAILURE() << fmt::format("not finite: element {} of kind {}, frame {}, pixel {}", entry.element.index,
                                   static_cast<int>(entry.element.kind), entry.frame, entry.pixel);
    for (const EnergyBalance& e : statistics.energy)
      EXPECT_NEAR(e.absorbed + e.escaped + e.terminated + e.roulette, e.emitted, 1e-3 * e.emitted);
    for (std::size_t frame = 0; frame < interval.size(); ++frame)
      for (const Rgb& pixel : integrator->estimate(static_cast<Frame>(frame)).pixels) {
        EXPECT_TRUE(is_finite(pixel) && (spectral || (pixel.r >= 0 && pixel.g >= 0 && pixel.b >= 0)))
            << fmt::format("{} {} {} in frame {}", pixel.r, pixel.g, pixel.b, interval[frame].index() + 1);
        seen.mean += luminance(pixel), ++pixels;
      }
  }
  seen.mean /= static_cast<double>(pixels);
  return seen;
}

/// Up to the first failure.
template <class Check>
void for_each_scene(DescribedScene::Light light, const Check& check) {
  const unsigned first = static_cast<unsigned>(number_from("DSPM_FIRST_SCENE", 1));
  const unsigned count = static_cast<unsigned>(number_from("DSPM_RANDOM_SCENES", 30));
  for (unsigned seed = first; seed < first + count && !testing::Test::HasFailure(); ++seed) {
    DescribedScene scene(seed, light);
    const std::string text = mended(scene);
    SCOPED_TRACE(fmt::format("DSPM_FIRST_SCENE={}\n{}", seed, text));
    if (text.empty()) continue;
    const Seen seen = render(text);
    EXPECT_EQ(seen.rejected, 0u);
    check(text, seen);
  }
}

TEST(RandomScenes, Render) {
  for_each_scene(DescribedScene::Light::any, [](const std::string& text, const Seen&) {
    EXPECT_EQ(render(text, 2, Colours::spectral).rejected, 0u);
  });
}

std::string with_many_photons(const std::string& text) {
  return std::regex_replace(text, std::regex("photons\" \\d+"), "photons\" 3000");
}

// Where radiance 1 comes from everywhere and nothing else shines, no pixel expects more than 1, but in glass: through a
// shape that is not closed light gets out that never got in, with eta^2 times the radiance. A scene's mean over two
// iterations of few photons wanders; that over many must not, nor that of all scenes,
// however few of them outshine the others.
TEST(RandomScenes, GainNoEnergy) {
  double sum = 0;
  int count = 0;
  for_each_scene(DescribedScene::Light::furnace, [&](const std::string& text, const Seen& seen) {
    if (seen.mean > 1.02 && text.find("\"dielectric\"") == text.npos) {
      EXPECT_LT(render(with_many_photons(text), 200).mean, 1.02);
    }
    sum += std::min(seen.mean, 2.), ++count;
  });
  if (count >= 200) {
    EXPECT_LT(sum / count, 1.02);
  }
}

// What a scene never holds, it does not test.
TEST(RandomScenes, HoldEveryPlugin) {
  std::set<std::string> missing;
  for (const CatalogueEntry& entry : all_plugins()) missing.insert(entry.kind + ":" + entry.name);
  missing.erase("medium:nanovdb");  // tests/media/nanovdb writes its files
  for (unsigned seed = 1; seed <= 300 && !missing.empty(); ++seed) {
    DescribedScene scene(seed);
    const std::vector<std::string> drawn = scene.plugins();
    if (std::none_of(drawn.begin(), drawn.end(), [&](const auto& name) { return missing.contains(name); })) continue;
    mended(scene);
    for (const std::string& name : scene.plugins()) missing.erase(name);
  }
  EXPECT_EQ(missing, std::set<std::string>());
}

}  // namespace
}  // namespace dspm::test
