// Four frames side by side against PixelStatistics, their twin, on random photons: the same bits.
#include "dspm/integrators/methods/dsppm/four_frames.h"

#include <gtest/gtest.h>

#include <random>

namespace dspm {
namespace four_frames_test {

bool same(const PixelStatistics& a, const PixelStatistics& b) { return a.N == b.N && a.R2 == b.R2 && a.tau == b.tau; }

/// A pixel in frames 4 to 7, which are group 1, one by one and side by side.
class Twins {
 public:
  void begin(FrameSet frames, float radius2) {
    for (int lane = 0; lane < 4; ++lane)
      if (frames.contains(4 + lane)) single_[lane].begin(radius2);
    four_.begin(lanes_of(frames, 1), radius2);
  }
  void see(int lane, const Rgb& radiance) { single_[lane].see(radiance, 1000), four_.see(lane, radiance, 1000); }
  void absorb(FrameSet frames, const std::array<PassSums, 4>& own, const PassSums& shared, const Rgb& throughput) {
    const Palette& palette = Palette::rgb();
    FourSums sums = FourSums();
    for (int lane = 0; lane < 4; ++lane) {
      const auto at = static_cast<std::size_t>(lane);
      for (std::uint32_t i = 0; i < own[at].M; ++i)
        sums.add(lanes_of(FrameSet::single(4 + lane), 1), i == 0 ? palette.carried(own[at].phi) : Spectrum());
      if (!frames.contains(4 + lane)) continue;
      single_[lane].absorb({own[at].M + shared.M, (own[at].phi + shared.phi) * throughput}, 0.7f);
    }
    const FoundFlux found{shared.M, palette.carried(shared.phi)};
    four_.absorb(sums.total(lanes_of(frames, 1), found, palette.carried(throughput), palette), 0.7f);
  }
  void expect_same() const {
    for (int lane = 0; lane < 4; ++lane) EXPECT_TRUE(same(single_[lane], four_.of(lane))) << lane;
  }

 private:
  PixelStatistics single_[4];
  FourFrames four_;
};

TEST(FourFrames, AreFourPixelStatistics) {
  std::mt19937 random(8);
  std::uniform_real_distribution<float> unit(0, 1);
  std::uniform_int_distribution<std::uint32_t> few(0, 3);
  const auto colour = [&] { return Rgb(unit(random), unit(random), unit(random)); };
  for (int trial = 0; trial < 200; ++trial) {
    Twins twins;
    for (int iteration = 0; iteration < 20; ++iteration) {
      const FrameSet frames(random() & 0xff);
      twins.begin(frames, unit(random));
      twins.see(static_cast<int>(few(random)), colour());
      std::array<PassSums, 4> own;
      for (PassSums& sums : own)
        if ((sums.M = few(random)) > 0) sums.phi = colour();
      const std::uint32_t M = few(random);
      twins.absorb(frames, own, {M, M > 0 ? colour() : Rgb()}, colour());
      twins.expect_same();
    }
  }
}

}  // namespace four_frames_test
}  // namespace dspm
