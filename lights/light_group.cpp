#include "dspm/lights/light_group.h"

#include <algorithm>

namespace dspm {

std::string read_light_group(ParamReader& params) {
  std::string group = params.text(kGroupParam, kOtherLights, "of lights whose light can be an output of its own");
  const auto is_plain = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
  };
  if (!group.empty() && std::all_of(group.begin(), group.end(), is_plain)) return group;
  params.error(kGroupParam, "a group's name consists of letters, digits, - and _, since layers of images carry it");
  return kOtherLights;
}

}  // namespace dspm
