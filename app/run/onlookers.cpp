#include "dspm/app/run/onlookers.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <mutex>
#include <stdexcept>
#include <utility>

#include "dspm/base/math/frames.h"
#include "dspm/base/math/moments.h"
#include "dspm/base/system/message_listener.h"
#include "dspm/output/image_name.h"
#include "dspm/session/job/developed.h"

namespace dspm {
namespace {

constexpr int kShare = 20;  // of the time, as a divisor

}  // namespace

struct Onlookers::Terminal {
  Terminal(const TerminalGraphics& graphics, const Job& job)
      : preview(graphics, size_of_terminal(STDERR_FILENO)),
        style{.max_width = preview.width(), .lines = static_cast<int>(job.frames.size())},  // on one page
        places(SheetPlaces::suited(job, job.settings.crop.width(), job.settings.crop.height(), style)),
        sheet(places.layout(job.settings.crop.width(), job.settings.crop.height(), style)) {
    listen_to_messages([this](std::string_view text) {
      const std::lock_guard lock(mutex);
      preview.text_follows(text);
    });
  }
  ~Terminal() { listen_to_messages({}); }
  Terminal(const Terminal&) = delete;
  Terminal& operator=(const Terminal&) = delete;

  std::mutex mutex;
  Preview preview;
  SheetStyle style;
  SheetPlaces places;
  ContactSheet sheet;
};

Onlookers::Onlookers(const Job& job, const OnlookerSettings& settings, const View& view, Messages& messages)
    : job_(job), view_(view), messages_(messages), address_(settings.display_server) {
  if (!address_.empty()) server_ = std::make_unique<DisplayServer>(address_);
  if (!settings.preview) return;
  const TerminalGraphics graphics = graphics_of_standard_error();
  if (graphics.kind == Graphics::none)
    messages.warn("--preview shows nothing: this terminal knows neither kitty's images nor sixels");
  else
    terminal_ = std::make_unique<Terminal>(graphics, job);
}

Onlookers::~Onlookers() = default;

std::size_t Onlookers::bytes_at_most(const Job& job, const OnlookerSettings& settings) {
  constexpr std::size_t kFloats = 3 * sizeof(float);
  const auto pixels = static_cast<std::size_t>(job.settings.crop.count());
  const std::size_t frames = std::min<std::size_t>(job.frames.size(), kMaxFrames);
  std::size_t bytes = 0;
  // What waits for the server is sent whole before there is more.
  if (!settings.display_server.empty()) bytes += pixels * kFloats * (frames * (1 + job.outputs.size()) + 1);
  if (settings.preview) {
    const TerminalSize terminal = size_of_terminal(STDERR_FILENO);
    const auto shown = static_cast<std::size_t>(terminal.columns * terminal.cell_width) *
                       static_cast<std::size_t>(terminal.rows * terminal.cell_height);
    constexpr std::size_t kSheetAndText = 3 * kFloats;
    bytes += 2 * pixels * kFloats + shown * kSheetAndText;
  }
  return bytes;
}

bool Onlookers::can_be_afforded() const { return spent_ * kShare <= std::chrono::steady_clock::now() - begin_; }

void Onlookers::look(const FrameList& interval, const Integrator& integrator, bool last) {
  tell_fault();
  if (!last && !can_be_afforded()) return;
  const auto begin = std::chrono::steady_clock::now();
  if (server_ && (last || server_->is_ready())) send(interval, integrator);
  if (terminal_) draw(interval, integrator);
  spent_ += std::chrono::steady_clock::now() - begin;
}

void Onlookers::send(const FrameList& interval, const Integrator& integrator) {
  const std::vector<std::string>& asked = job_.outputs;
  for (std::size_t j = 0; j < interval.size(); ++j) {
    const auto frame = static_cast<Frame>(j);
    const FileFrame of_file = interval[j];
    const std::string name =
        image_name(job_.film.filename, job_.numbered ? std::optional(job_.moment(of_file)) : std::nullopt,
                   job_.variation(of_file))
            .filename()
            .string();
    server_->show(name, developed(integrator.estimate(frame), job_), {"R", "G", "B"});
    for (const OutputInfo& output : integrator.outputs())
      if (std::find(asked.begin(), asked.end(), output.name) != asked.end())
        server_->show(name + " " + output.name, integrator.estimate(frame, output.name), output.channels);
  }
}

void Onlookers::draw(const FrameList& interval, const Integrator& integrator) {
  for (std::size_t j = 0; j < interval.size(); ++j)
    terminal_->sheet.put(terminal_->places.of(interval[j]),
                         view_.shown(to_be_shown(integrator, static_cast<Frame>(j), job_)),
                         job_.description->frames.label(interval[j]));
  const std::lock_guard lock(terminal_->mutex);
  terminal_->preview.fit_into(size_of_terminal(STDERR_FILENO));
  print_picture(terminal_->preview.show(terminal_->sheet.image()));
}

void Onlookers::tell_fault() {
  if (!server_) return;
  if (const std::string fault = server_->take_fault(); !fault.empty())
    messages_.warn(fmt::format("the display server {} shows nothing ({}); it is tried again as rendering goes on",
                               address_, fault));
}

}  // namespace dspm
