// The animal's shape at rest: round cones on bones, melted together, and the weights that bind the skin to the bones.
#include <algorithm>
#include <cmath>

#include "dspm/base/math/vec.h"
#include "scenes/generator/animal.h"

namespace dspm::animal {
namespace {

/// A cone with round ends that belongs to a bone.
struct Flesh {
  int bone;
  Vec3 from, to;
  float radius_from, radius_to;
  float melting;  // how far from its neighbours it begins to melt into them
};

/// Negative inside; near the surface about the distance to it.
double distance_to(const Flesh& flesh, const Vec3& p) {
  const Vec3 along = flesh.to - flesh.from;
  const float t = std::clamp(dot(p - flesh.from, along) / length2(along), 0.f, 1.f);
  return double{length(p - flesh.from - along * t)} -
         (double{flesh.radius_from} * (1 - double{t}) + double{flesh.radius_to} * double{t});
}

void add_leg(std::vector<Flesh>& body, Leg leg, const std::vector<Flesh>& parts) {
  const float side = leg == left_hind || leg == left_front ? 1.f : -1.f;
  for (Flesh part : parts) {
    part.bone += bone_of(leg, upper);
    part.from.z *= side, part.to.z *= side;
    body.push_back(part);
  }
}

std::vector<Flesh> make_flesh() {
  std::vector<Flesh> body{
      {chest, {0, 1.2f, 0}, {.46f, 1.22f, 0}, .29f, .28f, .15f},
      {chest, {.1f, 1.4f, 0}, {.46f, 1.47f, 0}, .13f, .13f, .16f},   // withers
      {chest, {.5f, 1.16f, 0}, {.66f, 1.24f, 0}, .21f, .19f, .14f},  // breast
      {rump, {0, 1.2f, 0}, {-.48f, 1.27f, 0}, .29f, .27f, .15f},
      {rump, {-.3f, 1.38f, 0}, {-.62f, 1.36f, 0}, .17f, .17f, .16f},  // croup
      {neck, {.56f, 1.38f, 0}, {1.1f, 1.9f, 0}, .21f, .115f, .14f},
      {neck, {.6f, 1.62f, 0}, {1.02f, 1.99f, 0}, .06f, .05f, .09f},  // mane
      {head, {1.1f, 1.9f, 0}, {1.46f, 1.6f, 0}, .125f, .08f, .08f},
      {head, {1.14f, 1.79f, 0}, {1.26f, 1.69f, 0}, .12f, .09f, .06f},  // cheek
      {head, {1.46f, 1.59f, 0}, {1.53f, 1.51f, 0}, .083f, .075f, .04f},
      {head, {1.06f, 1.98f, .06f}, {1.1f, 2.13f, .075f}, .042f, .026f, .04f},
      {head, {1.06f, 1.98f, -.06f}, {1.1f, 2.13f, -.075f}, .042f, .026f, .04f},
      {tail_root, {-.74f, 1.4f, 0}, {-1.0f, 1.4f, 0}, .07f, .06f, .08f},
      {tail_middle, {-1.0f, 1.4f, 0}, {-1.24f, 1.3f, 0}, .06f, .075f, .05f},
      {tail_end, {-1.24f, 1.3f, 0}, {-1.5f, 1.12f, 0}, .075f, .03f, .05f},
  };
  const std::vector<Flesh> hind{
      {upper, {-.5f, 1.18f, .14f}, {-.36f, .92f, .18f}, .23f, .15f, .12f},
      {middle, {-.38f, .92f, .18f}, {-.68f, .56f, .19f}, .13f, .062f, .1f},
      {middle, {-.52f, .86f, .18f}, {-.72f, .6f, .19f}, .06f, .045f, .06f},  // tendon
      {cannon, {-.69f, .57f, .19f}, {-.65f, .22f, .19f}, .055f, .046f, .05f},
      {foot, {-.65f, .21f, .19f}, {-.61f, .12f, .19f}, .055f, .045f, .03f},
      {foot, {-.61f, .1f, .19f}, {-.585f, .06f, .19f}, .055f, .062f, .03f},
  };
  const std::vector<Flesh> front{
      {upper, {.54f, 1.1f, .13f}, {.42f, .92f, .15f}, .17f, .12f, .12f},
      {middle, {.42f, .9f, .14f}, {.47f, .51f, .115f}, .105f, .055f, .1f},
      {cannon, {.47f, .52f, .115f}, {.47f, .22f, .11f}, .062f, .042f, .05f},
      {foot, {.47f, .21f, .11f}, {.51f, .12f, .11f}, .052f, .043f, .03f},
      {foot, {.51f, .1f, .11f}, {.535f, .06f, .11f}, .053f, .06f, .03f},
  };
  for (const Leg leg : {left_hind, right_hind}) add_leg(body, leg, hind);
  for (const Leg leg : {left_front, right_front}) add_leg(body, leg, front);
  return body;
}

/// The radius of the flesh that is nearest to `p`.
float radius_near(const std::vector<Flesh>& body, const Vec3& p) {
  const auto nearest = std::min_element(
      body.begin(), body.end(), [&](const Flesh& a, const Flesh& b) { return distance_to(a, p) < distance_to(b, p); });
  return 0.5f * (nearest->radius_from + nearest->radius_to);
}

/// How far the skin of a bone follows its neighbours, in metres.
float softness(int bone) {
  if (bone == chest || bone == rump) return 0.3f;
  if (bone < tail_root) return 0.14f;
  if (bone < leg_bones) return 0.08f;
  constexpr std::array<float, bones_a_leg> kOfLegs{0.13f, 0.07f, 0.05f, 0.035f};
  return kOfLegs[static_cast<std::size_t>((bone - leg_bones) % bones_a_leg)];
}

using Weights = std::array<float, kBones>;

Weights weights_at(const std::vector<Flesh>& body, const Vec3& p) {
  std::array<double, kBones> distances;
  distances.fill(1e9);
  for (const Flesh& flesh : body) {
    double& d = distances[static_cast<std::size_t>(flesh.bone)];
    d = std::min(d, distance_to(flesh, p));
  }
  const double nearest = *std::min_element(distances.begin(), distances.end());
  Weights weights{};
  float sum = 0;
  for (int bone = 0; bone < kBones; ++bone) {
    const auto i = static_cast<std::size_t>(bone);
    const float nearness = std::max(0.f, 1 - static_cast<float>(distances[i] - nearest) / softness(bone));
    sum += weights[i] = nearness * nearness;
  }
  for (float& weight : weights) weight /= sum;
  return weights;
}

constexpr int kSmoothings = 20;

/// Every vertex gets the mean of its neighbours' weights and its own.
std::vector<Weights> smoothed(const std::vector<Weights>& weights, const std::vector<Face>& faces) {
  std::vector<Weights> sums = weights;
  std::vector<float> counts(weights.size(), 1);
  for (const Face& face : faces)
    for (std::size_t k = 0; k < 3; ++k) {
      const auto v = static_cast<std::size_t>(face[k]), next = static_cast<std::size_t>(face[(k + 1) % 3]);
      for (std::size_t bone = 0; bone < kBones; ++bone) sums[v][bone] += weights[next][bone];
      ++counts[v];
    }
  for (std::size_t v = 0; v < sums.size(); ++v)
    for (float& weight : sums[v]) weight /= counts[v];
  return sums;
}

}  // namespace

Body make_body() {
  const std::vector<Flesh> flesh = make_flesh();
  const Field field = [&](const Vec3& p) {
    double d = 1e9;
    for (const Flesh& each : flesh) {
      const double other = distance_to(each, p), k = each.melting;
      const double overlap = std::max(0., k - std::abs(d - other)) / k;
      d = std::min(d, other) - 0.25 * k * overlap * overlap;
    }
    return d;
  };
  Body body;
  body.mesh = isosurface(field, {{-1.65f, -0.05f, -0.4f}, {1.75f, 2.3f, 0.4f}}, 0.016f, 10000,
                         [&](const Vec3& p) { return std::sqrt(radius_near(flesh, p)); });
  for (const Vec3& p : body.mesh.vertices) {
    body.mesh.normals.push_back(gradient(field, p));
    body.weights.push_back(weights_at(flesh, p));
  }
  for (int i = 0; i < kSmoothings; ++i) body.weights = smoothed(body.weights, body.mesh.faces);
  return body;
}

}  // namespace dspm::animal
