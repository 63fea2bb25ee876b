// The live page of a render, for its observer: what it says to the page and what viewers ask of it. The thread that
// renders calls most functions, between iterations; pictures are taken only if someone looks.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "dspm/base/math/frames.h"
#include "dspm/image/image.h"
#include "dspm/integrators/integrator.h"
#include "dspm/looking/serve/board.h"
#include "dspm/looking/serve/gallery.h"
#include "dspm/looking/serve/orders.h"
#include "dspm/looking/serve/ration.h"
#include "dspm/looking/serve/server.h"
#include "dspm/output/view.h"
#include "dspm/session/frame_intervals.h"
#include "dspm/session/job/job.h"
#include "dspm/session/messages.h"
#include "dspm/session/observer.h"
#include "dspm/world/scene/scene.h"

namespace dspm {

/// The progress of the whole run.
struct Outlook {
  double share = 0;                         // of its work; 0: unknown
  double seconds = 0;                       // so far
  std::optional<double> seconds_left = {};  // if it is known
};

/// An interval's frames and the integrator that holds their images.
struct Exhibit {
  const FrameList& interval;
  const Integrator& integrator;
  int iterations;
};

class LivePage {
 public:
  /// Throws std::runtime_error if it cannot listen there.
  LivePage(const ServeAddress& address, const ViewSettings& view)
      : view_(view), server_(address, gallery_, board_, orders_) {}

  std::string url() const { return server_.url(); }

  // By any thread:
  void say(std::string_view text) { board_.add_line(std::string(text)); }
  /// Says why the scene cannot be rendered; empty if it can.
  void show_problem(std::string text) { board_.set_problem(std::move(text)); }
  /// Restarts, because the scene has changed: the run is out of date.
  void restart();
  bool is_restarting() const { return orders_.is_restarting(); }
  /// Returns where viewers put the camera. camera_changes() is how often they did.
  std::optional<LookAt> camera() const { return orders_.camera(); }
  int camera_changes() const { return orders_.camera_changes(); }
  void reset_camera() {
    if (orders_.camera()) orders_.place_camera(std::nullopt);
  }
  /// Begins to read the scene: a restart is no longer due.
  void begin();
  /// Waits until the scene can be read. Returns false if the end is wanted.
  bool wait_for_restart(const std::function<bool()>& interrupted);

  // By the thread that renders:

  /// Begins a run of `job`, which must outlive it. If it is `coarse`, it is a quick look before that of the full size,
  /// and the page goes on counting in pixels of the full size.
  void begin_run(const Job& job, const Scene& scene, const Integrator& integrator, int iterations, bool coarse);
  void step_begins(const std::string& step);
  void iteration_done(const IntervalProgress& progress, const Exhibit& exhibit, const Outlook& outlook);
  /// Keeps small pictures of frames whose integrator is about to go.
  void interval_ends(const Exhibit& exhibit);
  /// Waits, after the last interval, until someone wants more iterations, and returns how many; 0 if the end is wanted.
  /// `interrupted` says whether to stop waiting.
  int wait_for_more(const Exhibit& exhibit, const std::function<bool()>& interrupted);
  /// Waits as long as the run is paused.
  void wait_while_paused(const Exhibit& exhibit, const std::function<bool()>& interrupted);

  bool end_wanted() const { return orders_.is_stopping() || orders_.is_restarting(); }
  bool images_wanted() { return orders_.take_write(); }

 private:
  enum class Size { wished, affordable };
  /// Takes and shows the pictures that Gallery::wanted(iterations) asks for.
  void show_pictures(const Exhibit& exhibit, int iterations, Size size = Size::wished);
  int halvings_to_afford(const std::vector<Wish>& wishes) const;
  double pixels_of(const std::vector<Wish>& wishes, int shrunk) const;
  struct Taken {
    Wish wish;
    const OutputInfo* output;
    Image image;
  };
  void take(const Exhibit& exhibit, const std::vector<Wish>& wishes, int shrunk = 0);
  std::optional<Taken> take_one(const Exhibit& exhibit, const Wish& wish) const;
  Picture picture_of(Taken taken, int shrunk) const;
  /// Returns the halvings from the page's size to that of the run.
  int halvings() const;
  void show_state(const char* phase);

  const ViewSettings view_;
  Gallery gallery_;
  Board board_;
  Orders orders_;
  const Job* job_ = nullptr;
  std::vector<OutputInfo> outputs_;
  bool coarse_ = false, guided_ = true;
  int run_ = 0, iterations_ = 0;
  IntervalProgress progress_;
  Outlook outlook_;
  std::string step_;
  Ration pictures_{0.012};
  double begin_ = 0;                 // of the run, in processor time
  double looking_ = 0, pixels_ = 0;  // processor time that pictures took, and what they showed
  Server server_;                    // last: its threads use the others
};

/// Messages that appear on the page, too.
class LiveMessages final : public Messages {
 public:
  LiveMessages(bool quiet, LivePage& page) : Messages(quiet), page_(page) {}

 protected:
  void print(std::string_view text) const override {
    Messages::print(text);
    page_.say(text);
  }

 private:
  LivePage& page_;
};

}  // namespace dspm
