// The machine that leads: it renders as the others do, adds up everybody's blocks, and is the only one that writes
// images and checkpoints, shows progress and answers to its user.
#pragma once

#include <array>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>

#include "dspm/integrators/integrator.h"
#include "dspm/session/machines/desk.h"
#include "dspm/session/machines/post.h"
#include "dspm/session/stage.h"

namespace dspm {

/// Thrown if another machine cannot go on.
class MachineFailed final : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

class Leader {
 public:
  /// The states that it holds besides two integrators: the state before any iteration, and blocks whose turn has not
  /// come.
  static constexpr std::size_t kStates = 1 + Desk::kMostHeld + Desk::kAhead + 1;
  /// The seconds that a machine may take to send a block that it has, or to say goodbye: far longer than any network
  /// does.
  static constexpr double kPatience = 600;

  /// `end_wanted` returns whether the user wants an end; a block that another machine is still rendering is then not
  /// waited for. `patience` is in seconds.
  Leader(Link& link, std::function<bool()> end_wanted, double patience = kPatience);
  /// Ends as end() does, but throws nothing.
  ~Leader();

  /// Tells all others that the render is over, and waits until they have nothing more to say: MPI does not end before
  /// their last letters are taken. If one does not answer, abandons the link and throws MachineFailed.
  void end();

  /// Sets the digest of the scene; call it before the first order. Helpers whose scene has another one fail.
  void expect(std::string digest);
  /// Tells the others that the scene was edited and that they must read it anew, before the next expect(). Must not be
  /// called while an interval is shared out.
  void begin_anew(const std::optional<std::array<double, 9>>& look_at);

  /// The number of an interval's iterations (0 means endless), and the size of the blocks in which they are shared out;
  /// see Block::from.
  struct Extent {
    int iterations, block;
  };
  /// Returns an integrator that stands for what all machines together do of an interval: its iterate(i) leaves it with
  /// iteration i and all that follow in its block. Its iterate() throws MachineFailed. It must outlive neither the leader
  /// nor the `stage`, whose integrators the two are.
  /// `sum` adds up everybody's blocks, `own`, which is alike, renders the leader's; both must be made with
  /// RenderSettings::learn_at_once, or each block would learn anew. `memory` is the number of bytes that each machine's
  /// integrator may hold; 0 means that there is no bound.
  std::unique_ptr<Integrator> share_out(std::unique_ptr<Integrator> sum, std::unique_ptr<Integrator> own,
                                        Stage& stage, std::size_t memory, const Extent& extent);

  int machines() const { return link_.machines(); }
  /// The bytes that went between the machines so far.
  std::uint64_t bytes() const { return post_.bytes(); }

 private:
  class SharedIterations;

  void open(Letter letter);
  void serve();
  void fetch();
  void go_on() { fetch(), serve(); }
  void look_for_silence();
  std::string silence_of(int machine);

  using Clock = std::chrono::steady_clock;
  struct Asked {
    int machine;
    Clock::time_point when;
  };

  Link& link_;
  std::function<bool()> end_wanted_;
  std::chrono::duration<double> patience_;
  std::mutex mutex_;  // of all that follows but the post
  std::condition_variable changed_;
  Desk desk_;
  Edition edition_;
  std::uint64_t first_interval_ = 1;  // of the edition
  Order order_;                       // but for its block: the interval that is being rendered
  std::optional<std::string> digest_;
  std::deque<int> waiting_;           // machines that have asked for an order
  std::deque<Letter> ready_;          // letters that came before the leader knew its own scene
  std::map<int, std::string> hosts_;  // of machines
  std::map<Rendered, Asked> asked_;   // for blocks that have not come yet
  bool is_silent_ = false;            // one of them
  std::string failure_;
  std::set<int> gone_;  // machines
  bool has_ended_ = false;
  Post post_;  // the last member: its thread uses the others
};

}  // namespace dspm
