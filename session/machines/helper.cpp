#include "dspm/session/machines/helper.h"

#include <utility>

#include "dspm/session/machines/block_state.h"
#include "dspm/session/stage.h"

namespace dspm {

Helper::Helper(Link& link, std::function<void()> on_end)
    : on_end_(std::move(on_end)), post_(link, [this](Letter letter) { open(std::move(letter)); }) {}

std::optional<Edition> Helper::edition() {
  const std::lock_guard lock(mutex_);
  return is_over_ ? std::nullopt : std::optional(edition_);
}

void Helper::render(const LoadedScene& loaded, Messages& messages, const Hello& hello) {
  std::uint64_t interval = 0;  // of the stage; 0: none yet
  std::optional<Stage> stage;
  std::string zero;
  post_.send(0, LetterKind::ready, written(hello));
  while (const std::optional<Order> order = next_order(hello.edition)) {
    if (order->interval != interval) {
      const auto memory = static_cast<std::size_t>(order->memory);
      Integrator& integrator =
          stage.emplace(loaded, order->frames).make_integrator(messages, {.memory = memory, .sees_all = false});
      zero = state_of(integrator), interval = order->interval;
    }
    const Rendered block{interval, order->block.begin};
    std::string state = rendered(order->block, *stage, zero);
    {
      const std::lock_guard lock(mutex_);
      std::erase_if(kept_, [&](const auto& each) { return each.first < Rendered{interval, order->wanted_from}; });
      kept_[block] = std::move(state);
    }
    post_.send(0, LetterKind::done, written(block));
  }
}

void Helper::fail(const Failure& failure) {
  post_.send(0, LetterKind::failed, written(failure));
  while (next_order(failure.edition)) {}
}

std::optional<Order> Helper::next_order(int edition) {
  std::unique_lock lock(mutex_);
  const auto has_ended = [&] { return is_over_ || edition_.number != edition; };
  changed_.wait(lock, [&] { return order_ || has_ended(); });
  return has_ended() ? std::nullopt : std::exchange(order_, std::nullopt);
}

/// Called by the thread of the post.
void Helper::open(Letter letter) {
  const std::lock_guard lock(mutex_);
  if (letter.kind == LetterKind::order) order_ = read<Order>(letter.text);
  if (letter.kind == LetterKind::bring)
    if (auto state = kept_.extract(read<Rendered>(letter.text)); !state.empty())
      post_.send(0, LetterKind::state, letter.text + state.mapped());
  if (letter.kind == LetterKind::edited)
    edition_ = read<Edition>(letter.text), order_.reset(), kept_.clear(), on_end_();
  if (letter.kind == LetterKind::end) is_over_ = true, on_end_();
  changed_.notify_all();
}

}  // namespace dspm
