// What LookAts name: found when the whole scene has been read, because a camera comes before what it looks at.
#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "dspm/lang/scene_builder.h"

namespace dspm {
namespace {

constexpr int kMostAims = 3;

/// The places of all that have that name, of the first kind that any has.
std::vector<Motion> places_named(const std::string& name, const SceneDescription& scene,
                                 const std::map<std::string, std::vector<Motion>>& blocks) {
  if (const auto found = scene.coordinate_systems.find(name); found != scene.coordinate_systems.end())
    return {found->second};
  if (const auto found = blocks.find(name); found != blocks.end()) return found->second;
  std::vector<Motion> places;
  for (const ShapeUse& shape : scene.shapes)
    if (shape.name == name) places.push_back(shape.world_from_object);
  if (places.empty())
    for (const LightUse& light : scene.lights)
      if (light.name == name) places.push_back(light.world_from_light);
  return places;
}

std::vector<std::string> all_names(const SceneDescription& scene,
                                   const std::map<std::string, std::vector<Motion>>& blocks) {
  std::set<std::string> names;
  for (const auto& [name, motion] : scene.coordinate_systems) names.insert(name);
  for (const auto& [name, motions] : blocks) names.insert(name);
  for (const ShapeUse& shape : scene.shapes) names.insert(shape.name);
  for (const LightUse& light : scene.lights) names.insert(light.name);
  names.erase("");
  return {names.begin(), names.end()};
}

/// How many LookAts lead from one to the next; more than kMostAims if they lead in a circle.
class Aims {
 public:
  int from(const NamedPlace& place) {
    const auto [known, is_new] = known_.try_emplace(&place, kMostAims + 1);  // until it is known: a circle
    if (!is_new) return known->second;
    int most = 1;
    if (place.world_from_place)
      for (const auto& next : place.world_from_place->named_places()) most = std::max(most, 1 + from(*next));
    return known_[&place] = std::min(most, kMostAims + 1);
  }

 private:
  std::map<const NamedPlace*, int> known_;
};

}  // namespace

void SceneBuilder::find_named_places() {
  for (const auto& [name, place] : named_places_) {
    const std::vector<Motion> places = places_named(name, scene_, ends_of_blocks_);
    if (places.empty()) {
      const std::string guess = did_you_mean(name, all_names(scene_, ends_of_blocks_));
      diagnostics_.error(place->where, fmt::format("nothing to look at is named \"{}\"", name),
                         guess.empty() ? "it may be a Dynamic block, a shape or a light with a \"string name\", or a "
                                         "CoordinateSystem"
                                       : guess);
    } else if (std::any_of(places.begin(), places.end(), [&](const Motion& m) { return m != places.front(); })) {
      diagnostics_.error(place->where,
                         fmt::format("{} things with places of their own are named \"{}\"", places.size(), name),
                         "give one of them a name that no other has, or name its place: CoordinateSystem \"there\"");
    } else {
      place->world_from_place = std::make_shared<const Motion>(places.front());
    }
  }
  Aims aims;
  std::vector<NamedPlace*> too_far;
  for (const auto& [name, place] : named_places_)
    if (aims.from(*place) > kMostAims) too_far.push_back(place.get());
  for (NamedPlace* place : too_far) {
    diagnostics_.error(place->where,
                       fmt::format("the place of \"{}\" depends on LookAts that lead back to it, or on more than {}",
                                   place->name, kMostAims),
                       "give one of them its eye and target in numbers");
    place->world_from_place.reset();
  }
}

}  // namespace dspm
