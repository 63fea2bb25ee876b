#include "dspm/output/relight.h"

#include <fmt/format.h>

#include <algorithm>
#include <list>
#include <string>

#include "dspm/base/colour/rgb.h"
#include "dspm/base/params/errors.h"
#include "dspm/image/exr.h"
#include "dspm/image/image.h"
#include "dspm/integrators/output_info.h"
#include "dspm/output/layer_settings.h"

namespace dspm {
namespace {

using Names = std::vector<std::string>;

Names colours_of(const std::string& layer) { return {layer + ".R", layer + ".G", layer + ".B"}; }

bool holds(const ExrHeader& header, const std::string& channel) {
  return std::binary_search(header.channels.begin(), header.channels.end(), channel);
}

ExrPixels precision_of(const ExrHeader& header, const std::string& channel) {
  const auto at = std::lower_bound(header.channels.begin(), header.channels.end(), channel);
  return header.precisions[static_cast<std::size_t>(at - header.channels.begin())];
}

/// Returns the outputs of the file's groups; all must be there, or their sum would not be the image.
Names groups_in(const std::filesystem::path& file, const ExrHeader& header) {
  const auto text = header.texts.find(kLightGroupsText);
  if (text == header.texts.end())
    throw UsageError(fmt::format("--relight {}: the file has no layers of light groups (--aov lights)", file.string()));
  Names groups;
  for (std::size_t begin = 0, end = 0; end != text->second.npos; begin = end + 1) {
    end = text->second.find(',', begin);
    groups.push_back(text->second.substr(begin, end - begin));
    for (const std::string& channel : colours_of(groups.back()))
      if (!holds(header, channel))
        throw UsageError(fmt::format("--relight {}: the layer {} is missing; --aov lights writes all", file.string(),
                                     groups.back()));
  }
  return groups;
}

void check(const std::vector<GroupFactor>& factors, const Names& groups, const std::filesystem::path& file) {
  Names names;
  const std::string prefix = light_group_output("");
  for (const std::string& group : groups) names.push_back(group.substr(std::min(prefix.size(), group.size())));
  for (const GroupFactor& factor : factors)
    if (std::find(names.begin(), names.end(), factor.group) == names.end())
      throw UsageError(fmt::format("--relight {}: it has no light group \"{}\"; it has {}", file.string(), factor.group,
                                   fmt::join(names, ", ")));
}

/// Returns the product of all factors that name the group.
Rgb factor_of(const std::string& output, const std::vector<GroupFactor>& factors) {
  Rgb product(1);
  for (const GroupFactor& factor : factors)
    if (light_group_output(factor.group) == output) product *= factor.factor;
  return product;
}

/// Returns the other channels, as layers of up to three with the same precision.
std::vector<Names> rest_of(const ExrHeader& header, const Names& taken) {
  std::vector<Names> layers;
  for (const std::string& channel : header.channels) {
    if (std::find(taken.begin(), taken.end(), channel) != taken.end()) continue;
    const bool begins = layers.empty() || layers.back().size() == 3 ||
                        precision_of(header, layers.back().front()) != precision_of(header, channel);
    if (begins) layers.emplace_back();
    layers.back().push_back(channel);
  }
  return layers;
}

}  // namespace

void relight(const std::filesystem::path& from, const std::vector<GroupFactor>& factors,
             const std::filesystem::path& to) {
  const ExrHeader header = read_exr_header(from);
  const Names groups = groups_in(from, header);
  check(factors, groups, from);
  std::list<Image> images;
  std::vector<ExrLayer> layers;
  Names taken;
  const auto add = [&](Image image, const Names& channels) {
    images.push_back(std::move(image));
    layers.push_back({channels, &images.back(), precision_of(header, channels.front())});
    taken.insert(taken.end(), channels.begin(), channels.end());
  };
  Image sum;
  for (const std::string& group : groups) {
    Image part = read_exr_channels(from, colours_of(group));
    const Rgb factor = factor_of(group, factors);
    if (sum.empty()) sum = Image(part.width, part.height);
    for (std::size_t i = 0; i < part.pixels.size(); ++i) sum.pixels[i] += part.pixels[i] *= factor;
    add(std::move(part), colours_of(group));
  }
  // Groups of a spectral render may be negative where their colours lie outside Rec. 709; images are not.
  for (Rgb& pixel : sum.pixels) pixel = map(pixel, [](float c) { return std::max(c, 0.f); });
  add(std::move(sum), {"R", "G", "B"});
  for (const Names& channels : rest_of(header, taken)) add(read_exr_channels(from, channels), channels);
  write_exr(to, layers, header, header.format);
}

}  // namespace dspm
