#include "dspm/integrators/beside/surface_output_list.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "dspm/integrators/beside/coverage_ranks.h"

namespace dspm {
namespace {

/// Two ranks share the four channels of a layer. Their names are in lower case because lossy compression (dwaa, dwab)
/// takes channels named R, G and B for colours. [Cryptomatte specification 1.2.0, OpenEXR]
std::vector<OutputInfo> cryptomatte(const std::string& name, const std::string& layer, const char* of) {
  std::vector<OutputInfo> ranks;
  for (std::size_t rank = 0; rank < CoverageRanks::kRanks; ++rank) {
    OutputInfo& output = ranks.emplace_back();
    output.name = fmt::format("{}.{}", name, rank);
    for (const char channel : std::string(rank % 2 == 0 ? "rg" : "ba"))
      output.channels.push_back(fmt::format("{}{:02}.{}", layer, rank / 2, channel));
    output.sentence = fmt::format("ids of {} and the shares of the pixel that they cover, rank {}", of, rank);
    output.single = output.is_id = true;
    output.cryptomatte = layer;
  }
  return ranks;
}

using Table = std::array<std::vector<OutputInfo>, kSurfaceKinds>;

Table make_table() {
  Table table;
  const auto at = [&](SurfaceKind kind) -> std::vector<OutputInfo>& { return table[static_cast<std::size_t>(kind)]; };
  at(SurfaceKind::normal) = {
      {"N", {"N.X", "N.Y", "N.Z"}, "shading normal of the first surface, on the side that is seen"}};
  at(SurfaceKind::position) = {{"P", {"P.X", "P.Y", "P.Z"}, "its position", true}};
  at(SurfaceKind::depth) = {{"Z", {"Z"}, "its depth along the camera's axis, in world units; 1e10: no surface", true}};
  at(SurfaceKind::albedo) = {{"albedo", {"Albedo.R", "Albedo.G", "Albedo.B"}, "the share of light that it scatters"}};
  at(SurfaceKind::uv) = {{"uv", {"u", "v"}, "its texture coordinates", true}};
  at(SurfaceKind::object) = {{"object", {"object.X"}, "the id of the object that most of the pixel shows", true, true}};
  at(SurfaceKind::material) = {
      {"material", {"material.X"}, "the id of the material that most of the pixel shows", true, true}};
  at(SurfaceKind::alpha) = {{kAlphaOutput, {"A"}, "the share of the pixel's camera paths that meet a surface"}};
  at(SurfaceKind::crypto_object) = cryptomatte("cryptoobject", "CryptoObject", "objects");
  at(SurfaceKind::catcher) = {
      {kCatcherOutput, {"catcher.X"}, "the share of the pixel's camera paths that meet a shadow catcher first"}};
  at(SurfaceKind::motion_forward) = {{"motion.forward",
                                      {"forward.u", "forward.v"},
                                      "pixels to the right and up that what is seen moves until the next frame",
                                      true}};
  at(SurfaceKind::motion_backward) = {{"motion.backward",
                                       {"backward.u", "backward.v"},
                                       "pixels to the right and up to where what is seen was in the frame before",
                                       true}};
  at(SurfaceKind::crypto_material) = cryptomatte("cryptomaterial", "CryptoMaterial", "materials");
  at(SurfaceKind::denoising_normal) = {{kDenoisingNormal,
                                        {"DenoisingN.X", "DenoisingN.Y", "DenoisingN.Z"},
                                        "shading normal of the first rough surface, also in mirrors and behind glass"}};
  at(SurfaceKind::denoising_depth) = {
      {kDenoisingDepth, {"DenoisingZ.Z"}, "its depth, as if the way there were straight; 1e10: no surface", true}};
  at(SurfaceKind::denoising_albedo) = {{kDenoisingAlbedo,
                                        {"DenoisingAlbedo.R", "DenoisingAlbedo.G", "DenoisingAlbedo.B"},
                                        "the share of light that it scatters and that the way there leaves; 1: none"}};
  return table;
}

}  // namespace

const std::vector<OutputInfo>& outputs_of(SurfaceKind kind) {
  static const Table table = make_table();
  return table[static_cast<std::size_t>(kind)];
}

const std::vector<OutputInfo>& surface_outputs() {
  static const std::vector<OutputInfo> all = [] {
    std::vector<OutputInfo> outputs;
    for (int kind = 0; kind < kSurfaceKinds; ++kind)
      for (const OutputInfo& output : outputs_of(static_cast<SurfaceKind>(kind))) outputs.push_back(output);
    return outputs;
  }();
  return all;
}

std::vector<std::string> gbuffer_outputs() {
  std::vector<std::string> names;
  for (int kind = 0; kind < static_cast<int>(SurfaceKind::alpha); ++kind)
    names.push_back(outputs_of(static_cast<SurfaceKind>(kind)).front().name);
  return names;
}

std::vector<std::string> parts_of_output(const std::string& name) {
  std::vector<std::string> names;
  for (const OutputInfo& output : surface_outputs())
    if (output.name.starts_with(name + ".")) names.push_back(output.name);
  return names;
}

bool has_motion(const std::vector<std::string>& names) {
  const std::vector<std::string> parts = parts_of_output("motion");
  return std::any_of(names.begin(), names.end(), [&](const std::string& name) {
    return std::find(parts.begin(), parts.end(), name) != parts.end();
  });
}

}  // namespace dspm
