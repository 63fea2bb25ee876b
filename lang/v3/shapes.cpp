// pbrt-v3's shapes as pbrt-v4's.
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "dspm/base/math/rounded.h"
#include "dspm/base/math/vec.h"
#include "dspm/base/params/params.h"
#include "dspm/lang/v3/kinds.h"
#include "dspm/lang/v3/nurbs.h"

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

/// A mesh of nu by nv points over the unit square, row by row, which replaces the shape.
struct Grid {
  std::vector<float> points, normals;  // no normals, or one for each point
  std::vector<float> uvs;              // one for each point, or else those of the unit square
};
template <class Add>
void become_grid(Edit& edit, int nu, int nv, Add&& add) {
  Grid grid;
  std::vector<float> square;
  std::vector<int> indices;
  for (int y = 0; y < nv; ++y)
    for (int x = 0; x < nu; ++x) {
      const float u = static_cast<float>(x) / static_cast<float>(nu - 1),
                  v = static_cast<float>(y) / static_cast<float>(nv - 1);
      const int at = x + y * nu;
      add(grid, u, v);
      square.insert(square.end(), {u, v});
      if (x + 1 < nu && y + 1 < nv) indices.insert(indices.end(), {at, at + 1, at + 1 + nu, at, at + 1 + nu, at + nu});
    }
  edit.set_type("trianglemesh");
  edit.set(ParamType::integer, "indices", std::move(indices));
  edit.set(ParamType::point3, "P", std::move(grid.points));
  if (!grid.normals.empty()) edit.set(ParamType::normal, "N", std::move(grid.normals));
  edit.set(ParamType::point2, "uv", std::move(grid.uvs.empty() ? square : grid.uvs));
}

float take_number(Edit& edit, std::string_view name, float fallback) {
  const float value = edit.number(name).value_or(fallback);
  edit.take(name);
  return value;
}

/// Makes a surface that turns around the z axis, with the normals that v3 gives it: cross(dp/du, dp/dv), u being the
/// angle. profile(v) returns its points at the angle 0.
template <class Profile>
void turn(Edit& edit, Profile&& profile) {
  constexpr int kSlices = 128, kRings = 16;
  constexpr float kStep = 1e-3f;  // off the tips, where dp/du is zero
  const float whole = take_number(edit, "phimax", 360) * kPi / 180;
  become_grid(edit, kSlices + 1, kRings + 1, [&](Grid& grid, float u, float v) {
    const float inside = std::clamp(v, kStep, 1 - kStep), phi = u * whole;
    const auto [sin, cos] = rounded::sin_cos(phi);
    const auto turned = [sin, cos](const Vec3& p) { return Vec3{p.x * cos - p.y * sin, p.x * sin + p.y * cos, p.z}; };
    const Vec3 p = profile(inside), along = profile(inside + kStep) - profile(inside - kStep);
    Vec3 n = turned(cross(Vec3{-p.y, p.x, 0}, along));
    n = length(n) > 0 ? normalize(n) : Vec3{0, 0, 1};
    const Vec3 at = turned(profile(v));
    grid.points.insert(grid.points.end(), {at.x, at.y, at.z});
    grid.normals.insert(grid.normals.end(), {n.x, n.y, n.z});
  });
}

void cone(Edit& edit) {
  const float radius = take_number(edit, "radius", 1), height = take_number(edit, "height", 1);
  turn(edit, [=](float v) { return Vec3{radius * (1 - v), 0, height * v}; });
}

void paraboloid(Edit& edit) {
  const float radius = take_number(edit, "radius", 1);
  float low = take_number(edit, "zmin", 0), high = take_number(edit, "zmax", 1);
  if (low > high) std::swap(low, high);
  if (!(high > 0 && low >= 0)) throw SyntaxError(edit.where(), "a paraboloid needs 0 <= zmin <= zmax and zmax above 0");
  turn(edit, [=](float v) {
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
  turn(edit, [=](float v) { return a + (b - a) * v; });
}

/// Takes the number of an integer parameter; 0 if there is none.
int take_integer(Edit& edit, std::string_view name) {
  const auto param = edit.take(name);
  const auto* values = param ? std::get_if<std::vector<int>>(&param->values) : nullptr;
  return values != nullptr && values->size() == 1 ? values->front() : 0;
}

/// Makes heights over the unit square the mesh that v3 made of them.
void heightfield(Edit& edit) {
  const int nu = take_integer(edit, "nu"), nv = take_integer(edit, "nv");
  const auto param = edit.take("Pz");
  const auto* heights = param ? std::get_if<std::vector<float>>(&param->values) : nullptr;
  if (heights == nullptr || nu < 2 || nv < 2 || heights->size() % static_cast<std::size_t>(nu) != 0 ||
      heights->size() / static_cast<std::size_t>(nu) != static_cast<std::size_t>(nv))
    throw SyntaxError(edit.where(), "a heightfield needs nu * nv values \"Pz\", with nu and nv from 2 on");
  auto height = heights->begin();
  become_grid(edit, nu, nv, [&](Grid& grid, float u, float v) {
    grid.points.insert(grid.points.end(), {u, v, *height++});
  });
}

std::vector<float> take_numbers(Edit& edit, std::string_view name) {
  const auto param = edit.take(name);
  return param ? numbers_of(*param) : std::vector<float>{};
}

/// Takes one direction of a nurbs shape: `axis` is "u" or "v".
KnotVector take_knots(Edit& edit, const std::string& axis) {
  KnotVector k{take_integer(edit, "n" + axis), take_integer(edit, axis + "order"), take_numbers(edit, axis + "knots")};
  constexpr int kMost = 16;  // the work is its cube
  if (k.order < 2 || k.order > std::min(k.count, kMost))
    throw SyntaxError(edit.where(),
                      "a nurbs shape needs \"" + axis + "order\" from 2 to \"n" + axis + "\", at most 16");
  if (k.knots.size() != static_cast<std::size_t>(k.count) + static_cast<std::size_t>(k.order))
    throw SyntaxError(edit.where(),
                      "a nurbs shape needs n" + axis + " + " + axis + "order values \"" + axis + "knots\"");
  if (!std::is_sorted(k.knots.begin(), k.knots.end()) || !(k.first() < k.last()))
    throw SyntaxError(edit.where(), "the values \"" + axis + "knots\" must ascend");
  return k;
}

/// Takes control points with weights: v3's "Pw" has x, y and z already times w.
std::vector<float> take_control_points(Edit& edit, std::size_t count) {
  const std::vector<float> plain = take_numbers(edit, "P");
  std::vector<float> weighted = take_numbers(edit, "Pw");
  if (weighted.empty())
    for (std::size_t i = 0; i + 2 < plain.size(); i += 3)
      weighted.insert(weighted.end(), {plain[i], plain[i + 1], plain[i + 2], 1});
  if (weighted.size() != 4 * count)
    throw SyntaxError(edit.where(), "a nurbs shape needs nu * nv points \"P\", or four times as many numbers \"Pw\"");
  for (std::size_t i = 3; i < weighted.size(); i += 4)
    if (!(weighted[i] > 0)) throw SyntaxError(edit.where(), "the weights of \"Pw\" must be above 0");
  return weighted;
}

void nurbs(Edit& edit) {
  const KnotVector u = take_knots(edit, "u"), v = take_knots(edit, "v");
  const NurbsSurface surface(
      u, v, take_control_points(edit, static_cast<std::size_t>(u.count) * static_cast<std::size_t>(v.count)));
  const auto part = [&](const KnotVector& k, const char* begin, const char* end) {
    return std::pair(std::clamp(take_number(edit, begin, k.first()), k.first(), k.last()),
                     std::clamp(take_number(edit, end, k.last()), k.first(), k.last()));
  };
  const std::pair<float, float> us = part(u, "u0", "u1"), vs = part(v, "v0", "v1");
  const auto points = [](const KnotVector& k) { return std::clamp(16 * (k.count - k.order + 1), 32, 512) + 1; };
  become_grid(edit, points(u), points(v), [&](Grid& grid, float along, float across) {
    const Vec2 uv{std::lerp(us.first, us.second, along), std::lerp(vs.first, vs.second, across)};
    const SplinePoint at = surface.at(uv.x, uv.y);
    const Vec3 n = cross(at.by_u, at.by_v), unit = length(n) > 0 ? normalize(n) : Vec3{};
    grid.points.insert(grid.points.end(), {at.p.x, at.p.y, at.p.z});
    grid.normals.insert(grid.normals.end(), {unit.x, unit.y, unit.z});
    grid.uvs.insert(grid.uvs.end(), {uv.x, uv.y});
  });
}

constexpr std::pair<std::string_view, void (*)(Edit&)> kMeshes[] = {{"heightfield", heightfield},
                                                                    {"cone", cone},
                                                                    {"paraboloid", paraboloid},
                                                                    {"hyperboloid", hyperboloid},
                                                                    {"nurbs", nurbs}};

}  // namespace

void translate_shape(Edit& edit) {
  const std::string from = edit.type();
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
