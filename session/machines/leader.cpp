#include "dspm/session/machines/leader.h"

#include <fmt/format.h>

#include <stdexcept>
#include <utility>

#include "dspm/base/system/cancellation.h"
#include "dspm/base/system/readable.h"
#include "dspm/integrators/beside/wrapping_integrator.h"
#include "dspm/session/machines/block_state.h"
#include "dspm/world/scene/scene.h"

namespace dspm {

class Leader::SharedIterations final : public WrappingIntegrator {
 public:
  SharedIterations(std::unique_ptr<Integrator> sum, std::unique_ptr<Integrator> own, Stage& stage, Leader& leader,
                   const Extent& extent)
      : WrappingIntegrator(std::move(sum)),
        stage_(stage),
        leader_(leader),
        extent_(extent),
        renderer_(std::move(own)),
        zero_(state_of(*renderer_)) {}
  ~SharedIterations() override {
    const std::lock_guard lock(leader_.mutex_);
    leader_.desk_.close();
  }

  void iterate(const Iteration& first) override {
    const int begin = first.number;
    const bool is_beyond = extent_.iterations > 0 && begin >= extent_.iterations;
    if (begin != next_ || is_beyond) reopen(begin);
    next_ = -1;  // if anything is thrown
    while (!add_block(begin))
      if (!render_on(begin)) wait_for(begin);
    next_ = Block::from(begin, extent_.iterations, extent_.block).end;
  }

  /// Counts the work of this machine alone.
  Statistics statistics() const override {
    Statistics statistics = inner_->statistics();
    const Statistics own = renderer_->statistics();
    for (std::size_t i = 0; i < statistics.steps.size(); ++i) statistics.steps[i].work = own.steps[i].work;
    statistics.bytes += 2 * zero_.size();
    return statistics;
  }

 private:
  /// Opens the desk at the beginning, after a resume, and if more iterations are wanted than were at first.
  void reopen(int begin) {
    if (begin >= extent_.iterations) extent_.iterations = 0;
    rendering_.reset();
    const std::lock_guard lock(leader_.mutex_);
    leader_.desk_.open(begin, extent_.iterations, extent_.block);
    leader_.serve();
  }

  /// Returns false if the block has not come yet.
  bool add_block(int begin) {
    std::unique_lock lock(leader_.mutex_);
    if (!leader_.failure_.empty()) throw MachineFailed(leader_.failure_);
    const std::optional<std::string> state = leader_.desk_.take(begin);
    if (!state) return false;
    leader_.go_on();
    lock.unlock();
    add(*state, *inner_);
    return true;
  }

  /// Renders one iteration of a block of the leader's own, so that what arrives in the meantime is soon added. Returns
  /// false if there is no block.
  bool render_on(int begin) {
    if (rendering_ && rendering_->begin < begin) rendering_.reset();  // another machine was faster
    const bool is_next = rendering_ && rendering_->begin == begin;
    if (!is_next && leader_.end_wanted_()) throw Cancelled{};
    if (!rendering_ && !begin_block()) return false;
    renderer_->iterate(stage_.iteration(iteration_));
    if (++iteration_ < rendering_->end) return true;
    std::string state = state_of(*renderer_);
    const std::lock_guard lock(leader_.mutex_);
    leader_.desk_.arrived(rendering_->begin, std::move(state));
    leader_.go_on();
    rendering_.reset();
    return true;
  }

  bool begin_block() {
    {
      const std::lock_guard lock(leader_.mutex_);
      rendering_ = leader_.desk_.hand_out(0);
    }
    if (!rendering_) return false;
    iteration_ = rendering_->begin;
    load_state(zero_, *renderer_);
    return true;
  }

  /// Waits for a moment only, as an end may be wanted.
  void wait_for(int begin) {
    std::unique_lock lock(leader_.mutex_);
    leader_.changed_.wait_for(lock, std::chrono::milliseconds(100),
                              [&] { return leader_.desk_.is_here(begin) || !leader_.failure_.empty(); });
    leader_.look_for_silence();
  }

  Stage& stage_;
  Leader& leader_;
  Extent extent_;
  int next_ = -1;  // the iteration with which the next block begins
  const std::unique_ptr<Integrator> renderer_;
  const std::string zero_;          // its state before any iteration
  std::optional<Block> rendering_;  // a block of the leader's own
  int iteration_ = 0;               // its next one
};

Leader::Leader(Link& link, std::function<bool()> end_wanted, double patience)
    : link_(link),
      end_wanted_(std::move(end_wanted)),
      patience_(patience),
      post_(link, [this](Letter letter) { open(std::move(letter)); }) {}

void Leader::end() {
  if (std::exchange(has_ended_, true)) return;
  for (int machine = 1; machine < machines(); ++machine) post_.send(machine, LetterKind::end);
  std::unique_lock lock(mutex_);
  const auto all_are_gone = [this] { return static_cast<int>(gone_.size()) == machines() - 1; };
  if (!is_silent_ && changed_.wait_for(lock, patience_, all_are_gone)) return;
  post_.abandon();
  for (int machine = 1; machine < machines(); ++machine)
    if (!gone_.contains(machine)) throw MachineFailed(silence_of(machine) + "; all that was rendered is written");
}

Leader::~Leader() {
  try {
    end();
  } catch (const MachineFailed&) {  // something else has failed before
  }
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
  digest_.reset(), failure_.clear(), waiting_.clear(), ready_.clear(), asked_.clear();
  for (int machine = 1; machine < machines(); ++machine) post_.send(machine, LetterKind::edited, written(edition_));
}

std::unique_ptr<Integrator> Leader::share_out(std::unique_ptr<Integrator> sum, std::unique_ptr<Integrator> own,
                                              Stage& stage, std::size_t memory, const Extent& extent) {
  const std::lock_guard lock(mutex_);
  ++order_.interval, order_.frames = stage.frames(), order_.memory = memory;
  asked_.clear();
  return std::make_unique<SharedIterations>(std::move(sum), std::move(own), stage, *this, extent);
}

/// Called by the thread of the post.
void Leader::open(Letter letter) {
  const std::lock_guard lock(mutex_);
  const auto is_now = [&](const Rendered& each) { return each.interval == order_.interval; };
  if (letter.kind == LetterKind::ready) {
    const auto hello = read<Hello>(letter.text);
    hosts_[letter.machine] = hello.host;
    if (hello.edition == edition_.number) ready_.push_back(std::move(letter));
  } else if (letter.kind == LetterKind::done) {
    const auto block = read<Rendered>(letter.text);
    if (is_now(block)) desk_.rendered(letter.machine, block.begin);
    if (block.interval >= first_interval_) waiting_.push_back(letter.machine);
  } else if (letter.kind == LetterKind::state) {
    const auto block = read<Rendered>(letter.text);
    asked_.erase(block);
    letter.text.erase(0, written(block).size());
    if (is_now(block)) desk_.arrived(block.begin, std::move(letter.text));
  } else if (letter.kind == LetterKind::failed) {
    if (auto failure = read<Failure>(letter.text); failure.edition == edition_.number)
      failure_ = std::move(failure.why);
  }
  if (letter.kind == LetterKind::bye) gone_.insert(letter.machine);
  go_on();
  changed_.notify_all();
}

/// Sends orders to those that wait for one. The mutex must be held.
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
      order.block = *block, order.wanted_from = desk_.wanted_from(),
      post_.send(machine, LetterKind::order, written(order));
    else
      still.push_back(machine);
  }
  waiting_ = std::move(still);
}

/// Fetches what is to be added next while others render. The mutex must be held.
void Leader::fetch() {
  for (const auto& [machine, begin] : desk_.to_fetch()) {
    if (machine == 0) continue;
    const Rendered block{order_.interval, begin};
    asked_[block] = {machine, Clock::now()};
    post_.send(machine, LetterKind::bring, written(block));
  }
}

/// Reports machines that do not answer. A machine may take long to render, but its post answers at once. The mutex must
/// be held.
void Leader::look_for_silence() {
  for (const auto& [block, asked] : asked_)
    if (Clock::now() - asked.when > patience_) {
      failure_ = silence_of(asked.machine);
      is_silent_ = true;
    }
}

std::string Leader::silence_of(int machine) {
  const std::string& host = hosts_[machine];
  return fmt::format("{} has not answered for {}", host.empty() ? fmt::format("machine {}", machine) : host,
                     readable_time(patience_.count()));
}

}  // namespace dspm
