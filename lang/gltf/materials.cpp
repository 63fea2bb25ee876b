// [glTF 2.0, 3.9 and appendix B; KHR_materials_anisotropy, _clearcoat, _diffuse_transmission, _dispersion,
// _emissive_strength, _ior, _iridescence, _sheen, _specular, _transmission, _unlit, _volume, _volume_scatter;
// KHR_texture_transform; EXT_texture_webp]
#include "dspm/lang/gltf/materials.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "dspm/base/math/vec.h"

namespace dspm::gltf {

using Triple = std::array<double, 3>;

class MaterialTranslator {
 public:
  MaterialTranslator(Materials& all, const Value& material, const std::string& name, const MeshLook& look,
                     const MaterialForm& form)
      : all_(all), material_(material), name_(name), look_(look), form_(form) {}

  MaterialStatements translate() {
    if (material_.extension("KHR_materials_unlit").exists()) {
      unlit();
    } else {
      base();
      transmission();
      layers();
      emission();
    }
    opacity();
    return std::move(result_);
  }

 private:
  Statement& material() { return result_.material; }
  void note(const std::string& sentence) { all_.notes_.insert(sentence); }

  /// Returns the name of a new texture of that class.
  std::string add(const std::string& part, const char* type, const char* kind, std::vector<Parameter> parameters) {
    const std::string name = name_ + ", " + part;
    result_.textures.push_back(
        {fmt::format("Texture {} \"{}\" \"{}\"", in_quotes(name), type, kind), std::move(parameters)});
    return name;
  }

  static std::string wrap_of(const Value& mode) {
    switch (mode.count(10497)) {
      case 33071: return "clamp";
      case 33648: return "mirror";
      default: return "repeat";
    }
  }

  /// Places a picture. v runs up in dspm, so what glTF turns and moves around the upper left corner is put in terms of
  /// the lower left one.
  void place(const Value& info, Statement& picture) {
    const Value transform = info.extension("KHR_texture_transform");
    const std::size_t set = transform["texCoord"].count(info["texCoord"].count(0));
    if (set >= 2) note("texture coordinates beyond the second set are left out: the second is taken");
    if (set >= 1) picture.set("integer", "uvset", "2");
    if (!transform.exists()) return;
    const auto offset = transform["offset"].numbers(std::array<double, 2>{0, 0});
    const auto scale = transform["scale"].numbers(std::array<double, 2>{1, 1});
    const double angle = transform["rotation"].number(0), c = std::cos(angle), s = std::sin(angle);
    picture.number("uscale", scale[0], INFINITY), picture.number("vscale", scale[1], INFINITY);
    picture.number("rotation", angle * 180 / static_cast<double>(kPi), INFINITY);
    picture.number("udelta", offset[0] + s * scale[1], INFINITY);
    picture.number("vdelta", 1 - offset[1] - c * scale[1], INFINITY);
  }

  std::optional<std::size_t> image_of(const Value& texture) {
    const std::size_t images = all_.document_["images"].size();
    if (const auto webp = texture.extension("EXT_texture_webp")["source"].index(images)) return webp;
    const auto source = texture["source"].index(images);
    if (!source)
      note(texture["extensions"].exists() ? "textures in a format that dspm does not read are left out"
                                          : "textures without a picture are left out");
    return source;
  }

  /// Returns the name of a picture's texture; empty if there is no picture. `channel` is empty for colours.
  std::string picture(const Value& info, const std::string& part, const char* channel, const char* encoding,
                      double factor = 1) {
    if (!info.exists()) return {};
    const Value textures = all_.document_["textures"];
    const Value texture = textures[info["index"].required_index(textures.size())];
    const auto image = image_of(texture);
    if (!image) return {};
    Statement picture;
    picture.string("filename", all_.picture_name_(*image));
    picture.string("encoding", encoding);
    if (*channel != '\0') picture.string("channel", channel);
    picture.number("scale", factor, 1);
    const Value samplers = all_.document_["samplers"];
    if (const auto sampler = texture["sampler"].index(samplers.size())) {
      const std::string s = wrap_of(samplers[*sampler]["wrapS"]), t = wrap_of(samplers[*sampler]["wrapT"]);
      if (s != "repeat") picture.string("wrap", s);
      if (t != s) picture.string("wrapv", t);
      if (samplers[*sampler]["magFilter"].count(0) == 9728) picture.string("filter", "point");
    }
    place(info, picture);
    return add(part, *channel != '\0' ? "float" : "spectrum", "imagemap", std::move(picture.parameters));
  }

  /// Sets a number, times a picture's channel. Of the product, the material takes what lies in [0, 1].
  void number(const char* parameter, double factor, const Value& info, const char* channel) {
    factor = std::max(factor, 0.0);
    const std::string map = picture(info, parameter, channel, "linear", factor);
    if (map.empty())
      material().number(parameter, std::min(factor, 1.0), INFINITY);
    else
      material().texture(parameter, map);
  }

  void normals(const std::string& of, const Value& info) {
    const std::string map = picture(info, of + "s", "", "linear");
    if (map.empty()) return;
    material().texture((of + "texture").c_str(), map);
    material().number((of + "scale").c_str(), info["scale"].number(1), 1);
  }

  /// Sets a colour, times a picture, times the colours of the vertices. What exceeds 1 goes into the picture's scale,
  /// as colours of textures must not exceed it. `most` is the largest value that the material takes.
  void colour(const char* parameter, Triple factor, const Value& info, double most = 1, bool of_vertices = false) {
    for (double& value : factor) value = std::max(value, 0.0);
    const double scale = std::max(1.0, *std::max_element(factor.begin(), factor.end()));
    std::string map = picture(info, parameter, "", "sRGB", scale);
    for (double& value : factor) value = map.empty() ? std::min(value, most) : value / scale;
    if (of_vertices && look_.has_colours) map = times_vertices(map, parameter, "spectrum");
    if (map.empty()) return material().rgb(parameter, factor);
    if (factor != Triple{1, 1, 1} || form_.is_keyed)
      map = add(fmt::format("{} tinted", parameter), "spectrum", "product",
                {Parameter{"texture", "tex1", in_quotes(map)},
                 Parameter{"rgb", "tex2", fmt::format("[{}]", listed(factor))}});
    material().texture(parameter, map);
  }

  /// Multiplies a texture, if there is one, by the colours or opacities of the vertices.
  std::string times_vertices(const std::string& map, const char* parameter, const char* type) {
    const std::string own = add(fmt::format("{} of vertices", parameter), type, "vertexcolor", {});
    if (map.empty()) return own;
    Statement both;
    both.texture("tex1", map), both.texture("tex2", own);
    return add(fmt::format("{} on vertices", parameter), type, "product", std::move(both.parameters));
  }

  std::array<double, 4> base_factor() const {
    return material_["pbrMetallicRoughness"]["baseColorFactor"].numbers(std::array<double, 4>{1, 1, 1, 1});
  }

  struct Facets {
    double roughness, anisotropy;
  };
  /// glTF stretches alpha along the tangent to alpha + (1 - alpha) s^2 with the strength s. principled keeps the
  /// product of both alphas, and their ratio is 1 - 0.9 anisotropy. Where pictures change them, s stands for the
  /// anisotropy.
  Facets facets() const {
    const Value pbr = material_["pbrMetallicRoughness"], stretched = material_.extension("KHR_materials_anisotropy");
    const double factor = pbr["roughnessFactor"].number(1), strength = stretched["anisotropyStrength"].number(0);
    if (strength <= 0 || stretched["anisotropyTexture"].exists() || pbr["metallicRoughnessTexture"].exists())
      return {factor, strength};
    const double roughness = std::clamp(factor, 0.0, 1.0), s = std::min(strength, 1.0);
    const double alpha = roughness * roughness, along = alpha + (1 - alpha) * s * s;
    const double ratio = std::max(alpha / along, 0.1);
    return {std::pow(along * along * ratio, 0.25), (1 - ratio) / 0.9};
  }

  void base() {
    const Value pbr = material_["pbrMetallicRoughness"], rough = pbr["metallicRoughnessTexture"];
    const auto factor = base_factor();
    colour("basecolor", {factor[0], factor[1], factor[2]}, pbr["baseColorTexture"], 1, true);
    number("metallic", pbr["metallicFactor"].number(1), rough, "blue");
    number("roughness", facets().roughness, rough, "green");
    normals("normal", material_["normalTexture"]);
    if (material_.extension("KHR_materials_pbrSpecularGlossiness").exists())
      note("KHR_materials_pbrSpecularGlossiness is left out: the material's metallic-roughness part is used");
  }

  static constexpr double kUsualIor = 1.5;
  /// Returns the index of refraction; 0 means that all light is mirrored, times the specular colour.
  double ior() const { return material_.extension("KHR_materials_ior")["ior"].number(kUsualIor); }

  void transmission() {
    const Value glass = material_.extension("KHR_materials_transmission");
    const Value volume = material_.extension("KHR_materials_volume");
    const Value beyond = material_.extension("KHR_materials_diffuse_transmission");
    if (const double eta = ior(); eta != 0) material().number("eta", std::max(eta, 1.0), kUsualIor);
    // 20 over the Abbe number; principled takes Abbe numbers from 1.
    if (const double dispersion = material_.extension("KHR_materials_dispersion")["dispersion"].number(0);
        dispersion > 0)
      material().number("abbe", std::max(20 / dispersion, 1.0), 0);
    if (beyond.exists()) {
      number("diffusetransmission", beyond["diffuseTransmissionFactor"].number(0), beyond["diffuseTransmissionTexture"],
             "alpha");
      colour("diffusetransmissioncolor", beyond["diffuseTransmissionColorFactor"].numbers(Triple{1, 1, 1}),
             beyond["diffuseTransmissionColorTexture"]);
    }
    const bool is_body = volume["thicknessFactor"].number(0) > 0;
    const bool is_filled = is_body && (glass.exists() || beyond.exists()) && fill(volume);
    if (!glass.exists()) return;
    number("transmission", glass["transmissionFactor"].number(0), glass["transmissionTexture"], "red");
    if (!is_body) return material().flag("thin", true);
    if (is_filled) return;
    const double distance = volume["attenuationDistance"].number(0);  // 0: not given, or as exporters write infinity
    if (!(distance > 0)) return;
    colour("attenuationcolor", volume["attenuationColor"].numbers(Triple{1, 1, 1}), Value(nullptr, ""));
    material().number("attenuationdistance", distance, INFINITY);
  }

  /// Fills the body with a medium if it scatters light inside, and returns whether it does. The file gives the colour that light
  /// has after many scatterings, from which the share follows that is scattered each time. [KHR_materials_volume_scatter; van
  /// de Hulst 1980, Multiple Light Scattering]
  bool fill(const Value& volume) {
    const Value scatter = material_.extension("KHR_materials_volume_scatter");
    const double distance = volume["attenuationDistance"].number(0);
    if (!scatter.exists() || !(distance > 0)) return false;
    const Triple left = volume["attenuationColor"].numbers(Triple{1, 1, 1}),
                 seen = scatter["multiscatterColor"].numbers(Triple{0, 0, 0});
    const double g = std::clamp(scatter["scatterAnisotropy"].number(0), -0.99, 0.99);
    constexpr double kDarkest = 1e-4;
    Triple absorbed{}, scattered{};
    for (std::size_t c = 0; c < 3; ++c) {
      const double all = -std::log(std::clamp(left[c], kDarkest, 1.0)) / distance,
                   colour = std::clamp(seen[c], 0.0, 1.0);
      // colour = (1 - s) (1 - 0.139 s) / (1 + 1.17 s), s^2 = (1 - albedo) / (1 - g albedo)
      const double b = (1.139 + 1.17 * colour) / (2 * 0.139), s = b - std::sqrt(b * b - (1 - colour) / 0.139);
      scattered[c] = all * (1 - s * s) / (1 - g * s * s), absorbed[c] = std::max(0.0, all - scattered[c]);
    }
    if (scattered == Triple{0, 0, 0}) return false;
    if (form_.is_keyed) note("what is inside of bodies (KHR_materials_volume_scatter) is that of the first frame");
    result_.medium = Statement{"\"homogeneous\""};
    result_.medium->rgb("sigma_a", absorbed), result_.medium->rgb("sigma_s", scattered);
    result_.medium->number("g", g, 0);
    return true;
  }

  /// Sets the specular colour. principled, too, bounds the product of the colour and what the index of refraction
  /// mirrors.
  void specular() {
    const Value mirror = material_.extension("KHR_materials_specular");
    if (!mirror.exists() && ior() != 0) return;
    number("specular", mirror["specularFactor"].number(1), mirror["specularTexture"], "alpha");
    Triple factor = mirror["specularColorFactor"].numbers(Triple{1, 1, 1});
    if (ior() == 0)
      for (double& value : factor) value *= std::pow((kUsualIor + 1) / (kUsualIor - 1), 2);
    colour("specularcolor", factor, mirror["specularColorTexture"], INFINITY);
  }

  void layers() {
    specular();
    const Value coat = material_.extension("KHR_materials_clearcoat");
    if (coat.exists()) {
      number("coat", coat["clearcoatFactor"].number(0), coat["clearcoatTexture"], "red");
      number("coatroughness", coat["clearcoatRoughnessFactor"].number(0), coat["clearcoatRoughnessTexture"], "green");
      normals("coatnormal", coat["clearcoatNormalTexture"]);
    }
    const Value sheen = material_.extension("KHR_materials_sheen");
    if (sheen.exists()) {
      colour("sheen", sheen["sheenColorFactor"].numbers(Triple{0, 0, 0}), sheen["sheenColorTexture"]);
      number("sheenroughness", sheen["sheenRoughnessFactor"].number(0), sheen["sheenRoughnessTexture"], "alpha");
    }
    const Value stretched = material_.extension("KHR_materials_anisotropy");
    if (stretched.exists()) {
      number("anisotropy", facets().anisotropy, stretched["anisotropyTexture"], "blue");
      const double degrees = stretched["anisotropyRotation"].number(0) * 180 / static_cast<double>(kPi);
      const std::string directions = picture(stretched["anisotropyTexture"], "directions", "", "linear");
      if (directions.empty()) {
        material().number("anisotropyrotation", degrees, 0);
      } else {
        Statement angle;
        angle.texture("tex", directions), angle.number("rotation", degrees, 0);
        material().texture("anisotropyrotation",
                           add("anisotropyrotation", "float", "angle", std::move(angle.parameters)));
      }
    }
    film();
  }

  /// Sets the film; a picture's channel leads from the least thickness to the greatest.
  void film() {
    const Value film = material_.extension("KHR_materials_iridescence");
    if (!film.exists()) return;
    number("iridescence", film["iridescenceFactor"].number(0), film["iridescenceTexture"], "red");
    material().number("iridescenceeta", std::max(1.0, film["iridescenceIor"].number(1.3)), 1.3);
    const double least = film["iridescenceThicknessMinimum"].number(100),
                 most = film["iridescenceThicknessMaximum"].number(400);
    const std::string map = picture(film["iridescenceThicknessTexture"], "thickness share", "green", "linear");
    if (map.empty()) return material().number("iridescencethickness", most, 400);
    Statement between;
    between.number("tex1", least, INFINITY), between.number("tex2", most, INFINITY);
    between.texture("amount", map);
    material().texture("iridescencethickness", add("thickness", "float", "mix", std::move(between.parameters)));
  }

  void emission() {
    const auto factor = material_["emissiveFactor"].numbers(Triple{0, 0, 0});
    const double strength = material_.extension("KHR_materials_emissive_strength")["emissiveStrength"].number(1);
    if (factor == Triple{0, 0, 0} && !form_.emits) return;
    colour("emission", factor, material_["emissiveTexture"], INFINITY);
    material().number("emissionstrength", std::max(strength, 0.0), 1);
  }

  /// Makes the material emit its colour, because it shows it whatever the light.
  void unlit() {
    const auto factor = base_factor();
    material().rgb("basecolor", Triple{0, 0, 0}), material().number("specular", 0, 1);
    colour("emission", {factor[0], factor[1], factor[2]}, material_["pbrMetallicRoughness"]["baseColorTexture"], 1,
           true);
  }

  void opacity() {
    const std::string mode = material_["alphaMode"].text("OPAQUE");
    if (mode != "MASK" && mode != "BLEND") return;
    const double factor = std::clamp(base_factor()[3], 0.0, 1.0), edge = material_["alphaCutoff"].number(0.5);
    std::string map =
        picture(material_["pbrMetallicRoughness"]["baseColorTexture"], "opacity", "alpha", "sRGB", factor);
    if (look_.has_opacities) {
      const bool scaled = map.empty() && (factor != 1 || form_.is_keyed);
      map = times_vertices(map, "opacity", "float");
      if (scaled) {
        Statement dimmed;
        dimmed.texture("tex1", map), dimmed.number("tex2", factor, INFINITY);
        map = add("opacity tinted", "float", "product", std::move(dimmed.parameters));
      }
    }
    if (map.empty()) return material().number("alpha", mode == "BLEND" ? factor : factor >= edge ? 1 : 0, INFINITY);
    if (mode == "MASK") {
      Statement cut;
      cut.texture("tex", map), cut.number("edge", edge, INFINITY);
      map = add("mask", "float", "threshold", std::move(cut.parameters));
    }
    material().texture("alpha", map);
  }

  Materials& all_;
  const Value& material_;
  const std::string& name_;
  const MeshLook& look_;
  const MaterialForm& form_;
  MaterialStatements result_;
};

MaterialStatements Materials::translate(const Value& material, const std::string& name, const MeshLook& look,
                                        const MaterialForm& form) {
  MaterialStatements statements = MaterialTranslator(*this, material, name, look, form).translate();
  statements.material.head = "\"principled\"";
  return statements;
}

}  // namespace dspm::gltf
