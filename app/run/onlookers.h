// Shows a render to those who watch it while it goes on: a viewer that speaks tev's protocol, and the terminal.
#pragma once

#include <chrono>
#include <memory>
#include <string>

#include "dspm/app/options/onlooker_settings.h"
#include "dspm/looking/display_server.h"
#include "dspm/looking/preview.h"
#include "dspm/output/contact_sheet.h"
#include "dspm/output/sheet_places.h"
#include "dspm/output/view.h"
#include "dspm/session/frame_intervals.h"
#include "dspm/session/job/job.h"
#include "dspm/session/messages.h"
#include "dspm/session/observer.h"

namespace dspm {

class Onlookers {
 public:
  /// Throws std::runtime_error if the address makes no sense. Warns if the terminal shows no images.
  Onlookers(const Job& job, const OnlookerSettings& settings, const View& view, Messages& messages);
  ~Onlookers();
  Onlookers(const Onlookers&) = delete;
  Onlookers& operator=(const Onlookers&) = delete;

  /// Returns what they may hold at a time: images on their way to the server, and those of the preview.
  static std::size_t bytes_at_most(const Job& job, const OnlookerSettings& settings);

  bool any() const { return server_ != nullptr || terminal_ != nullptr; }
  /// Shows the images of an interval, unless looking has taken more than its share of the time; the last ones always.
  void look(const FrameList& interval, const Integrator& integrator, bool last);

 private:
  struct Terminal;
  /// Returns whether there is time to look: looking takes a twentieth of the time at most, apart from the first time
  /// and the last.
  bool can_be_afforded() const;
  void send(const FrameList& interval, const Integrator& integrator);
  void draw(const FrameList& interval, const Integrator& integrator);
  void tell_fault();

  const Job& job_;
  const View view_;
  Messages& messages_;
  std::unique_ptr<DisplayServer> server_;
  std::unique_ptr<Terminal> terminal_;
  std::string address_;
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
  std::chrono::steady_clock::duration spent_{};
};

}  // namespace dspm
