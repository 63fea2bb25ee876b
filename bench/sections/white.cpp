// White principled materials in a white furnace: which share of the light from one direction they give back.
#include <algorithm>

#include "bench/report/table.h"
#include "bench/sections/sections.h"
#include "dspm/base/colour/rgb.h"
#include "dspm/base/math/vec.h"
#include "dspm/testing/scattering.h"
#include "dspm/testing/scattering_cases.h"

namespace dspm {
namespace {

struct White {
  const char* name;
  const char* words;  // of a principled material
  float side = 1;
};

constexpr White kWhite[] = {
    {"metal", R"("float metallic" 1)"},
    {"metal, anisotropy 0.8", R"("float metallic" 1 "float anisotropy" 0.8)"},
    {"metal, anisotropy 1", R"("float metallic" 1 "float anisotropy" 1)"},
    {"metal under a smooth coat", R"("float metallic" 1 "float coat" 1)"},
    {"metal under a rough coat", R"("float metallic" 1 "float coat" 1 "float coatroughness" 0.5)"},
    {"metal under sheen", R"("float metallic" 1 "rgb sheen" [1 1 1] "float sheenroughness" 0.6)"},
    {"metal under coat and sheen", R"("float metallic" 1 "float coat" 1 "rgb sheen" [1 1 1])"},
    {"metal, anisotropy 0.8, under a coat", R"("float metallic" 1 "float anisotropy" 0.8 "float coat" 1)"},
    {"plastic, anisotropy 0.8", R"("float anisotropy" 0.8)"},
    {"varnished plastic", R"("float coat" 1)"},
    {"glass under a coat", R"("float transmission" 1 "float coat" 1)"},
    {"the same from inside", R"("float transmission" 1 "float coat" 1)", -1},
    {"glass under sheen", R"("float transmission" 1 "rgb sheen" [1 1 1] "float sheenroughness" 0.6)"},
    {"the same from inside", R"("float transmission" 1 "rgb sheen" [1 1 1] "float sheenroughness" 0.6)", -1},
    {"glass, anisotropy 0.8", R"("float transmission" 1 "float anisotropy" 0.8)"},
    {"the same from inside", R"("float transmission" 1 "float anisotropy" 0.8)", -1},
    {"glass under a film", R"("float transmission" 1 "float iridescence" 1 "float iridescenceeta" 1.8)"},
    {"the same from inside", R"("float transmission" 1 "float iridescence" 1 "float iridescenceeta" 1.8)", -1},
};

/// The least and the most of all directions and colours.
std::string range(const White& white, float roughness, int samples) {
  const auto material = test::material_of(
      fmt::format(R"("principled" "rgb basecolor" [1 1 1] "float roughness" {} {})", roughness, white.words));
  BsdfSlot slot;
  const Bsdf& bsdf = material->bsdf(test::surface(), slot);
  const PathRandom random(1, Stream::setup, 0, 0);
  float least = 2, most = 0;
  for (const float cos : {0.1f, 0.2f, 0.3f, 0.4f, 0.5f, 0.6f, 0.7f, 0.8f, 0.9f, 1.f})
    for (const float phi : {0.f, 0.8f, 1.57f}) {
      const Vec3 wo = test::direction(white.side * cos, phi);
      const Spectrum mean = test::albedo(bsdf, wo, Transport::flux, random, samples).mean;
      least = std::min({least, mean[0], mean[1], mean[2]}), most = std::max(most, max_component(mean));
    }
  return fmt::format("{:.3f} to {:.3f}", least, most);
}

}  // namespace

Findings measure_white(const Setup& setup) {
  constexpr float kRoughness[] = {0, 0.3f, 0.6f, 1};
  Table table({"roughness", "0", "0.3", "0.6", "1"});
  for (const White& white : kWhite) {
    std::vector<std::string> cells{white.name};
    for (const float roughness : kRoughness) cells.push_back(range(white, roughness, setup.quick ? 2000 : 40'000));
    table.row(cells);
  }
  return {table.text(), {}};
}

}  // namespace dspm
