#include "dspm/output/report/run_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <string_view>
#include <utility>

#include "dspm/base/math/moments.h"
#include "dspm/base/system/json.h"
#include "dspm/base/system/memory_use.h"
#include "dspm/base/system/readable.h"
#include "dspm/base/system/version.h"
#include "dspm/output/report/emission_table.h"
#include "dspm/output/report/scaling_table.h"

namespace dspm {
namespace {

/// Returns the work that frames may share, with its names.
std::vector<std::pair<const char*, SharedCount>> shared_counts(const Statistics& s) {
  return {{"camera path segments", s.camera.segments},
          {"photon path segments", s.photon.segments},
          {"photons stored", s.photons_stored},
          {"gathers", s.gathers},
          {"photons found", s.photons_found}};
}

/// Turns "hit points" into "hit_points", as programs like it.
std::string key_of(std::string name) {
  std::replace(name.begin(), name.end(), ' ', '_');
  return name;
}

std::uint64_t rays(const PathCounts& paths) { return paths.segments.done + paths.shadow_rays; }

void add_steps(std::vector<StepTime>& sum, const std::vector<StepTime>& more) {
  for (const StepTime& step : more) {
    const auto same = std::find_if(sum.begin(), sum.end(), [&](const StepTime& s) { return s.name == step.name; });
    if (same == sum.end()) {
      sum.push_back(step);
    } else {
      same->seconds += step.seconds, same->work += step.work;
    }
  }
}

void write_paths(JsonWriter& json, const char* name, const PathCounts& paths) {
  json.key(name).begin_object();
  json.member("paths", paths.paths);
  json.member("dynamic_paths", paths.dynamic_paths);
  json.member("dynamic_share", paths.dynamic_share());
  json.member("segments", paths.segments.done);
  json.member("shadow_rays", paths.shadow_rays);
  json.member("weighted", paths.weighted);
  json.end_object();
}

void write_job(JsonWriter& json, const Job& job) {
  json.member("version", kVersion);
  json.member("scene", job.scene_file);
  json.member("integrator", job.integrator);
  json.member("seed", job.settings.seed);
  json.member("width", job.settings.width);
  json.member("height", job.settings.height);
  const PixelRect& crop = job.settings.crop;
  json.key("crop").begin_array();
  for (const int edge : {crop.x0, crop.x1, crop.y0, crop.y1}) json.value(edge);
  json.end_array();
  json.key("frames").begin_array();
  for (const FileFrame frame : job.frames) json.value(job.moment(frame).number());
  json.end_array();
  if (!job.description->axes.empty()) {
    json.key("variations").begin_array();  // one per frame
    for (const FileFrame frame : job.frames) json.value(job.variation(frame));
    json.end_array();
  }
}

void write_work(JsonWriter& json, const Statistics& s) {
  write_paths(json, "camera", s.camera);
  write_paths(json, "photon", s.photon);
  json.key("sharing").begin_object();
  for (const auto& [name, count] : shared_counts(s)) {
    json.key(key_of(name)).begin_object();
    json.member("done", count.done);
    json.member("separate", count.separate);
    json.member("factor", count.factor());
    json.end_object();
  }
  json.end_object();
  json.key("emission");
  write(json, s.emission);
  json.member("photon_tests", s.photon_tests);
  json.member("photons_at_typical_hit_point", s.typical.photons);
  json.member("invalid", s.rejections.count());
  json.key("counters").begin_object();
  for (const Counters::Entry& counter : s.counters) json.member(key_of(counter.name), counter.value);
  json.end_object();
}

/// Writes the energy of the frames that were rendered, in the order of the job.
void write_energy(JsonWriter& json, const RunReport& report) {
  std::map<FileFrame, const EnergyBalance*> of_frame;
  for (std::size_t i = 0; i < report.frames.size(); ++i) of_frame[report.frames[i]] = &report.statistics.energy[i];
  json.key("energy").begin_array();
  for (const auto& [frame, energy] : of_frame) {
    json.begin_object();
    json.member("emitted", energy->emitted);
    json.member("absorbed", energy->absorbed);
    json.member("escaped", energy->escaped);
    json.member("terminated", energy->terminated);
    json.member("roulette", energy->roulette);
    json.member("too_deep", energy->too_deep);
    json.end_object();
  }
  json.end_array();
}

void write_traffic(JsonWriter& json, const Traffic& traffic) {
  json.key("machines").begin_object();
  json.member("count", traffic.machines);
  json.member("bytes", traffic.bytes);
  json.member("bytes_an_iteration_and_frame", traffic.bytes_an_iteration_and_frame());
  json.end_object();
}

std::string count_line(std::string_view name, std::uint64_t count) {
  return fmt::format("  {:<24}{:>16}\n", name, grouped(count));
}

std::string table_of(const Traffic& traffic) {
  return count_line("machines", static_cast<std::uint64_t>(traffic.machines)) +
         count_line("bytes between them", traffic.bytes) +
         count_line("an iteration and frame", traffic.bytes_an_iteration_and_frame());
}

}  // namespace

void RunReport::add(const Statistics& interval, const std::vector<FileFrame>& of_interval) {
  Statistics& sum = statistics;
  iterations.push_back(interval.iterations);
  sum.iterations += interval.iterations;
  add_steps(sum.steps, interval.steps);
  sum.camera += interval.camera;
  sum.photon += interval.photon;
  sum.photons_stored += interval.photons_stored;
  sum.gathers += interval.gathers;
  sum.photon_tests += interval.photon_tests;
  sum.photons_found += interval.photons_found;
  sum.rejections += interval.rejections;
  sum.energy.insert(sum.energy.end(), interval.energy.begin(), interval.energy.end());
  if (!interval.energy.empty()) frames.insert(frames.end(), of_interval.begin(), of_interval.end());
  for (std::size_t j = 0; j < interval.errors.size(); ++j) errors[of_interval[j]] = interval.errors[j];
  if (iterations.size() == 1 || interval.typical.photons < sum.typical.photons) sum.typical = interval.typical;
  sum.counters += interval.counters;
  for (const EmissionReport& report : interval.emission) sum.emission.put(report);
  sum.bytes = std::max(sum.bytes, interval.bytes);
}

namespace {

/// Returns the iterations of one interval, or of the shortest and the longest if a time limit made them differ.
std::string iterations_in_words(const std::vector<int>& of_intervals) {
  if (of_intervals.empty()) return "0";
  const auto [least, most] = std::minmax_element(of_intervals.begin(), of_intervals.end());
  return *least == *most ? std::to_string(*most) : fmt::format("{} to {}", *least, *most);
}

}  // namespace

std::string table_of(const Job& job, const RunReport& report) {
  const Statistics& s = report.statistics;
  std::string text = fmt::format("{} {}, {}, {} iterations, {} threads\n\n", job.scene_file, job.integrator,
                                 job.frames_in_words(), iterations_in_words(report.iterations), report.threads);
  text += fmt::format("  {:<24}{:>16}{:>10}\n", "step", "seconds", "share");
  for (const StepTime& step : s.steps)
    text += fmt::format("  {:<24}{:>16.2f}{:>9.1f}%\n", step.name, step.seconds, 100 * step.seconds / report.seconds);
  text += fmt::format("  {:<24}{:>16.2f}\n\n", "total, with writing", report.seconds);
  text += scaling_table(report.around, s.steps);

  text += fmt::format("  {:<24}{:>16}{:>18}{:>10}\n", "work", "done", "separate renders", "factor");
  for (const auto& [name, count] : shared_counts(s))
    text += fmt::format("  {:<24}{:>16}{:>18}{:>10.2f}\n", name, grouped(count.done), grouped(count.separate),
                        count.factor());
  text += count_line("photon tests", s.photon_tests);
  for (const Counters::Entry& counter : s.counters) text += count_line(counter.name, counter.value);
  if (report.traffic.machines > 0) text += table_of(report.traffic);
  text += table_of(s.emission);
  text += fmt::format("\n  {:<24}{:>16}{:>18}\n", "paths", "camera", "photon");
  const auto line = [&](const char* name, std::uint64_t camera, std::uint64_t photon) {
    text += fmt::format("  {:<24}{:>16}{:>18}\n", name, grouped(camera), grouped(photon));
  };
  line("started", s.camera.paths, s.photon.paths);
  line("rays", rays(s.camera), rays(s.photon));
  text += fmt::format("  {:<24}{:>15.1f}%{:>17.1f}%\n", "met something dynamic", 100 * s.camera.dynamic_share(),
                      100 * s.photon.dynamic_share());
  line("weighted by frame", s.camera.weighted, s.photon.weighted);
  text += fmt::format("\n  memory: {} at most, of which trees {}, integrator {}\n", readable_bytes(peak_memory()),
                      readable_bytes(report.tree_bytes), readable_bytes(s.bytes));
  if (const std::uint64_t count = s.rejections.count(); count > 0)
    text += fmt::format("  {} contributions were negative or not finite and were left out\n", grouped(count));
  return text;
}

std::string json_of(const Job& job, const RunReport& report) {
  const Statistics& s = report.statistics;
  JsonWriter json;
  json.begin_object();
  write_job(json, job);
  json.member("threads", report.threads);
  json.member("exit_code", report.exit_code);
  json.key("iterations").begin_array();
  for (const int iterations : report.iterations) json.value(iterations);
  json.end_array();
  json.member("seconds", report.seconds);
  json.key("steps").begin_object();
  for (const StepTime& step : s.steps) json.member(key_of(step.name), step.seconds);
  json.end_object();
  json.key("work").begin_object();
  for (const StepTime& step : worked_steps(report.around, s.steps)) {
    json.key(key_of(step.name)).begin_object();
    json.member("seconds", step.work.all);
    json.member("span", step.work.span);
    json.end_object();
  }
  json.end_object();
  write_work(json, s);
  write_energy(json, report);
  if (!report.errors.empty()) {
    json.key("errors").begin_array();  // frame by frame
    for (const auto& [frame, error] : report.errors) json.value(error);
    json.end_array();
  }
  if (report.traffic.machines > 0) write_traffic(json, report.traffic);
  json.key("memory").begin_object();
  json.member("peak_bytes", peak_memory());
  json.member("tree_bytes", report.tree_bytes);
  json.member("integrator_bytes", s.bytes);
  json.end_object();
  json.end_object();
  return json.text() + "\n";
}

}  // namespace dspm
