#include "dspm/output/layer_settings.h"

#include <fmt/format.h>

#include <algorithm>

#include "dspm/base/params/errors.h"
#include "dspm/integrators/beside/surface_outputs.h"

namespace dspm {
namespace {

bool is_among(std::string_view name, const std::vector<std::string>& names) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// Throws UsageError unless the name is one of the labels, and not just a part of several outputs.
void expect_output(const char* option, const std::string& name, const std::vector<std::string>& outputs) {
  const std::vector<std::string> labels = file_labels(outputs);
  if (is_among(name, labels)) return;
  const std::string all =
      labels.empty() ? "there are none (--aov)" : fmt::format("there are {}", fmt::join(labels, ", "));
  throw UsageError(
      fmt::format("{}={}: no output \"{}\" is to be written besides radiance; {}", option, name, name, all));
}

}  // namespace

std::string_view file_label(std::string_view output) { return output.substr(0, output.find('.')); }

std::vector<std::string> file_labels(const std::vector<std::string>& outputs) {
  std::vector<std::string> labels;
  for (const std::string& output : outputs)
    if (const std::string label(file_label(output)); !is_among(label, labels)) labels.push_back(label);
  return labels;
}

void LayerSettings::compress(const std::string& name) {
  const std::optional<ExrCompression> compression = exr_compression(name);
  if (!compression)
    throw UsageError(fmt::format("--compression {}: it is none, rle, zips, zip, piz, dwaa or dwab", name));
  exr.compression = *compression;
}

void LayerSettings::check(const std::vector<std::string>& outputs) const {
  for (const std::string& name : singles) expect_output("--float", name, outputs);
  for (const std::string& name : halves) {
    expect_output("--half", name, outputs);
    if (is_among(name, singles))
      throw UsageError(fmt::format("--half={} and --float={} contradict each other", name, name));
    for (const OutputInfo& output : surface_outputs())
      if (output.is_id && file_label(output.name) == name)
        throw UsageError(fmt::format("--half={}: ids are bits of a float, which a half would change", name));
  }
}

ExrPixels LayerSettings::pixels_of(const OutputInfo& output, const FilmSettings& film) const {
  const std::string_view label = file_label(output.name);
  if (output.is_id || is_among(label, singles)) return ExrPixels::single;
  if (is_among(label, halves)) return ExrPixels::half;
  return output.single ? ExrPixels::single : film.save_half ? ExrPixels::half : ExrPixels::single;
}

}  // namespace dspm
