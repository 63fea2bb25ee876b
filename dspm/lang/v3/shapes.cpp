// pbrt-v3's shapes as pbrt-v4's.
#include <algorithm>

#include "dspm/lang/v3/kinds.h"

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

constexpr std::string_view kLost[] = {"cone", "hyperboloid", "paraboloid", "nurbs"};

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

}  // namespace

void translate_shape(Edit& edit) {
  const std::string from = edit.type();
  if (std::find(std::begin(kLost), std::end(kLost), from) != std::end(kLost))
    throw NoCounterpart(edit.directive(), "shape", from, "pbrt-v4 has no such shape; a mesh must take its place");
  if (from == "heightfield") return heightfield(edit);
  const auto* rule =
      std::find_if(std::begin(kShapes), std::end(kShapes), [&](const Rule& each) { return each.from == from; });
  if (rule == std::end(kShapes)) return;
  edit.apply(*rule);
  for (Param& param : edit.directive().params.params)
    if (param.name == "uv" && param.type == ParamType::number) param.type = ParamType::point2;
  if (!edit.texture("alpha").empty()) edit.only_close("alpha (v3 cuts holes only where it is 0)");
}

}  // namespace dspm::v3
