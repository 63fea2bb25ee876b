#include "dspm/shapes/mtl.h"

#include <fmt/format.h>
#include <tiny_obj_loader.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "dspm/base/colour/rgb.h"
#include "dspm/base/math/rounded.h"
#include "dspm/shapes/mtl_pictures.h"
#include "dspm/shapes/mtl_statements.h"

namespace dspm {
namespace {

constexpr float kUsualEta = 1.5f;

Param colour(std::string name, const tinyobj::real_t (&value)[3]) {
  return param_of(ParamType::rgb, std::move(name), std::vector<float>{value[0], value[1], value[2]}, {});
}
Param number(std::string name, float value) {
  return param_of(ParamType::number, std::move(name), std::vector<float>{value}, {});
}

bool is_positive(const tinyobj::real_t (&value)[3]) { return std::max({value[0], value[1], value[2]}) > 0; }
/// Returns whether the colour is neither black nor white.
bool is_tint(const tinyobj::real_t (&value)[3]) {
  return is_positive(value) && std::min({value[0], value[1], value[2]}) < 1;
}

/// Returns whether the illumination model is one of glass: 4, 6, 7 and 9 of the MTL format are, and 1 is without
/// highlights.
bool is_of_glass(int illum) { return illum == 4 || illum == 6 || illum == 7 || illum == 9; }
bool has_highlights(const tinyobj::material_t& m) {
  return m.illum != 1 && (is_positive(m.specular) || !m.specular_texname.empty());
}

/// Returns whether it has statements of the extension for physically based rendering.
bool is_physically_based(const tinyobj::material_t& m) {
  const bool has_pictures = !m.roughness_texname.empty() || !m.metallic_texname.empty() || !m.sheen_texname.empty();
  return has_pictures || m.roughness > 0 || m.metallic > 0 || m.sheen > 0 || m.clearcoat_thickness > 0 ||
         m.anisotropy != 0;
}

/// Returns the roughness of Phong's exponent, whose highlight is as wide as that of GGX with alpha^2 = 2 / (Ns + 2).
/// [Walter et al. 2007] Roughness is the root of alpha.
float roughness_of_exponent(float exponent) { return rounded::pow(2 / (std::max(exponent, 0.f) + 2), 0.25f); }

class MtlReader {
 public:
  /// With `by_blender`, illum, Ns, Ka and Tf have meanings of their own. (Facts from what Blender 3.4 writes.)
  MtlReader(const std::filesystem::path& path, bool by_blender, std::vector<std::string>& complaints,
            MtlLeftOut& left_out)
      : path_(path), by_blender_(by_blender), left_out_(left_out), pictures_(path, complaints, left_out) {}

  FileMaterial material(const tinyobj::material_t& m) {
    made_ = {path_, trimmed(name_from_tinyobj(m.name)), {}, {}, {}, {}};
    const bool shines = is_positive(m.emission) || !m.emissive_texname.empty(),
               has_holes = !m.alpha_texname.empty() || (m.dissolve < 1 && !is_glass(m));
    if (is_glass(m))
      glass(m, shines || has_holes);
    else if (is_physically_based(m) || has_highlights(m) || metallic(m) > 0 || transmission(m) > 0)
      principled(m);
    else
      matte(m, shines || has_holes);
    if (shines) emission(m);
    if (has_holes) alpha(m);
    relief(m);
    if (is_glass(m)) leave_out_grounds(m);
    leave_out("Tf", !is_glass(m) && !by_blender_ && is_tint(m.transmittance));
    leave_out("refl", !m.reflection_texname.empty());
    for (const auto& [statement, value] : m.unknown_parameter) leave_out(statement, true);
    return std::move(made_);
  }

 private:
  /// Returns whether it is glass. Blender's 6 and 9 mean an alpha below 1.
  bool is_glass(const tinyobj::material_t& m) const { return !by_blender_ && is_of_glass(m.illum); }
  /// Returns how metallic it is. Blender's 3 and 6 are metal, as much as Ka says.
  float metallic(const tinyobj::material_t& m) const {
    return by_blender_ && m.metallic == 0 && (m.illum == 3 || m.illum == 6) ? m.ambient[0] : m.metallic;
  }
  float transmission(const tinyobj::material_t& m) const { return by_blender_ ? in_unit(m.transmittance[0]) : 0; }
  float roughness(const tinyobj::material_t& m) const {
    if (m.roughness > 0) return m.roughness;
    if (by_blender_) return 1 - std::sqrt(in_unit(m.shininess / 1000));
    return is_physically_based(m) && m.shininess <= 1 ? 0 : roughness_of_exponent(m.shininess);
  }

  /// Makes glass. If it is `rich`, it has parameters that only "principled" knows.
  void glass(const tinyobj::material_t& m, bool rich) {
    const bool is_coloured = is_tint(m.transmittance);
    rich |= is_coloured;
    made_.type = rich ? "principled" : "dielectric";
    add(number("eta", m.ior > 1 ? m.ior : kUsualEta));
    if (rich) {
      constexpr tinyobj::real_t kClear[3] = {1, 1, 1};
      add(number("transmission", 1));
      add(colour("basecolor", is_coloured ? m.transmittance : kClear));
      add(number("roughness", in_unit(m.roughness)));
    } else if (m.roughness > 0) {
      add(number("roughness", m.roughness * m.roughness));  // of Burley's parametrization, [Burley 2012]
      add(param_of(ParamType::boolean, "remaproughness", std::vector<bool>{false}, {}));
    }
  }

  /// Leaves out what lies below glass in other models. Black and white say nothing.
  void leave_out_grounds(const tinyobj::material_t& m) {
    leave_out("Kd", m.diffuse_texname.empty() && is_tint(m.diffuse));
    leave_out("Ks", m.specular_texname.empty() && is_tint(m.specular));
    leave_out("map_Kd", !m.diffuse_texname.empty());
    leave_out("map_Ks", !m.specular_texname.empty());
    leave_out("map_Ns", !m.specular_highlight_texname.empty());
    leave_out("map_Pr", !m.roughness_texname.empty());
    leave_out("map_Pm", !m.metallic_texname.empty());
    leave_out("map_Ps", !m.sheen_texname.empty());
  }

  void matte(const tinyobj::material_t& m, bool rich) {
    made_.type = rich ? "principled" : "diffuse";
    colour_or_picture(rich ? "basecolor" : "reflectance", m.diffuse, diffuse_picture(m));
    if (rich) add(number("specular", 0));
    leave_out("map_Ns", !m.specular_highlight_texname.empty());
  }

  void principled(const tinyobj::material_t& m) {
    made_.type = "principled";
    const bool is_modern = is_physically_based(m);
    // Metal of the days before Pm.
    const bool is_metal = !is_modern && !by_blender_ && !is_positive(m.diffuse) && m.diffuse_texname.empty();
    const MtlPicture specular{"map_Ks", m.specular_texname, m.specular_texopt};
    if (is_metal)
      colour_or_picture("basecolor", m.specular, specular);
    else
      colour_or_picture("basecolor", m.diffuse, diffuse_picture(m));
    number_or_picture("roughness", roughness(m), {"map_Pr", m.roughness_texname, m.roughness_texopt});
    number_or_picture("metallic", is_metal ? 1 : metallic(m), {"map_Pm", m.metallic_texname, m.metallic_texopt});
    if (transmission(m) > 0) add(number("transmission", transmission(m)));
    const bool has_highlight = by_blender_ || !is_modern;
    if (has_highlight && !is_metal) highlight(m, specular);
    leave_out("map_Ks", !has_highlight && !m.specular_texname.empty());
    leave_out("map_Ns", !m.specular_highlight_texname.empty());
    if (m.ior > 1) add(number("eta", m.ior));
    layers(m);
  }

  /// Sets the highlight as Blender writes it: a half for what the index of refraction mirrors. A picture may be alone.
  void highlight(const tinyobj::material_t& m, const MtlPicture& picture) {
    const float brightest = std::max({m.specular[0], m.specular[1], m.specular[2]});
    tinyobj::real_t hue[3] = {1, 1, 1};
    for (int c = 0; c < 3; ++c)
      if (brightest > 0) hue[c] = m.specular[c] / brightest;
    add(number("specular", brightest > 0 ? in_unit(2 * brightest) : 1));
    if (!picture.file.empty() || *std::min_element(hue, hue + 3) < 1) colour_or_picture("specularcolor", hue, picture);
  }

  void layers(const tinyobj::material_t& m) {
    if (m.anisotropy != 0) add(number("anisotropy", in_unit(m.anisotropy)));
    if (m.anisotropy_rotation != 0) add(number("anisotropyrotation", 360 * m.anisotropy_rotation));
    if (m.clearcoat_thickness > 0) {
      add(number("coat", in_unit(m.clearcoat_thickness)));
      add(number("coatroughness", in_unit(m.clearcoat_roughness)));
    }
    const float sheen = in_unit(m.sheen);
    if (sheen > 0 || !m.sheen_texname.empty())
      colour_or_picture("sheen", {sheen, sheen, sheen}, {"map_Ps", m.sheen_texname, m.sheen_texopt});
  }

  void emission(const tinyobj::material_t& m) {
    if (const auto picture = pictures_.add({"map_Ke", m.emissive_texname, m.emissive_texopt}, true, made_)) {
      const auto [least, most] = std::minmax({m.emission[0], m.emission[1], m.emission[2]});
      add(param_of(ParamType::texture, "emission", std::vector<std::string>{*picture}, {}));
      if (most > 0) add(number("emissionstrength", most));
      leave_out("the hue of Ke with map_Ke", least < most);
    } else if (is_positive(m.emission)) {
      made_.radiance = Rgb(m.emission[0], m.emission[1], m.emission[2]);
    }
  }

  void alpha(const tinyobj::material_t& m) {
    if (const auto file = pictures_.holes({"map_d", m.alpha_texname, m.alpha_texopt}, made_))
      made_.alpha = *file;
    else if (!is_glass(m))
      add(number("alpha", in_unit(m.dissolve)));
  }

  /// Sets the relief. Heights of a bump map are in the units of the scene. If the picture holds normals, as many files
  /// have it, world takes them for what they are.
  void relief(const tinyobj::material_t& m) {
    if (const auto normals = pictures_.add_normals({"norm", m.normal_texname, m.normal_texopt}, made_))
      return add(param_of(ParamType::texture, "normaltexture", std::vector<std::string>{*normals}, {}));
    const bool is_bump = !m.bump_texname.empty();
    const MtlPicture heights = is_bump ? MtlPicture{"map_Bump", m.bump_texname, m.bump_texopt}
                                       : MtlPicture{"disp", m.displacement_texname, m.displacement_texopt};
    if (const auto picture = pictures_.add(heights, false, made_))
      add(param_of(ParamType::texture, "displacement", std::vector<std::string>{*picture}, {}));
  }

  static MtlPicture diffuse_picture(const tinyobj::material_t& m) {
    return {"map_Kd", m.diffuse_texname, m.diffuse_texopt};
  }
  static float in_unit(float value) { return std::clamp(value, 0.f, 1.f); }

  void colour_or_picture(const char* name, const tinyobj::real_t (&value)[3], const MtlPicture& file) {
    if (const auto picture = pictures_.add(file, true, made_))
      add(param_of(ParamType::texture, name, std::vector<std::string>{*picture}, {}));
    else
      add(colour(name, value));
  }
  void number_or_picture(const char* name, float value, const MtlPicture& file) {
    if (const auto picture = pictures_.add(file, false, made_))
      add(param_of(ParamType::texture, name, std::vector<std::string>{*picture}, {}));
    else
      add(number(name, in_unit(value)));
  }

  void add(Param param) { made_.params.params.push_back(std::move(param)); }

  void leave_out(const std::string& statement, bool is_there) {
    if (is_there) left_out_[statement].push_back(made_.name);
  }

  const std::filesystem::path& path_;
  const bool by_blender_;
  MtlLeftOut& left_out_;
  MtlPictures pictures_;
  FileMaterial made_;
};

}  // namespace

std::string trimmed(std::string_view text) {
  const std::size_t end = text.find_last_not_of(" \t\r");
  return std::string(text.substr(0, end == std::string_view::npos ? 0 : end + 1));
}

std::vector<FileMaterial> read_mtl(const std::string& text, const std::filesystem::path& path,
                                   std::vector<std::string>& complaints, MtlLeftOut& left_out) {
  std::istringstream file(for_tinyobj(text, left_out));
  std::vector<tinyobj::material_t> materials;
  std::map<std::string, int> numbers;
  std::string warning, error;
  tinyobj::LoadMtl(&numbers, &materials, &file, &warning, &error);
  MtlReader reader(path, text.starts_with("# Blender"), complaints, left_out);
  std::vector<FileMaterial> made;
  for (const tinyobj::material_t& m : materials) made.push_back(reader.material(m));
  return made;
}

std::vector<std::string> in_words(const MtlLeftOut& left_out) {
  std::vector<std::string> words;
  for (const auto& [statement, materials] : left_out)
    words.push_back(fmt::format("{} of material \"{}\"{} is left out", statement, materials.front(),
                                materials.size() == 1 ? "" : fmt::format(" and of {} more", materials.size() - 1)));
  return words;
}

}  // namespace dspm
