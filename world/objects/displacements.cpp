#include "dspm/world/objects/displacements.h"

#include <map>
#include <optional>
#include <stdexcept>

#include "dspm/base/math/moments.h"
#include "dspm/base/math/vec.h"
#include "dspm/shapes/displace.h"
#include "dspm/shapes/triangle_mesh.h"
#include "dspm/world/objects/likeness.h"

namespace dspm {
namespace {

/// Returns the first placement that has an inverse, so that all frames have the same edges.
Transform first_placement(const ShapeUse& use, const FileFrames& frames) {
  for (FileFrame f(0); f.index() < frames.count(); ++f)
    if (const Matrix4 matrix = use.world_from_object.at(frames.moment(f, use.blurs));
        matrix.is_affine() && matrix.inverse())
      return Transform(matrix);
  return {};  // geometry reports it
}

class Displacer {
 public:
  Displacer(const ShapeUse& use, const SceneDescription& description, Looks& looks, Diagnostics& diagnostics)
      : use_(use), looks_(looks), diagnostics_(diagnostics), to_world_(first_placement(use, description.frames)) {}

  /// Returns the number of its displacement among the numbers of Looks; -1 if it is not displaced.
  int number_of(const SourceShape& made) {
    if (!made.displacement) return -1;
    const ValueOrTexture<float>& distance = made.displacement->distance;
    if (distance.texture.empty() && distance.value == 0) return -1;
    const bool is_texture = !distance.texture.empty();
    Param param = is_texture ? param_of(ParamType::texture, {}, std::vector{distance.texture}, distance.where)
                             : param_of(ParamType::number, {}, std::vector{distance.value}, distance.where);
    const auto [known, is_new] = numbers_.try_emplace({distance.texture, distance.value});
    if (is_new) known->second = looks_.add_number({{std::move(param)}}, use_.where, use_.blurs);
    return known->second;
  }

  std::shared_ptr<const Shape> displaced(const Shape& shape, float longest, int number, int state) const {
    const TexturePtr<float> texture = looks_.number(number, state);
    const auto world = [&](const Vec3& p) { return to_world_.point(p); };
    const Displacing how{[&](const Vec3& a, const Vec3& b) { return length(world(a) - world(b)); }, longest,
                         [&](const Vec3& p, Vec2 uv) {
                           return texture->evaluate({world(p), uv});
                         }};
    try {
      return std::make_shared<TriangleMesh>(dspm::displaced(*shape.triangles(), how));
    } catch (const std::exception& fault) {
      diagnostics_.error(use_.where, fault.what());
      return nullptr;
    }
  }

 private:
  const ShapeUse& use_;
  Looks& looks_;
  Diagnostics& diagnostics_;
  Transform to_world_;
  std::map<std::pair<std::string, float>, int> numbers_;
};

}  // namespace

GeometryStates displaced(const ShapeUse& use, const std::vector<int>& state_of_params, std::vector<MadeShapes> made,
                         const SceneDescription& description, Looks& looks, Diagnostics& diagnostics) {
  const int errors = diagnostics.error_count();
  Displacer displacer(use, description, looks, diagnostics);
  std::vector<int> numbers;  // by state of the parameters; a directive displaces all of its shapes alike
  std::vector<std::optional<Displacement>> wanted;
  std::vector<Shapes> still;
  for (MadeShapes& shapes : made) {
    numbers.push_back(shapes.empty() ? -1 : displacer.number_of(shapes.front()));
    wanted.push_back(shapes.empty() ? std::nullopt : shapes.front().displacement);
    Shapes& kept = still.emplace_back();
    for (SourceShape& each : shapes) kept.emplace_back(std::move(each.shape));
  }
  GeometryStates result;
  const auto slot = [](int i) { return static_cast<std::size_t>(i); };
  result.states = Timeline<std::pair<int, int>>::of(
      description.frames.count(),
      [&](FileFrame f) -> std::optional<std::pair<int, int>> {
        const int params = state_of_params[f.slot()];
        if (params < 0) return std::nullopt;
        const int number = numbers[slot(params)];
        return std::pair{params, number < 0 ? 0 : looks.states_of_number(number)[f.slot()]};
      },
      [](const auto& a, const auto& b) { return a == b; },
      [](const auto& state) { return Likeness().add(state.first).add(state.second).number(); });
  if (diagnostics.error_count() > errors) return result;
  for (const auto& [params, state] : result.states.states) {
    Shapes& shapes = result.shapes.emplace_back(still[slot(params)]);
    if (const int number = numbers[slot(params)]; number >= 0)
      for (std::shared_ptr<const Shape>& shape : shapes)
        shape = displacer.displaced(
            *shape, wanted[slot(params)]->edge_length * description.options.displacement_edge_scale, number, state);
  }
  return result;
}

}  // namespace dspm
