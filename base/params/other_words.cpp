#include "dspm/base/params/other_words.h"

#include <algorithm>
#include <cctype>

namespace dspm {
namespace {

struct Meaning {
  std::string_view word, ours;
};

// Words of pbrt-v3, Mitsuba, Blender, glTF and Arnold, in lower case and without what separates their parts.
constexpr Meaning kMeanings[] = {
    {"glass", "dielectric"},
    {"roughglass", "dielectric"},
    {"roughdielectric", "dielectric"},
    {"water", "dielectric"},
    {"thinglass", "thindielectric"},
    {"plastic", "coateddiffuse"},
    {"plastic", "principled"},
    {"roughplastic", "coateddiffuse"},
    {"substrate", "coateddiffuse"},
    {"glossy", "principled"},
    {"uber", "principled"},
    {"disney", "principled"},
    {"principledbsdf", "principled"},
    {"principledbrdf", "principled"},
    {"standardsurface", "principled"},
    {"openpbr", "principled"},
    {"pbr", "principled"},
    {"metallicroughness", "principled"},
    {"metal", "conductor"},
    {"mirror", "conductor"},
    {"roughconductor", "conductor"},
    {"matte", "diffuse"},
    {"lambert", "diffuse"},
    {"lambertian", "diffuse"},
    {"orennayar", "diffuse"},
    {"translucent", "diffusetransmission"},
    {"difftrans", "diffusetransmission"},
    {"phong", "principled"},
    {"velvet", "principled"},
    {"sss", "subsurface"},
    {"blend", "mix"},
    {"blendbsdf", "mix"},
    {"pinhole", "perspective"},
    {"thinlens", "perspective"},
    {"environment", "spherical"},
    {"environment", "infinite"},
    {"envmap", "infinite"},
    {"sky", "infinite"},
    {"sun", "distant"},
    {"directional", "distant"},
    {"ies", "goniometric"},
    {"area", "diffuse"},
    {"ply", "plymesh"},
    {"obj", "objmesh"},
    {"mesh", "trianglemesh"},
    {"hair", "curve"},
    {"image", "imagemap"},
    {"bitmap", "imagemap"},
    {"imagetexture", "imagemap"},
    {"noise", "fbm"},
    {"ao", "ambientocclusion"},
    {"pathtracer", "path"},
    {"volpathmis", "path"},
    {"basecolorfactor", "basecolor"},
    {"diffusecolor", "basecolor"},
    {"metalness", "metallic"},
    {"metallicfactor", "metallic"},
    {"roughnessfactor", "roughness"},
    {"transmissionfactor", "transmission"},
    {"spectrans", "transmission"},
    {"transmissionweight", "transmission"},
    {"opacity", "alpha"},
    {"clearcoat", "coat"},
    {"clearcoatfactor", "coat"},
    {"coatweight", "coat"},
    {"clearcoatroughness", "coatroughness"},
    {"clearcoatroughnessfactor", "coatroughness"},
    {"clearcoatgloss", "coatroughness"},
    {"sheencolor", "sheen"},
    {"sheencolorfactor", "sheen"},
    {"sheenroughnessfactor", "sheenroughness"},
    {"anisotropic", "anisotropy"},
    {"anisotropystrength", "anisotropy"},
    {"specularfactor", "specular"},
    {"speculartint", "specularcolor"},
    {"intior", "eta"},
    {"ior", "eta"},
    {"indexofrefraction", "eta"},
    {"kd", "reflectance"},
    {"albedo", "reflectance"},
    {"color", "reflectance"},
    {"color", "basecolor"},
    {"colour", "reflectance"},
    {"colour", "basecolor"},
    {"absorptioncolor", "attenuationcolor"},
    {"transmissioncolor", "attenuationcolor"},
    {"transmissiondepth", "attenuationdistance"},
    {"atdistance", "attenuationdistance"},
};

std::string plain(std::string_view word) {
  std::string letters;
  for (const char c : word)
    if (c != '_' && c != '-' && c != ' ') letters += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return letters;
}

}  // namespace

std::vector<std::string> meant_by(std::string_view word, const std::vector<std::string>& candidates) {
  const std::string letters = plain(word);
  std::vector<std::string> meant;
  for (const Meaning& meaning : kMeanings)
    if (meaning.word == letters && std::find(candidates.begin(), candidates.end(), meaning.ours) != candidates.end())
      meant.emplace_back(meaning.ours);
  for (const std::string& candidate : candidates)  // the same, but for its spelling
    if (candidate != word && plain(candidate) == letters) meant.push_back(candidate);
  return meant;
}

}  // namespace dspm
