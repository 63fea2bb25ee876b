// pbrt-v3's shapes as pbrt-v4's.
#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>
#include <vector>

#include "dspm/lang/v3/kinds.h"
#include "dspm/math/vec.h"
#include "dspm/params/params.h"

namespace dspm::v3 {
namespace {

constexpr Rule kShapes[] = {
    {"sphere", "", "radius zmin zmax phimax alpha shadowalpha="},
    {"cylinder", "", "radius zmin zmax phimax alpha shadowalpha="},
    {"disk", "", "height radius innerradius phimax alpha shadowalpha="},
    {"trianglemesh", "", "indices P N S uv st=uv alpha shadowalpha= faceIndices discarddegenerateUVs="},
    {"plymesh", "", "filename alpha shadowalpha="},
    {"loopsubdiv", "", "levels nlevels=levels indices P scheme"},
    {"curve", "", "P type N width width0 width1 degree basis splitdepth"},
};

/// What turns around the z axis, as a mesh with the normals that v3 gives it: cross(dp/du, dp/dv), u being the angle.
class Turned {
 public:
  using Profile = std::function<Vec3(float v)>;  // at the angle 0
  Turned(Edit& edit, Profile profile)
      : profile_(std::move(profile)), whole_(take_number(edit, "phimax", 360) * kPi / 180) {
    constexpr int kSlices = 128, kRings = 16;
    for (int y = 0; y <= kRings; ++y)
      for (int x = 0; x <= kSlices; ++x) {
        add(static_cast<float>(x) / kSlices, static_cast<float>(y) / kRings);
        const int at = x + y * (kSlices + 1), above = at + kSlices + 1;
        if (x < kSlices && y < kRings) indices_.insert(indices_.end(), {at, at + 1, above + 1, at, above + 1, above});
      }
    edit.set_type("trianglemesh");
    edit.set(ParamType::integer, "indices", std::move(indices_));
    edit.set(ParamType::point3, "P", std::move(points_));
    edit.set(ParamType::normal, "N", std::move(normals_));
    edit.set(ParamType::point2, "uv", std::move(uv_));
  }

  static float take_number(Edit& edit, std::string_view name, float fallback) {
    const float value = edit.number(name).value_or(fallback);
    edit.take(name);
    return value;
  }

 private:
  void add(float u, float v) {
    constexpr float kStep = 1e-3f;  // off the tips, where dp/du is zero
    const float inside = std::clamp(v, kStep, 1 - kStep), phi = u * whole_;
    const auto turned = [&](const Vec3& p) {
      return Vec3{p.x * std::cos(phi) - p.y * std::sin(phi), p.x * std::sin(phi) + p.y * std::cos(phi), p.z};
    };
    const Vec3 p = profile_(inside), along = profile_(inside + kStep) - profile_(inside - kStep);
    Vec3 n = turned(cross(Vec3{-p.y, p.x, 0}, along));
    n = length(n) > 0 ? normalize(n) : Vec3{0, 0, 1};
    const Vec3 at = turned(profile_(v));
    points_.insert(points_.end(), {at.x, at.y, at.z});
    normals_.insert(normals_.end(), {n.x, n.y, n.z});
    uv_.insert(uv_.end(), {u, v});
  }

  Profile profile_;
  float whole_;
  std::vector<float> points_, normals_, uv_;
  std::vector<int> indices_;
};

void cone(Edit& edit) {
  const float radius = Turned::take_number(edit, "radius", 1), height = Turned::take_number(edit, "height", 1);
  Turned(edit, [=](float v) { return Vec3{radius * (1 - v), 0, height * v}; });
}

void paraboloid(Edit& edit) {
  const float radius = Turned::take_number(edit, "radius", 1);
  float low = Turned::take_number(edit, "zmin", 0), high = Turned::take_number(edit, "zmax", 1);
  if (low > high) std::swap(low, high);
  if (!(high > 0 && low >= 0)) throw SyntaxError(edit.where(), "a paraboloid needs 0 <= zmin <= zmax and zmax above 0");
  Turned(edit, [=](float v) {
    const float z = std::lerp(low, high, v);
    return Vec3{radius * std::sqrt(z / high), 0, z};
  });
}

void hyperboloid(Edit& edit) {
  const auto end = [&](const char* name, Vec3 fallback) {
    const auto param = edit.take(name);
    const std::vector<float> p = param ? numbers_of(*param) : std::vector<float>{};
    return p.size() == 3 ? Vec3{p[0], p[1], p[2]} : fallback;
  };
  const Vec3 a = end("p1", {0, 0, 0}), b = end("p2", {1, 1, 1});
  Turned(edit, [=](float v) { return a + (b - a) * v; });
}

/// The number of an integer parameter; 0: none.
int take_integer(Edit& edit, std::string_view name) {
  const auto param = edit.take(name);
  const auto* values = param ? std::get_if<std::vector<int>>(&param->values) : nullptr;
  return values != nullptr && values->size() == 1 ? values->front() : 0;
}

/// Heights over the unit square, as the mesh that v3 made of them.
void heightfield(Edit& edit) {
  const int nu = take_integer(edit, "nu"), nv = take_integer(edit, "nv");
  const auto param = edit.take("Pz");
  const auto* heights = param ? std::get_if<std::vector<float>>(&param->values) : nullptr;
  if (heights == nullptr || nu < 2 || nv < 2 || heights->size() % static_cast<std::size_t>(nu) != 0 ||
      heights->size() / static_cast<std::size_t>(nu) != static_cast<std::size_t>(nv))
    throw SyntaxError(edit.where(), "a heightfield needs nu * nv values \"Pz\", with nu and nv from 2 on");
  std::vector<float> points, uv;
  std::vector<int> indices;
  for (int y = 0; y < nv; ++y)
    for (int x = 0; x < nu; ++x) {
      const float u = static_cast<float>(x) / static_cast<float>(nu - 1),
                  v = static_cast<float>(y) / static_cast<float>(nv - 1);
      const int at = x + y * nu;
      points.insert(points.end(), {u, v, (*heights)[static_cast<std::size_t>(at)]});
      uv.insert(uv.end(), {u, v});
      if (x + 1 < nu && y + 1 < nv) indices.insert(indices.end(), {at, at + 1, at + 1 + nu, at, at + 1 + nu, at + nu});
    }
  edit.set_type("trianglemesh");
  edit.set(ParamType::integer, "indices", std::move(indices));
  edit.set(ParamType::point3, "P", std::move(points));
  edit.set(ParamType::point2, "uv", std::move(uv));
}

constexpr std::pair<std::string_view, void (*)(Edit&)> kMeshes[] = {
    {"heightfield", heightfield}, {"cone", cone}, {"paraboloid", paraboloid}, {"hyperboloid", hyperboloid}};

}  // namespace

void translate_shape(Edit& edit) {
  const std::string from = edit.type();
  if (from == "nurbs")
    throw NoCounterpart(edit.directive(), "shape", from, "pbrt-v4 has no such shape; a mesh must take its place");
  for (const auto& [name, translate] : kMeshes)
    if (from == name) return translate(edit);
  const auto* rule =
      std::find_if(std::begin(kShapes), std::end(kShapes), [&](const Rule& each) { return each.from == from; });
  if (rule == std::end(kShapes)) return;
  edit.apply(*rule);
  for (Param& param : edit.directive().params.params)
    if (param.name == "uv" && param.type == ParamType::number) param.type = ParamType::point2;
  if (!edit.texture("alpha").empty()) edit.only_close("alpha (v3 cuts holes only where it is 0)");
}

}  // namespace dspm::v3
