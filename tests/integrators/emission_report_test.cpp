// What pilot paths tell about lights of which it is known how many photons are found, and what the report says of it.
#include "dspm/integrators/emission_report.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "dspm/base/system/state_in_memory.h"
#include "dspm/integrators/statistics.h"
#include "dspm/session/job/job.h"
#include "dspm/session/stage.h"
#include "dspm/testing/test_scene.h"

namespace dspm {
namespace emission_report_test {

using test::TestScene;

/// What the scene's integrator knows before its first iteration.
std::vector<EmissionReport> reports(const std::string& text) {
  TestScene test(text);
  const auto scene = test.scene(test.all_frames());
  Job job = test.job();
  job.settings.count_found = job.settings.learn_at_once = true;
  Diagnostics diagnostics;
  const auto made = make_integrator(job, *scene, diagnostics);
  const Statistics statistics = made->statistics();
  return {statistics.emission.begin(), statistics.emission.end()};
}

/// Above a floor of which the camera sees the 2 x 2 around the origin; a photon is stored where it arrives first.
std::string floor_under(const std::string& lights, const std::string& integrator) {
  return fmt::format(R"(
Integrator {} "integer maxdepth" 1 "float radius" .3
LookAt 0 0 2  0 0 0  0 1 0
Camera "orthographic" "float screenwindow" [-1 1 -1 1]
Film "rgb" "integer xresolution" 16 "integer yresolution" 16
WorldBegin
{}
Shape "disk" "float radius" 20
)",
                     integrator, lights);
}

/// A narrow beam straight down: cones of one size have powers in proportion to the intensity.
std::string beam(const std::string& name, double x, double intensity, const std::string& words = "") {
  return fmt::format(
      "LightSource \"spot\" \"string name\" \"{0}\" \"rgb I\" [{2} {2} {2}] \"point3 from\" [{1} 0 1] "
      "\"point3 to\" [{1} 0 0] \"float coneangle\" 20 \"float conedeltaangle\" 5 {3}\n",
      name, x, intensity, words);
}

const EmissionReport::OfLight& of(const EmissionReport& report, const std::string& name) {
  for (const EmissionReport::OfLight& light : report.lights)
    if (light.name == name) return light;
  throw std::runtime_error("no light " + name);
}

constexpr const char* kByPower = R"("dsppm" "string direct" "photons" "string emission" "power")";
constexpr const char* kGuided = R"("dsppm" "string direct" "photons")";

// "seen" shines where the camera looks, "lost" beyond it. Counts are binomial.
TEST(EmissionReport, CountsWhatIsFound) {
  const auto all = reports(floor_under(beam("seen", 0, 1) + beam("lost", 9, 3), kByPower));
  ASSERT_EQ(all.size(), 1u);
  const EmissionReport& report = all.front();
  EXPECT_EQ(report.start, EmissionReport::Start::asked_by_power);
  EXPECT_EQ(report.photons, "photons");
  EXPECT_EQ(report.lights.front().name, "lost");
  EXPECT_NEAR(of(report, "seen").share, 0.25, 1e-6);
  EXPECT_NEAR(of(report, "lost").by_power, 0.75, 1e-6);
  const double paths = static_cast<double>(report.paths);
  EXPECT_NEAR(static_cast<double>(of(report, "seen").started), 0.25 * paths, 4 * std::sqrt(paths * 0.25 * 0.75));
  EXPECT_EQ(of(report, "seen").started + of(report, "lost").started, report.paths);
  EXPECT_EQ(of(report, "seen").found, of(report, "seen").started);
  EXPECT_EQ(of(report, "lost").found, 0u);
  EXPECT_EQ(report.found, of(report, "seen").found);
}

TEST(EmissionReport, TellsWhatPhotonsMultiply) {
  const auto all = reports(floor_under(beam("seen", 0, 1, "\"float photons\" 9") + beam("lost", 9, 3), kByPower));
  EXPECT_NEAR(of(all.front(), "seen").by_power, 0.25, 1e-6);
  EXPECT_NEAR(of(all.front(), "seen").share, 0.75, 1e-6);
}

// A quarter of the paths starts as without a guide; of "lost", nothing is learned.
TEST(EmissionReport, TellsWhatTheGuideDoes) {
  const auto all = reports(floor_under(beam("seen", 0, 1) + beam("lost", 9, 3), kGuided));
  const EmissionReport& report = all.front();
  EXPECT_EQ(report.start, EmissionReport::Start::guided);
  EXPECT_GE(report.rounds, 7u);
  EXPECT_GT(report.cells, 2u);
  EXPECT_GT(report.gain, 2);
  EXPECT_NEAR(of(report, "lost").share, 0.25 * 0.75, 1e-6);
  EXPECT_NEAR(of(report, "seen").share, 0.25 * 0.25 + 0.75, 1e-6);
  EXPECT_EQ(of(report, "seen").found, of(report, "seen").started);
}

// All is found: there is nothing to gain.
TEST(EmissionReport, TellsWhyThereIsNoGuide) {
  const auto all = reports(floor_under(beam("a", 0, 1) + beam("b", 0.1, 1), kGuided));
  const EmissionReport& report = all.front();
  EXPECT_EQ(report.start, EmissionReport::Start::guide_would_not_pay);
  EXPECT_EQ(report.found, report.paths);
  EXPECT_EQ(report.cells, 0u);
  EXPECT_LT(report.gain, 1.25);
  EXPECT_NEAR(of(report, "a").share, 0.5, 1e-6);
}

// What is learned of each light is multiplied by its "photons", and so is what starts without a guide: the shares are
// 1/4 q + 3/4 l with q and l in proportion to photons times power, and to photons times what is learned without them.
TEST(EmissionReport, PhotonsActOnTheGuide) {
  const auto shares = [](const std::string& words) {
    const auto all = reports(floor_under(beam("a", 0, 1, words) + beam("b", 0, 4) + beam("lost", 9, 15),
                                         R"("dsppm" "string direct" "photons" "integer photons" 300000)"));
    EXPECT_EQ(all.front().start, EmissionReport::Start::guided);
    return std::pair{of(all.front(), "a").share, of(all.front(), "b").share};
  };
  const auto [a, b] = shares("");
  const double learned_a = (a - 0.25 * 1 / 20) / 0.75, learned_b = (b - 0.25 * 4 / 20) / 0.75;
  EXPECT_NEAR(learned_a + learned_b, 1, 1e-6);
  const auto [more_a, less_b] = shares("\"float photons\" 6");
  const double weight = 6 * learned_a + learned_b;
  EXPECT_NEAR(more_a, 0.25 * 6 / 25 + 0.75 * 6 * learned_a / weight, 0.02);
  EXPECT_NEAR(less_b, 0.25 * 4 / 25 + 0.75 * learned_b / weight, 0.02);
}

// One in 40,000 of the sun's paths meets the ball. Rays bring its light to the ground, but pilot paths that follow this
// light come to where the ball is, and so does the run.
TEST(EmissionReport, FindsTheCausticOfASunOnOpenGround) {
  const auto all = reports(R"(
Integrator "dsppm"
LookAt 0 1.2 -4  0 .5 0  0 1 0
Camera "perspective" "float fov" 35
Film "rgb" "integer xresolution" 64 "integer yresolution" 48
WorldBegin
LightSource "infinite" "rgb L" [.6 .7 .9]
LightSource "distant" "string name" "sun" "rgb L" [3 3 3] "point3 from" [2 3 -2] "point3 to" [0 0 0]
AttributeBegin Rotate 90 1 0 0 Shape "disk" "float radius" 100 AttributeEnd
Material "dielectric" Translate .2 .5 0 Shape "sphere" "float radius" .5
)");
  const EmissionReport& report = all.front();
  EXPECT_GT(static_cast<double>(of(report, "sun").found), 0.02 * static_cast<double>(of(report, "sun").started));
}

TEST(EmissionReport, SumsUpManyLights) {
  std::string lights;
  for (int i = 1; i <= 30; ++i) lights += beam(std::to_string(i), 0, i);
  const EmissionReport report = reports(floor_under(lights, kByPower)).front();
  ASSERT_EQ(report.lights.size(), 9u);
  EXPECT_EQ(report.lights.front().name, "30");
  EXPECT_EQ(report.lights[7].name, "23");
  EXPECT_EQ(report.lights[8].name, "22 others");
  EXPECT_NEAR(report.lights[8].share, 22 * 23 / 2 / (30 * 31 / 2.), 1e-5);
  std::uint64_t started = 0;
  for (const EmissionReport::OfLight& light : report.lights) started += light.started;
  EXPECT_EQ(started, report.paths);
}

TEST(EmissionReport, SurvivesTheDark) {
  for (const char* integrator : {kByPower, "\"dsppm\"", "\"sppm\"", "\"photonmap\""}) {
    for (const EmissionReport& report : reports(floor_under("", integrator))) EXPECT_EQ(report.found, 0u);
    for (const EmissionReport& report : reports(floor_under(beam("off", 0, 0), integrator)))
      EXPECT_EQ(report.lights.front().started, 0u);
  }
  EXPECT_TRUE(reports("Integrator \"path\"\nWorldBegin\n" + beam("a", 0, 1) + "Shape \"disk\"").empty());
}

// A final gather finds photons that no hit point does.
TEST(EmissionReport, OnePerKindOfPhotons) {
  const std::string light = beam("a", 0, 1);
  std::string kinds;
  for (const EmissionReport& report : reports(floor_under(light, R"("photonmap" "integer photons" 5000)")))
    kinds += report.photons + ";";
  EXPECT_EQ(kinds, "photons;caustic photons;");
  for (const char* emission : {"guided", "power"}) {
    const auto all = reports(
        floor_under(light, fmt::format(R"("photonmap" "integer finalgather" 4 "string emission" "{}")", emission)));
    ASSERT_EQ(all.size(), 1u);
    EXPECT_EQ(all.front().photons, "caustic photons");
  }
}

EmissionReport example(EmissionReport::Start start) {
  EmissionReport report;
  report.photons = "photons", report.start = start;
  report.rounds = 14, report.paths = 30000, report.found_without = 90, report.found = 12000, report.cells = 900;
  report.gain = 4;
  report.lights = {{"sun", .5, .25, 7500, 3000}, {"2 others", .5, .75, 0, 0}};
  return report;
}
EmissionReport of_caustics() {
  EmissionReport report = example(EmissionReport::Start::guided);
  report.bring = PhotonsBring::caustics, report.traced = 5000;
  return report;
}

TEST(EmissionReport, IsTheSameAfterSavingAndLoading) {
  Statistics saved, loaded;
  saved.emission.put(example(EmissionReport::Start::guided));
  EmissionReport other = of_caustics();
  other.photons = "caustic photons";
  saved.emission.put(other);
  loaded.emission.put(example(EmissionReport::Start::asked_by_power));
  const std::string bytes = state_of(saved);
  LoadedState state(bytes);
  loaded.persist(state);
  EXPECT_TRUE(state.all_read());
  EXPECT_EQ(state_of(loaded), bytes);
  std::string names;
  for (const EmissionReport& report : loaded.emission) names += report.photons + ";";
  EXPECT_EQ(names, "photons;caustic photons;");
}

TEST(EmissionReport, RefusesDamagedRecords) {
  EmissionReports saved;
  saved.put(of_caustics());
  const std::string bytes = state_of(saved);
  int refused = 0;
  for (std::size_t byte = 0; byte < bytes.size(); ++byte) {
    std::string damaged = bytes;
    damaged[byte] = static_cast<char>(damaged[byte] ^ 0x81);
    EmissionReports loaded;
    LoadedState state(damaged);
    try {
      loaded.persist(state);
    } catch (const std::runtime_error&) {
      ++refused;
    }
  }
  EXPECT_GE(refused, 5 * 8);  // five counts and a choice
}

TEST(EmissionReport, SaysWhatPhotonsBring) {
  EmissionReport report = of_caustics();
  EXPECT_EQ(
      in_words(report).at(1),
      "photons: 5000 paths an iteration bring caustics, and camera paths find all other light, with less noise in "
      "the same time.");
  EXPECT_NE(
      summary_of(report).find("; 5000 an iteration bring caustics, and camera paths find all other light; by light:"),
      std::string::npos);
  report.bring = PhotonsBring::all;
  EXPECT_EQ(in_words(report).at(1),
            "photons: 5000 paths an iteration bring all light, with less noise in the same time.");
  EXPECT_NE(summary_of(report).find("; 5000 are traced an iteration; by light:"), std::string::npos);
  report.bring = PhotonsBring::nothing, report.traced = 0;
  EXPECT_EQ(in_words(report),
            (std::vector<std::string>{"photons: none are traced, as camera paths find all light, with "
                                      "less noise in the same time."}));
  EXPECT_EQ(summary_of(report), "photons: none are traced, as camera paths find all light");
}

TEST(EmissionReport, SaysItInWords) {
  EmissionReport guided = example(EmissionReport::Start::guided);
  EXPECT_EQ(in_words(guided), (std::vector<std::string>{
                                  "photons: start where a guide says, learned in 14 rounds of 30000 pilot paths: 40% "
                                  "of a round's are found by hit points, 0.30% without it.",
                                  "photons of sun: 25% of the paths, 50% by power; found: 40%.",
                                  "photons of 2 others: 75% of the paths, 50% by power; found: none of them a pilot "
                                  "path."}));
  guided.found_without = 150;
  EXPECT_NE(in_words(guided).front().find("The same variance takes 0.25 of the time."), std::string::npos);
  EXPECT_EQ(summary_of(guided),
            "photons: 40% of the paths are found by hit points, 0.50% without a guide; by light: sun "
            "40%");
  EmissionReport off = example(EmissionReport::Start::guide_would_not_pay);
  off.gain = 1.25 / 1.1;
  EXPECT_EQ(
      in_words(off).front(),
      "photons: start by the lights' power times \"photons\", as a guide does not pay: the same variance would take "
      "0.88 of the time, and 0.8 is the most that is worth it. 40% of 30000 pilot paths are found by hit points.");
  off.gain = std::nan("");
  EXPECT_NE(in_words(off).front().find("as there is nothing to learn from"), std::string::npos);
  EmissionReport by_power = example(EmissionReport::Start::asked_by_power);
  by_power.lights.clear();
  EXPECT_EQ(in_words(by_power).front(),
            "photons: start by the lights' power, as \"string emission\" \"power\" says. 40% of 30000 pilot paths are "
            "found by hit points.");
}

}  // namespace emission_report_test
}  // namespace dspm
