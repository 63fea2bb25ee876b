// Several machines, here threads of one process: the bits do not depend on how many there are, nor on their speed.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <deque>
#include <mutex>
#include <thread>

#include "dspm/base/system/cancellation.h"
#include "dspm/session/machines/block_state.h"
#include "dspm/session/machines/helper.h"
#include "dspm/session/machines/leader.h"
#include "dspm/session/stage.h"

namespace dspm::test {
namespace together_test {

constexpr const char* kScene = R"(
Frames 3
Integrator "dsppm" "string indirect" "photons" "integer iterations" 22 "integer photons" 300 "integer seed" {}
Camera "perspective"
Film "rgb" "integer xresolution" 9 "integer yresolution" 7
WorldBegin
LightSource "point" "point3 from" [0 2 2]
Shape "disk" "float height" 4 "float radius" 5
DynamicBegin "ball" Keyframe 1 Translate -1 0 3 Keyframe 3 Translate 1 0 3 KeyframeEnd
Shape "sphere" "float radius" 0.4 DynamicEnd
)";

/// Letters between threads.
class Network {
 public:
  class Wire final : public Link {
   public:
    Wire(Network& network, int me) : network_(network), me_(me) {}
    int machines() const override { return static_cast<int>(network_.boxes_.size()); }
    int me() const override { return me_; }
    void send(Letter letter) override {
      const auto to = static_cast<std::size_t>(std::exchange(letter.machine, me_));
      const std::lock_guard lock(network_.mutex_);
      network_.boxes_[to].push_back(std::move(letter));
    }
    bool is_quiet() override { return true; }
    void abandon() override {
      network_.is_abandoned_ = true;
      for (int machine = 1; machine < machines(); ++machine) send({machine, LetterKind::end, {}});
    }
    std::optional<Letter> receive() override {
      const std::lock_guard lock(network_.mutex_);
      std::deque<Letter>& box = network_.boxes_[static_cast<std::size_t>(me_)];
      if (box.empty()) return std::nullopt;
      Letter letter = std::move(box.front());
      box.pop_front();
      return letter;
    }

   private:
    Network& network_;
    int me_;
  };

  explicit Network(int machines) : boxes_(static_cast<std::size_t>(machines)) {}
  Wire wire(int machine) { return {*this, machine}; }
  bool is_abandoned() const { return is_abandoned_; }

 private:
  std::atomic<bool> is_abandoned_ = false;
  std::mutex mutex_;
  std::vector<std::deque<Letter>> boxes_;
};

/// An edition of the scene.
struct Loaded {
  explicit Loaded(int edition = 0) : scene("scene.dsc", fmt::format(kScene, 5 + edition), {}, diagnostics) {
    scene.job.settings.learn_at_once = true;
  }
  Diagnostics diagnostics;
  LoadedScene scene;
};

/// A helper that begins late, or is not what it should be.
struct Hand {
  int rest = 0;  // milliseconds before it begins
  std::string digest = "this scene", fault = {};
  bool is_stuck = false;  // with its first block
  bool hangs = false;     // once it has rendered one
};

void get_stuck(Network::Wire& wire) {
  wire.send({0, LetterKind::ready, written(Hello{"stuck", "this scene"})});
  for (;;) {
    const std::optional<Letter> letter = wire.receive();
    if (letter && letter->kind == LetterKind::end) return wire.send({0, LetterKind::bye, {}});
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

void hang(Network::Wire& wire) {
  wire.send({0, LetterKind::ready, written(Hello{"hanged", "this scene"})});
  for (;;) {
    const std::optional<Letter> letter = wire.receive();
    if (letter && letter->kind == LetterKind::end) return;
    if (letter && letter->kind == LetterKind::order) {
      const auto order = read<Order>(letter->text);
      wire.send({0, LetterKind::done, written(Rendered{order.interval, order.block.begin})});
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

void help(Network& network, int machine, const Hand& hand) {
  Network::Wire wire = network.wire(machine);
  if (hand.hangs) return hang(wire);
  if (hand.is_stuck) return get_stuck(wire);
  Helper helper(wire, [] {});
  Messages messages(true);
  std::this_thread::sleep_for(std::chrono::milliseconds(hand.rest));
  if (!hand.fault.empty()) return helper.fail({0, hand.fault});
  while (const std::optional<Edition> edition = helper.edition()) {
    const Loaded loaded(edition->number);
    helper.render(loaded.scene, messages, {"machine" + std::to_string(machine), hand.digest, edition->number});
  }
}

/// All of them, until the leader goes.
class Machines {
 public:
  explicit Machines(
      const std::vector<Hand>& hands, std::function<bool()> end_wanted = [] { return false; },
      double patience = Leader::kPatience)
      : network_(static_cast<int>(hands.size()) + 1), leader_(wire_, std::move(end_wanted), patience) {
    for (std::size_t i = 0; i < hands.size(); ++i)
      threads_.emplace_back([this, hand = hands[i], i] { help(network_, static_cast<int>(i) + 1, hand); });
  }
  Leader& leader() { return leader_; }
  const Network& network() const { return network_; }

 private:
  Network network_;
  std::vector<std::jthread> threads_;
  Network::Wire wire_ = network_.wire(0);
  Leader leader_;
};

/// What the leader has in the end.
struct Sum {
  std::vector<float> images;  // of all frames
  std::string state;
};

Sum sum_of(Integrator& integrator, int frames) {
  Sum sum{{}, state_of(integrator)};
  for (int f = 0; f < frames; ++f)
    for (const Rgb& c : integrator.estimate(static_cast<Frame>(f)).pixels)
      sum.images.insert(sum.images.end(), {c.r, c.g, c.b});
  return sum;
}

struct Run {
  int begin = 0, end = 22;  // iterations
  int known_end = -1;       // at first; -1: the same
  std::string before = {};  // the state to go on from; empty: none
  std::function<bool()> end_wanted = [] { return false; };
};

/// All frames of the scene, shared out, in blocks of four iterations.
struct SharedOut {
  const Loaded loaded;
  Messages messages{true};
  Stage stage;

  SharedOut(Leader& leader, int known_end, int edition = 0, bool sees_all = false)
      : loaded(edition), stage(loaded.scene, loaded.scene.job.frames) {
    leader.expect("this scene");
    const auto share_out = [&, known_end](std::unique_ptr<Integrator> sum, std::unique_ptr<Integrator> own) {
      return leader.share_out(std::move(sum), std::move(own), stage, 0, {known_end, 4});
    };
    stage.make_integrator(messages, {.sees_all = sees_all, .share_out = share_out});
  }
};

Sum led(const std::vector<Hand>& hands, const Run& run = {}) {
  Machines machines(hands, run.end_wanted);
  SharedOut work(machines.leader(), run.known_end < 0 ? run.end : run.known_end);
  Integrator& integrator = work.stage.integrator();
  if (!run.before.empty()) load_state(run.before, integrator);
  for (int i = run.begin; i < run.end; i = Block::from(i, run.end, 4).end) work.stage.iterate(i);
  return sum_of(integrator, static_cast<int>(work.stage.frames().size()));
}

/// The same without machines: each block by itself, added in their order.
Sum slow_twin(int edition = 0) {
  const Loaded loaded(edition);
  Messages messages(true);
  Stage whole(loaded.scene, loaded.scene.job.frames), block(loaded.scene, loaded.scene.job.frames);
  Integrator& sum = whole.make_integrator(messages, {.sees_all = false});
  for (int begin = 0; begin < 22; begin += 4) {
    block.make_integrator(messages, {.sees_all = false});
    for (int i = begin; i < std::min(begin + 4, 22); ++i) block.iterate(i);
    add(state_of(block.integrator()), sum);
  }
  return sum_of(sum, 3);
}

TEST(Together, TheBitsAreThoseOfBlocksInOrder) {
  const Sum wanted = slow_twin();
  EXPECT_EQ(led({}).images, wanted.images);
  EXPECT_EQ(led({{}}).images, wanted.images);
  EXPECT_EQ(led({{.rest = 20}, {}, {.rest = 5}, {}}).images, wanted.images);
}

TEST(Together, GoesOnWithOtherMachines) {
  const Sum half = led({{}, {}}, {.end = 12});
  EXPECT_EQ(led({{}}, {.begin = 12, .before = half.state}).images, slow_twin().images);
  EXPECT_EQ(led({}, {.begin = 12, .before = half.state}).images, slow_twin().images);
}

void expect_failure(const Hand& hand, const std::string& words) {
  try {
    led({hand}, {.end = 100'000});
    ADD_FAILURE() << "nothing was thrown";
  } catch (const std::runtime_error& error) {
    EXPECT_EQ(error.what(), words);
  }
}

TEST(Together, AHelperThatFailsEndsTheRun) {
  expect_failure({.fault = "machine1: out of memory"}, "machine1: out of memory");
  expect_failure({.digest = "another"}, "machine1 has another scene, other files of it or another version of dspm");
}

TEST(Together, AMachineThatHangsEndsTheRun) {
  Machines machines(
      {{.hangs = true}, {}}, [] { return false; }, 0.2);
  SharedOut work(machines.leader(), 0);
  try {
    for (int i = 0; i < 1'000'000; i += 4) work.stage.iterate(i);
    ADD_FAILURE() << "nothing was thrown";
  } catch (const MachineFailed& error) {
    EXPECT_EQ(error.what(), std::string("hanged has not answered for 0.2s"));
  }
  EXPECT_GT(sum_of(work.stage.integrator(), 3).images.size(), 0u);  // what was added up before can be written
  EXPECT_THROW(machines.leader().end(), MachineFailed);
  for (int i = 0; i < 1000 && !machines.network().is_abandoned(); ++i)  // by the thread of the post
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  EXPECT_TRUE(machines.network().is_abandoned());
}

TEST(Together, AnEditReachesAll) {
  Machines machines({{}, {.rest = 5}, {}});
  SharedOut(machines.leader(), 22).stage.iterate(0);  // others are still at work then
  machines.leader().begin_anew({});
  SharedOut now(machines.leader(), 22, 1);
  for (int i = 0; i < 22; i += 4) now.stage.iterate(i);
  EXPECT_EQ(sum_of(now.stage.integrator(), 3).images, slow_twin(1).images);
}

/// Estimated after 16 iterations.
std::vector<double> errors(const std::vector<Hand>& hands) {
  Machines machines(hands);
  SharedOut work(machines.leader(), 16, 0, true);
  for (int i = 0; i < 16; i += 4) work.stage.iterate(i);
  return work.stage.integrator().statistics().errors;
}

TEST(Together, TheErrorIsThatOfTheSum) {
  Loaded loaded;
  Messages messages(true);
  Stage alone(loaded.scene, loaded.scene.job.frames);
  alone.make_integrator(messages);
  for (int i = 0; i < 16; ++i) alone.iterate(i);
  const std::vector<double> wanted = alone.integrator().statistics().errors, one = errors({});
  ASSERT_EQ(one.size(), 3u);
  for (std::size_t f = 0; f < 3; ++f) {
    EXPECT_GT(wanted[f], 0.01);
    EXPECT_NEAR(one[f] / wanted[f], 1, 1e-3);
  }
  EXPECT_EQ(errors({{}, {.rest = 5}}), one);
}

TEST(Together, NobodyWaitsForAMachineThatIsStuck) {
  EXPECT_EQ(led({{.is_stuck = true}}).images, slow_twin().images);
  EXPECT_EQ(led({{.is_stuck = true}, {}}).images, slow_twin().images);
}

TEST(Together, GoesOnBeyondTheEnd) {
  EXPECT_EQ(led({{}}, {.end = 20, .known_end = 12}).images, led({}, {.end = 20}).images);
}

TEST(Together, AnEndThatIsWantedDoesNotWaitForOthers) {
  EXPECT_THROW(led({{.is_stuck = true}}, {.end = 1'000'000, .end_wanted = [] { return true; }}), Cancelled);
}

}  // namespace together_test
}  // namespace dspm::test
