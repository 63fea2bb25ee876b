#include "dspm/image/exr_channels.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <map>
#include <stdexcept>

namespace dspm {
namespace {

/// Returns a name within its layer, "red" of "key.red", as R, G, B or A, as most programs write it; other names stay
/// unchanged.
std::string usual_name(std::string name) {
  for (char& c : name) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  for (const char* word : {"red", "green", "blue", "alpha"})
    if (name == word || name == std::string(1, *word)) return std::string(1, static_cast<char>(std::toupper(*word)));
  return name;
}

/// The names of red, green and blue by layer ("" or "ViewLayer.Combined."); empty if there is none.
using ColourLayers = std::map<std::string, std::array<std::string, 3>>;

ColourLayers colour_layers(const std::vector<std::string>& names) {
  ColourLayers layers;
  for (const std::string& name : names) {
    const std::size_t begin = name.rfind('.') + 1;  // npos + 1 is 0
    const std::string usual = usual_name(name.substr(begin));
    if (usual.size() != 1) continue;
    if (const std::size_t channel = std::string("RGB").find(usual); channel != std::string::npos)
      layers[name.substr(0, begin)][channel] = name;
  }
  std::erase_if(layers, [](const auto& layer) {
    const auto& [red, green, blue] = layer.second;
    return red.empty() || green.empty() || blue.empty();
  });
  return layers;
}

bool is_alpha(const std::string& name) { return usual_name(name.substr(name.rfind('.') + 1)) == "A"; }

}  // namespace

std::vector<std::string> colour_channels(const Imf::ChannelList& channels) {
  std::vector<std::string> names;
  for (auto c = channels.begin(); c != channels.end(); ++c) names.emplace_back(c.name());
  const auto has = [&](const char* name) { return channels.findChannel(name) != nullptr; };
  if (has("R") && has("G") && has("B")) return {"R", "G", "B"};
  if (has("Y") && has("RY") && has("BY")) return {"Y", "RY", "BY"};
  if (has("Y")) return {"Y"};
  const ColourLayers layers = colour_layers(names);
  const auto unnamed = layers.find("");
  if (unnamed != layers.end() || layers.size() == 1) {
    const auto& layer = unnamed != layers.end() ? unnamed->second : layers.begin()->second;
    return {layer.begin(), layer.end()};
  }
  std::vector<std::string> others = names;
  if (names.size() > 1) std::erase_if(others, is_alpha);
  if (others.size() == 1) return others;
  std::string there;
  for (const std::string& name : names) there += " " + name;
  throw std::runtime_error("it has neither the channels R, G, B nor Y, nor one channel alone, but:" + there);
}

}  // namespace dspm
