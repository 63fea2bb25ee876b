#include "dspm/machines/leader.h"

#include <fmt/format.h>

#include <chrono>
#include <stdexcept>
#include <utility>

#include "dspm/integrators/wrapping_integrator.h"
#include "dspm/machines/block_state.h"
#include "dspm/scene/scene.h"
#include "dspm/system/cancellation.h"

namespace dspm {

class Leader::SharedIterations final : public WrappingIntegrator {
 public:
  SharedIterations(std::unique_ptr<Integrator> inner, Leader& leader, const Extent& extent)
      : WrappingIntegrator(std::move(inner)), leader_(leader), extent_(extent), zero_(state_of(*inner_)) {}
  ~SharedIterations() override {
    const std::lock_guard lock(leader_.mutex_);
    leader_.desk_.close();
  }

  void iterate(int begin, const Scene& scene) override {
    if (begin != next_) reopen(begin);
    for (;;) {
      std::unique_lock lock(leader_.mutex_);
      if (!leader_.failure_.empty()) throw MachineFailed(leader_.failure_);
      if (std::optional<std::string> state = leader_.desk_.take(begin)) {
        leader_.fetch();
        lock.unlock();
        add(*state, *inner_);
        next_ = Block::from(begin, extent_.iterations, extent_.block).end;
        return;
      }
      if (const std::optional<Block> own = leader_.desk_.hand_out(0)) {
        lock.unlock();
        render(*own, scene);
        continue;
      }
      if (leader_.end_wanted_()) throw Cancelled{};
      leader_.changed_.wait_for(lock, std::chrono::milliseconds(100));
    }
  }

  Statistics statistics() const override {
    Statistics statistics = inner_->statistics();
    statistics.counters.add("machines", static_cast<std::uint64_t>(leader_.machines()));
    statistics.counters.add("bytes between them", leader_.post_.bytes());
    statistics.bytes += zero_.size();
    return statistics;
  }

 private:
  /// At the beginning, after a resume, and if more iterations are wanted than were at first.
  void reopen(int begin) {
    if (begin >= extent_.iterations) extent_.iterations = 0;
    const std::lock_guard lock(leader_.mutex_);
    leader_.desk_.open(begin, extent_.iterations, extent_.block);
    leader_.serve();
  }

  /// The integrator serves twice: it holds the sum, and renders a block in between.
  void render(const Block& block, const Scene& scene) {
    const std::string sum = state_of(*inner_);
    std::string state;
    try {
      state = rendered(block, *inner_, scene, zero_);
    } catch (...) {
      load_state(sum, *inner_);
      throw;
    }
    load_state(sum, *inner_);
    const std::lock_guard lock(leader_.mutex_);
    leader_.desk_.arrived(block.begin, std::move(state));
    leader_.fetch();
  }

  Leader& leader_;
  Extent extent_;
  int next_ = -1;  // the iteration with which the next block begins
  const std::string zero_;
};

Leader::Leader(Link& link, std::function<bool()> end_wanted)
    : link_(link),
      end_wanted_(std::move(end_wanted)),
      post_(link, [this](Letter letter) { open(std::move(letter)); }) {}

Leader::~Leader() {
  for (int machine = 1; machine < machines(); ++machine) post_.send(machine, LetterKind::end);
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return gone_ == machines() - 1; });
}

void Leader::expect(std::string digest) {
  const std::lock_guard lock(mutex_);
  digest_ = std::move(digest);
  serve();
}

void Leader::begin_anew(const std::optional<std::array<double, 9>>& look_at) {
  const std::lock_guard lock(mutex_);
  ++edition_.number, edition_.look_at = look_at;
  first_interval_ = order_.interval + 1;
  digest_.reset(), failure_.clear(), waiting_.clear(), ready_.clear();
  for (int machine = 1; machine < machines(); ++machine) post_.send(machine, LetterKind::edited, written(edition_));
}

std::unique_ptr<Integrator> Leader::share_out(std::unique_ptr<Integrator> integrator, const FrameList& frames,
                                              std::size_t memory, const Extent& extent) {
  const std::lock_guard lock(mutex_);
  ++order_.interval, order_.frames = frames, order_.memory = memory;
  return std::make_unique<SharedIterations>(std::move(integrator), *this, extent);
}

/// By the thread of the post.
void Leader::open(Letter letter) {
  const std::lock_guard lock(mutex_);
  const auto is_now = [&](const Rendered& each) { return each.interval == order_.interval; };
  if (letter.kind == LetterKind::ready) {
    if (read<Hello>(letter.text).edition == edition_.number) ready_.push_back(std::move(letter));
  } else if (letter.kind == LetterKind::done) {
    const auto block = read<Rendered>(letter.text);
    if (is_now(block)) desk_.rendered(letter.machine, block.begin);
    if (block.interval >= first_interval_) waiting_.push_back(letter.machine);
  } else if (letter.kind == LetterKind::state) {
    const auto block = read<Rendered>(letter.text);
    if (is_now(block)) desk_.arrived(block.begin, letter.text.substr(written(block).size()));
  } else if (letter.kind == LetterKind::failed) {
    if (auto failure = read<Failure>(letter.text); failure.edition == edition_.number)
      failure_ = std::move(failure.why);
  }
  gone_ += letter.kind == LetterKind::bye;
  fetch();
  serve();
  changed_.notify_all();
}

/// Orders to those that wait for one; the mutex is held.
void Leader::serve() {
  for (; digest_ && !ready_.empty(); ready_.pop_front()) {
    const Hello hello = read<Hello>(ready_.front().text);
    if (hello.digest != *digest_)
      failure_ = fmt::format("{} has another scene, other files of it or another version of dspm", hello.host);
    else
      waiting_.push_back(ready_.front().machine);
  }
  std::deque<int> still;
  for (const int machine : std::exchange(waiting_, {})) {
    Order order = order_;
    if (const std::optional<Block> block = desk_.hand_out(machine))
      order.block = *block, post_.send(machine, LetterKind::order, written(order));
    else
      still.push_back(machine);
  }
  waiting_ = std::move(still);
}

/// What is to be added next comes here while others render; the mutex is held.
void Leader::fetch() {
  for (const auto& [machine, begin] : desk_.to_fetch())
    if (machine != 0) post_.send(machine, LetterKind::bring, written(Rendered{order_.interval, begin}));
}

}  // namespace dspm
