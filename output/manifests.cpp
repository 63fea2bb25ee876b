#include "dspm/output/manifests.h"

#include <fmt/format.h>

#include <bit>
#include <map>
#include <set>
#include <span>
#include <string>

#include "dspm/base/colour/rgb.h"
#include "dspm/base/system/json.h"

namespace dspm {
namespace {

/// Collects the ids in a layer's first channel: a rank of a Cryptomatte has its shares in the second.
void add_shown(const OutputLayer& layer, std::set<float>& ids) {
  for (const Rgb& pixel : layer.image.pixels) ids.insert(pixel.r);
}

/// Returns {"ball": "3fa2c014"} and the like.
std::string manifest_of(std::span<const std::string> names, const std::set<float>& shown) {
  JsonWriter json;
  json.begin_object();
  for (const std::string& name : names)
    if (const float id = id_of(name); shown.contains(id))
      json.member(name, fmt::format("{:08x}", std::bit_cast<std::uint32_t>(id)));
  json.end_object();
  return json.text();
}

struct Ids {
  std::span<const std::string> names;
  std::set<float> shown;
};

}  // namespace

void add_manifests(const std::vector<const OutputLayer*>& layers, ExrHeader& header) {
  std::map<std::string, Ids> cryptomattes;
  for (const OutputLayer* layer : layers) {
    if (!layer->info.is_id) continue;
    Ids own{layer->info.names, {}};
    Ids& ids = layer->info.cryptomatte.empty() ? own : cryptomattes[layer->info.cryptomatte];
    ids.names = layer->info.names;
    add_shown(*layer, ids.shown);
    if (layer->info.cryptomatte.empty())
      header.texts[layer->info.name + " manifest"] = manifest_of(ids.names, ids.shown);
  }
  for (const auto& [name, ids] : cryptomattes) {
    // Seven digits tell apart what is in a file, as the specification has it.
    const std::string key = "cryptomatte/" + fmt::format("{:08x}", name_hash(name)).substr(0, 7);
    header.texts[key + "/name"] = name;
    header.texts[key + "/hash"] = "MurmurHash3_32";
    header.texts[key + "/conversion"] = "uint32_to_float32";
    header.texts[key + "/manifest"] = manifest_of(ids.names, ids.shown);
  }
}

}  // namespace dspm
