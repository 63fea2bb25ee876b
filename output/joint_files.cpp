#include "dspm/output/joint_files.h"

#include <stdexcept>
#include <string_view>
#include <utility>

#include "dspm/output/denoised.h"
#include "dspm/output/results.h"
#include "dspm/session/job/developed.h"

namespace dspm {
namespace {

/// Returns what a message says, without the program's name and the end of the line.
std::string said_in(std::string line) {
  constexpr std::string_view kWho = "dspm: ";
  if (line.starts_with(kWho)) line.erase(0, kWho.size());
  if (line.ends_with('\n')) line.pop_back();
  return line;
}

}  // namespace

Image denoised(const JointRender& render, int frame) {
  const Job& job = render.scene().job;
  if (!job.denoiser) throw UsageError("the scene was loaded without a denoiser, which takes outputs of its own");
  const auto& [stage, place] = render.place_of(frame);
  const Integrator& integrator = stage.integrator();
  Image image = denoised(*job.denoiser, integrator.estimate(place), integrator, place,
                         "the denoised image of " + render.labels()[static_cast<std::size_t>(frame)]);
  return developed(std::move(image), job);
}

std::vector<std::filesystem::path> write(const JointRender& render, const ImageFiles& files, const Warn& warn) {
  const FrameList& frames = render.scene().job.frames;
  Job job = render.scene().job;
  job.film.filename = files.outfile;
  if (files.half) job.film.save_half = *files.half;
  if (!files.frames.empty()) job.frames.clear();
  for (const int frame : files.frames) {
    render.place_of(frame);
    job.frames.push_back(frames[static_cast<std::size_t>(frame)]);
  }
  render.place_of(0);
  std::string said;
  const Warn keep = [&](const std::string& text) { said += text; };
  CalledMessages messages(keep);
  Results results(job, *render.scene().world, files.settings, {}, false, messages, [] { return false; });
  for (const Stage& stage : render.stages())
    results.write(stage.frames(), stage.integrator(), render.seconds(), Results::Images::so_far);
  if (!results.are_whole()) {
    results.report_missing();
    throw std::runtime_error(said_in(said));
  }
  if (!said.empty()) warn(said);
  return results.files();
}

}  // namespace dspm
