#include "dspm/machines/helper.h"

#include <utility>

#include "dspm/machines/block_state.h"
#include "dspm/scene/scene.h"
#include "dspm/session/session.h"

namespace dspm {

Helper::Helper(Link& link, std::function<void()> on_end)
    : on_end_(std::move(on_end)), post_(link, [this](Letter letter) { open(std::move(letter)); }) {}

void Helper::render(const LoadedScene& loaded, Messages& messages, const std::string& host, const std::string& digest) {
  std::uint64_t interval = 0;  // of the integrator; 0: none yet
  std::unique_ptr<Scene> scene;
  std::unique_ptr<Integrator> integrator;
  std::string zero;
  post_.send(0, LetterKind::ready, written(Hello{host, digest}));
  while (const std::optional<Order> order = next_order()) {
    if (order->interval != interval) {
      integrator.reset(), scene.reset();
      scene = loaded.world->scene(order->frames);
      integrator = make_integrator(loaded.job, *scene, messages, static_cast<std::size_t>(order->memory));
      zero = state_of(*integrator), interval = order->interval;
    }
    const Rendered block{interval, order->block.begin};
    std::string state = rendered(order->block, *integrator, *scene, zero);
    {
      const std::lock_guard lock(mutex_);
      std::erase_if(kept_, [&](const auto& each) { return each.first.interval != interval; });
      kept_[block] = std::move(state);
    }
    post_.send(0, LetterKind::done, written(block));
  }
}

void Helper::fail(const std::string& why) {
  post_.send(0, LetterKind::failed, why);
  while (next_order()) {}
}

std::optional<Order> Helper::next_order() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [&] { return order_ || is_over_; });
  return is_over_ ? std::nullopt : std::exchange(order_, std::nullopt);
}

/// By the thread of the post.
void Helper::open(Letter letter) {
  const std::lock_guard lock(mutex_);
  if (letter.kind == LetterKind::order) order_ = read<Order>(letter.text);
  if (letter.kind == LetterKind::bring)
    if (auto state = kept_.extract(read<Rendered>(letter.text)); !state.empty())
      post_.send(0, LetterKind::state, letter.text + state.mapped());
  if (letter.kind == LetterKind::end) is_over_ = true, on_end_();
  changed_.notify_all();
}

}  // namespace dspm
