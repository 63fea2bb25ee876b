// Checkpoints as files: whatever was saved last for each interval is what is loaded, however often others were saved
// in between and the file was replaced.
#include "dspm/session/checkpoint/checkpoint_file.h"

#include <gtest/gtest.h>

#include <random>

#include "dspm/base/math/moments.h"
#include "tests/support/idle_integrator.h"
#include "tests/support/temporary_directory.h"

namespace dspm::test {
namespace checkpoint_file_test {

/// Its state is a list of numbers.
class Numbers final : public IdleIntegrator {
 public:
  explicit Numbers(std::vector<double> numbers = {}) : numbers_(std::move(numbers)) {}
  const std::vector<double>& numbers() const { return numbers_; }

  bool persist(StateStream& state) override {
    state.list(numbers_, 1'000'000);
    return true;
  }

 private:
  std::vector<double> numbers_;
};

FrameList frames_of(std::size_t interval) {
  const auto first = static_cast<int>(interval);
  return {FileFrame(first), FileFrame(first + 100)};
}

/// Of a file with frames enough.
CheckpointFile::Render render_with(std::vector<Fact> facts) { return {std::move(facts), {{1000, 1}, 1000, {""}, {}}}; }

/// A file, and what it must hold.
class Saved {
 public:
  explicit Saved(std::size_t intervals) : model_(intervals) {
    std::vector<IntervalState> states(intervals);
    for (std::size_t i = 0; i < intervals; ++i) states[i].places.frames = frames_of(i);
    file_ =
        CheckpointFile::write(path_, render_with({{"scene", "a b c"}, {"seed", "7", true}}), states, nullptr, nullptr);
  }

  void save(std::size_t interval, std::vector<double> numbers, bool from_disk) {
    model_[interval].numbers = numbers;
    Numbers integrator(std::move(numbers));
    const CheckpointFile::NewState state{interval, integrator};
    if (from_disk) file_ = std::make_unique<CheckpointFile>(path_);
    std::vector<IntervalState> states = file_->intervals();
    states[interval].iterations = ++model_[interval].iterations;
    states[interval].seconds = model_[interval].seconds += 0.25;
    file_ = CheckpointFile::write(path_, file_->render(), states, &state, file_.get());
  }

  void expect_all() const {
    const CheckpointFile on_disk(path_);
    for (const CheckpointFile* file : {file_.get(), &on_disk}) {
      ASSERT_EQ(file->intervals().size(), model_.size());
      ASSERT_EQ(file->render().facts.size(), 2u);
      EXPECT_EQ(file->render().facts[0].text, "a b c");
      EXPECT_TRUE(file->render().facts[1].is_digest);
      for (std::size_t i = 0; i < model_.size(); ++i) {
        EXPECT_EQ(file->intervals()[i].places.frames, frames_of(i));
        EXPECT_EQ(file->intervals()[i].iterations, model_[i].iterations);
        EXPECT_EQ(file->intervals()[i].seconds, model_[i].seconds);
        if (model_[i].iterations == 0) continue;
        Numbers loaded;
        file->load(i, loaded);
        EXPECT_EQ(loaded.numbers(), model_[i].numbers) << "interval " << i;
      }
    }
  }

 private:
  struct Interval {
    int iterations = 0;
    double seconds = 0;
    std::vector<double> numbers;
  };

  TemporaryDirectory directory_;
  std::filesystem::path path_ = directory_ / "a";
  std::vector<Interval> model_;
  std::unique_ptr<const CheckpointFile> file_;
};

TEST(CheckpointFile, HoldsTheLastStateOfEachInterval) {
  std::mt19937 random(20261122);
  const auto below = [&](std::size_t end) { return std::uniform_int_distribution<std::size_t>(0, end - 1)(random); };
  for (const std::size_t intervals : {1u, 2u, 7u}) {
    Saved saved(intervals);
    saved.expect_all();
    for (int i = 0; i < 30; ++i) {
      std::vector<double> numbers(below(20) == 0 ? 300'000 : below(100));  // 2.4 MB: more than a block
      for (double& number : numbers) number = std::uniform_real_distribution<>()(random);
      saved.save(below(intervals), std::move(numbers), below(2) == 0);
      saved.expect_all();
    }
  }
}

// The file in which the other intervals' states are is cut off by somebody while the render goes on.
TEST(CheckpointFile, IsNotReplacedByWhatCannotBeCopied) {
  const TemporaryDirectory directory;
  const std::filesystem::path path = directory / "cut.ck";
  std::vector<IntervalState> states(2);
  states[0].places.frames = {FileFrame(0)}, states[1].places.frames = {FileFrame(1)};
  auto file = CheckpointFile::write(path, render_with({}), states, nullptr, nullptr);
  Numbers many(std::vector<double>(100'000, 0.5)), one({1});
  const auto save = [&](std::size_t interval, Numbers& numbers) {
    std::vector<IntervalState> now = file->intervals();
    now[interval].iterations = 1;
    const CheckpointFile::NewState state{interval, numbers};
    file = CheckpointFile::write(path, render_with({}), now, &state, file.get());
  };
  save(0, many);
  std::filesystem::resize_file(path, 400'000);
  EXPECT_THROW(save(1, one), std::runtime_error);
  EXPECT_EQ(std::filesystem::file_size(path), 400'000u);
}

TEST(CheckpointFile, IsRefusedWithAnyByteChangedOrCutOffAnywhere) {
  const TemporaryDirectory directory;
  Numbers integrator({1, 2, 3});
  const CheckpointFile::NewState state{0, integrator};
  IntervalState interval{{{FileFrame(0)}}};
  interval.iterations = 1;
  CheckpointFile::write(directory / "a", render_with({{"scene", "a b c"}}), {interval}, &state, nullptr);
  const std::string whole = contents(directory / "a");
  EXPECT_NO_THROW(CheckpointFile(directory / "a"));
  for (std::size_t at = 0; at < whole.size(); ++at) {
    std::string changed = whole;
    changed[at] = static_cast<char>(changed[at] ^ (1 << at % 8));
    put_file(directory / "a", changed);
    EXPECT_THROW(CheckpointFile(directory / "a"), std::runtime_error) << "byte " << at;
    put_file(directory / "a", whole.substr(0, at));
    EXPECT_THROW(CheckpointFile(directory / "a"), std::runtime_error) << "up to byte " << at;
  }
}

}  // namespace checkpoint_file_test
}  // namespace dspm::test
