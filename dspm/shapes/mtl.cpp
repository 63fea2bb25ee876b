#include "dspm/shapes/mtl.h"

#include <fmt/format.h>
#include <tiny_obj_loader.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "dspm/colour/rgb.h"
#include "dspm/system/file_access.h"

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

/// Illumination models 4, 6, 7 and 9 of the MTL format are those of glass; 1 is without highlights.
bool is_glass(int illum) { return illum == 4 || illum == 6 || illum == 7 || illum == 9; }
bool has_highlights(const tinyobj::material_t& m) { return m.illum != 1 && is_positive(m.specular); }

/// Statements of the extension for physically based rendering.
bool is_physically_based(const tinyobj::material_t& m) {
  const bool has_pictures = !m.roughness_texname.empty() || !m.metallic_texname.empty() || !m.sheen_texname.empty();
  return has_pictures || m.roughness > 0 || m.metallic > 0 || m.sheen > 0 || m.clearcoat_thickness > 0 ||
         m.anisotropy != 0;
}

/// Of Phong's exponent, whose highlight is as wide as that of GGX with alpha^2 = 2 / (Ns + 2). [Walter et al. 2007]
/// Roughness is the root of alpha.
float roughness_of_exponent(float exponent) { return std::pow(2 / (std::max(exponent, 0.f) + 2), 0.25f); }

class Reader {
 public:
  Reader(const std::filesystem::path& path, std::vector<std::string>& complaints, MtlLeftOut& left_out)
      : path_(path), complaints_(complaints), left_out_(left_out) {}

  FileMaterial material(const tinyobj::material_t& m) {
    made_ = {path_, trimmed(m.name), {}, {}, {}, {}};
    if (is_glass(m.illum))
      glass(m);
    else
      opaque(m);
    if (is_positive(m.emission)) made_.radiance = Rgb(m.emission[0], m.emission[1], m.emission[2]);
    leave_out("map_Ke", !m.emissive_texname.empty());
    leave_out("map_Bump", !m.bump_texname.empty());
    leave_out("norm", !m.normal_texname.empty());
    leave_out("disp", !m.displacement_texname.empty());
    if (const auto picture = picture_of(m.alpha_texname)) made_.alpha = *picture;
    leave_out("refl", !m.reflection_texname.empty());
    return std::move(made_);
  }

 private:
  void glass(const tinyobj::material_t& m) {
    const bool is_coloured =
        is_positive(m.transmittance) && *std::min_element(m.transmittance, m.transmittance + 3) < 1;
    made_.type = is_coloured ? "principled" : "dielectric";
    add(number("eta", m.ior > 1 ? m.ior : kUsualEta));
    if (is_coloured) {
      add(number("transmission", 1));
      add(colour("basecolor", m.transmittance));
      add(number("roughness", in_unit(m.roughness)));
    } else if (m.roughness > 0) {
      add(number("roughness", m.roughness * m.roughness));  // of Burley's parametrization, [Burley 2012]
      add(param_of(ParamType::boolean, "remaproughness", std::vector<bool>{false}, {}));
    }
  }

  void opaque(const tinyobj::material_t& m) {
    if (is_physically_based(m) || has_highlights(m)) {
      principled(m);
    } else {
      made_.type = "diffuse";
      colour_or_picture("reflectance", m.diffuse, m.diffuse_texname, "map_Kd");
    }
    leave_out("d", m.dissolve < 1);
    leave_out("map_Ks", !m.specular_texname.empty());
    leave_out("map_Ns", !m.specular_highlight_texname.empty());
    leave_out("anisor", m.anisotropy_rotation != 0);
  }

  void principled(const tinyobj::material_t& m) {
    made_.type = "principled";
    const bool is_modern = is_physically_based(m);
    // Metal of the days before Pm.
    const bool is_metal = !is_modern && !is_positive(m.diffuse) && m.diffuse_texname.empty();
    if (is_metal)
      add(colour("basecolor", m.specular));
    else
      colour_or_picture("basecolor", m.diffuse, m.diffuse_texname, "map_Kd");
    const bool by_exponent = m.roughness == 0 && m.shininess > 1;
    number_or_picture("roughness", is_modern && !by_exponent ? m.roughness : roughness_of_exponent(m.shininess),
                      m.roughness_texname, "map_Pr");
    number_or_picture("metallic", is_metal ? 1 : m.metallic, m.metallic_texname, "map_Pm");
    // As Blender writes it: a half for what the index of refraction mirrors.
    if (!is_modern && !is_metal)
      add(number("specular", in_unit(2 * (m.specular[0] + m.specular[1] + m.specular[2]) / 3)));
    if (m.ior > 1) add(number("eta", m.ior));
    if (m.anisotropy != 0) add(number("anisotropy", in_unit(m.anisotropy)));
    if (m.clearcoat_thickness > 0) {
      add(number("coat", in_unit(m.clearcoat_thickness)));
      add(number("coatroughness", in_unit(m.clearcoat_roughness)));
    }
    const float sheen = in_unit(m.sheen);
    if (sheen > 0 || !m.sheen_texname.empty())
      colour_or_picture("sheen", {sheen, sheen, sheen}, m.sheen_texname, "map_Ps");
  }

  static float in_unit(float value) { return std::clamp(value, 0.f, 1.f); }

  void colour_or_picture(const char* name, const tinyobj::real_t (&value)[3], const std::string& file,
                         const char* statement) {
    if (const auto picture = texture(file, statement, true))
      add(param_of(ParamType::texture, name, std::vector<std::string>{*picture}, {}));
    else
      add(colour(name, value));
  }
  void number_or_picture(const char* name, float value, const std::string& file, const char* statement) {
    if (const auto picture = texture(file, statement, false))
      add(param_of(ParamType::texture, name, std::vector<std::string>{*picture}, {}));
    else
      add(number(name, in_unit(value)));
  }

  void add(Param param) { made_.params.params.push_back(std::move(param)); }

  /// Where that picture is, if it is there.
  std::optional<std::filesystem::path> picture_of(std::string file) {
    if (file.empty()) return std::nullopt;
    std::replace(file.begin(), file.end(), '\\', '/');
    const std::filesystem::path path = path_.parent_path() / file;
    if (seems_to_exist(path)) return std::filesystem::absolute(path);
    complaints_.push_back(fmt::format("there is no texture file \"{}\" for material \"{}\"", file, made_.name));
    return std::nullopt;
  }

  /// The name of an imagemap of that file, if it is there.
  std::optional<std::string> texture(const std::string& file, const char* statement, bool is_spectrum) {
    const auto picture = picture_of(file);
    if (!picture) return std::nullopt;
    std::string name = fmt::format("{} of {} in {}", statement, made_.name, path_.string());
    made_.textures.push_back({name, *picture, is_spectrum});
    return name;
  }

  void leave_out(const char* statement, bool is_there) {
    if (is_there) left_out_[statement].push_back(made_.name);
  }

  const std::filesystem::path& path_;
  std::vector<std::string>& complaints_;
  MtlLeftOut& left_out_;
  FileMaterial made_;
};

}  // namespace

std::string trimmed(std::string_view text) {
  const std::size_t end = text.find_last_not_of(" \t\r");
  return std::string(text.substr(0, end == std::string_view::npos ? 0 : end + 1));
}

std::vector<FileMaterial> read_mtl(const std::string& text, const std::filesystem::path& path,
                                   std::vector<std::string>& complaints, MtlLeftOut& left_out) {
  std::istringstream file(text);
  std::vector<tinyobj::material_t> materials;
  std::map<std::string, int> numbers;
  std::string warning, error;
  tinyobj::LoadMtl(&numbers, &materials, &file, &warning, &error);
  Reader reader(path, complaints, left_out);
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
