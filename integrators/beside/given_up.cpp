#include "dspm/integrators/beside/given_up.h"

#include <string>
#include <utility>
#include <vector>

#include "dspm/image/image.h"
#include "dspm/integrators/beside/wrapping_integrator.h"

namespace dspm {
namespace {

class WithoutGivenUp final : public WrappingIntegrator {
 public:
  WithoutGivenUp(std::unique_ptr<Integrator> inner, std::vector<Frame> places)
      : WrappingIntegrator(std::move(inner)), places_(std::move(places)) {}

  Image estimate(Frame frame, const std::string& output) const override {
    return inner_->estimate(places_[static_cast<std::size_t>(frame)], output);
  }

  Statistics statistics() const override {
    Statistics statistics = inner_->statistics();
    keep_seen(statistics.energy);
    keep_seen(statistics.errors);
    return statistics;
  }

 private:
  template <class T>
  void keep_seen(std::vector<T>& by_frame) const {
    std::vector<T> seen;
    for (const Frame place : places_)
      if (static_cast<std::size_t>(place) < by_frame.size()) seen.push_back(by_frame[static_cast<std::size_t>(place)]);
    by_frame = std::move(seen);
  }

  const std::vector<Frame> places_;  // by frame
};

}  // namespace

std::unique_ptr<Integrator> without_given_up(std::unique_ptr<Integrator> integrator, int frames, FrameSet given_up) {
  if (given_up.empty()) return integrator;
  std::vector<Frame> seen;
  (FrameSet::first(frames) - given_up).for_each([&](Frame f) { seen.push_back(f); });
  return std::make_unique<WithoutGivenUp>(std::move(integrator), std::move(seen));
}

}  // namespace dspm
