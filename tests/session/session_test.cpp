// A render from C++, without a command line.
#include "dspm/session/session.h"

#include <gtest/gtest.h>

#include <functional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "dspm/base/system/cancellation.h"
#include "dspm/image/image.h"
#include "dspm/testing/test_scene.h"
#include "tests/support/idle_integrator.h"

namespace dspm::test {
namespace session_test {

/// Takes a few iterations, of which one may end otherwise.
class Stumbling : public IdleIntegrator {
 public:
  static inline std::function<void()> stumble;
  static inline std::size_t bytes = 100, state_bytes = 0;  // that it says it holds; of its state
  static inline int stumbles_after = 3;                    // iterations

  int iterations() const override { return 6; }
  void iterate(const Iteration& iteration) override {
    ++done_;
    if (iteration.number == stumbles_after && stumble) stumble();
  }
  bool persist(StateStream& state) override {
    state.value(done_);
    state.value(state_);
    return true;
  }
  Statistics statistics() const override {
    Statistics statistics;
    statistics.iterations = done_, statistics.bytes = bytes;
    return statistics;
  }

 private:
  int done_ = 0;
  std::vector<char> state_ = std::vector<char>(state_bytes);
};

std::unique_ptr<Integrator> make_stumbling(ParamReader& params, const Scene&, const RenderSettings&) {
  params.finish();
  return std::make_unique<Stumbling>();
}

struct Silent final : Messages {
  Silent() : Messages(true) {}
  void print(std::string_view) const override {}
};

/// Notes what happens, in order: "2" after an iteration, "i2", "f2" and "l2" for images so far, those after a failure,
/// and the last ones.
class Notes : public SessionObserver {
 public:
  void iteration_done(const IntervalProgress& progress, Integrator&) override { note("", progress.iterations); }
  void images_due(const IntervalProgress& progress, Integrator& integrator, Images which) override {
    note(which == Images::last ? "l" : which == Images::so_far ? "i" : "f", progress.iterations);
    if (which == Images::last) on_last(integrator);
  }
  void iteration_failed() override { text += "failed "; }
  bool end_wanted() const override { return ends_after > 0 && iterations >= ends_after; }

  std::string text;
  int iterations = 0, ends_after = 0;
  std::function<void(Integrator&)> on_last = [](Integrator&) {};

 private:
  void note(const char* what, int number) {
    iterations = number;
    text += what + std::to_string(number) + " ";
  }
};

void render(const std::string& scene, Notes& notes, const SessionSettings& settings = {}) {
  Diagnostics diagnostics;
  const LoadedScene loaded("test.dsc", scene, {}, diagnostics);
  Silent messages;
  MemoryBound memory(0);
  const std::vector<FrameList> intervals = memory.plan(loaded.job, *loaded.world, {}, {}, messages, notes);
  Session(loaded, intervals, memory, settings, messages, notes).run();
}

std::string stumbling_scene() {
  static const bool added = (integrator_plugins().add({{"stumbling", "may stumble", make_stumbling}}), true);
  return added ? "Integrator \"stumbling\" WorldBegin Shape \"sphere\" LightSource \"point\"" : "";
}

class SessionWithStumbles : public ::testing::Test {
 protected:
  ~SessionWithStumbles() override {
    Stumbling::stumble = nullptr, Stumbling::bytes = 100, Stumbling::state_bytes = 0, Stumbling::stumbles_after = 3;
  }
};

TEST(Session, GivesTheImagesOfItsIntegrator) {
  const std::string scene = R"(
Integrator "dsppm" "integer iterations" 3 "integer photons" 2000
Frames 2
LookAt 0 0 -4  0 0 0  0 1 0
Camera "perspective"
Film "rgb" "integer xresolution" 12 "integer yresolution" 8
WorldBegin
LightSource "point" "point3 from" [0 3 -3]
DynamicBegin "ball"
  Keyframe 1 Translate -1 0 0
  Keyframe 2 Translate 1 0 0
  KeyframeEnd
  Shape "sphere"
DynamicEnd
)";
  Notes notes;
  std::vector<Image> images;
  notes.on_last = [&](Integrator& integrator) {
    for (const Frame frame : {0, 1}) images.push_back(integrator.estimate(frame));
  };
  render(scene, notes);
  EXPECT_EQ(notes.text, "1 2 3 l3 ");
  EXPECT_EQ(images, TestScene(scene).render_all(3));
}

TEST_F(SessionWithStumbles, ImagesAreDueAsAskedForAndOnceAtTheEnd) {
  Notes notes;
  SessionSettings settings;
  settings.write_every.iterations = 2;
  render(stumbling_scene(), notes, settings);
  EXPECT_EQ(notes.text, "1 2 i2 3 4 i4 5 6 l6 ");
}

TEST_F(SessionWithStumbles, EndsWhereItsObserverWants) {
  Notes notes;
  notes.ends_after = 2;
  render(stumbling_scene(), notes);
  EXPECT_EQ(notes.text, "1 2 l2 ");
}

TEST_F(SessionWithStumbles, AnExceptionLeavesItAfterTheImagesSoFar) {
  Stumbling::stumble = [] { throw std::runtime_error("stumbled"); };
  Notes notes;
  EXPECT_THROW(render(stumbling_scene(), notes), std::runtime_error);
  EXPECT_EQ(notes.text, "1 2 3 f3 failed ");
}

TEST_F(SessionWithStumbles, AnExceptionInTheFirstIterationLeavesNoImages) {
  Stumbling::stumble = [] { throw std::runtime_error("stumbled"); };
  Stumbling::stumbles_after = 0;
  Notes notes;
  EXPECT_THROW(render(stumbling_scene(), notes), std::runtime_error);
  EXPECT_EQ(notes.text, "failed ");
}

/// How many iterations the integrator has begun when one of them was cancelled.
int begun_when_cancelled(double long_iteration) {
  Notes notes;
  int begun = 0;
  notes.on_last = [&](Integrator& integrator) { begun = integrator.statistics().iterations; };
  Stumbling::stumble = [&] {
    notes.ends_after = 1;  // whoever cancels an iteration wants an end, too
    throw Cancelled();
  };
  SessionSettings settings;
  settings.long_iteration = long_iteration;
  render(stumbling_scene(), notes, settings);
  EXPECT_EQ(notes.text, "1 2 3 l3 ");
  return begun;
}

TEST_F(SessionWithStumbles, ACancelledIterationLeavesNoTrace) { EXPECT_EQ(begun_when_cancelled(0), 3); }

// Nor would they be cancelled by a signal: base/system/cancellation.h.
TEST_F(SessionWithStumbles, ShortIterationsAreNotCopied) { EXPECT_EQ(begun_when_cancelled(5), 4); }

TEST_F(SessionWithStumbles, StatesThatAreMostOfTheMemoryAreNotCopied) {
  Stumbling::state_bytes = 10'000'000;
  Stumbling::bytes = 19'000'000;
  EXPECT_EQ(begun_when_cancelled(0), 4);
  Stumbling::bytes = 21'000'000;
  EXPECT_EQ(begun_when_cancelled(0), 3);
}

TEST(LoadedScene, TakesInstancesForShapes) {
  Diagnostics diagnostics;
  const LoadedScene loaded("test.dsc", R"(
WorldBegin
LightSource "point"
ObjectBegin "chair" Shape "sphere" ObjectEnd
ObjectInstance "chair")",
                           {}, diagnostics);
  EXPECT_TRUE(diagnostics.all().empty()) << diagnostics.all().front().message;
}

TEST(LoadedScene, LooksForHolesInMeshesOfGlass) {
  Diagnostics diagnostics;
  const LoadedScene loaded("test.dsc", R"(
WorldBegin
LightSource "point"
Material "dielectric"
Shape "trianglemesh" "integer indices" [0 1 2] "point3 P" [0 0 3  1 0 3  0 1 3])",
                           {}, diagnostics);
  ASSERT_EQ(diagnostics.all().size(), 1u);
  EXPECT_NE(diagnostics.all().front().message.find("open"), std::string::npos) << diagnostics.all().front().message;
}

}  // namespace session_test
}  // namespace dspm::test
