// The product of material.dsc: coffee_pot.ply, standing on the origin, its spout along x; the unit is 10 cm. Body and
// lid are a turned profile, spout and handle are tubes along curves, and all of them are melted together as glaze does.
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "dspm/base/math/vec.h"
#include "scenes/generator/isosurface.h"
#include "scenes/generator/mesh_file.h"
#include "scenes/generator/subjects.h"

namespace dspm {
namespace {

constexpr int kCurveSteps = 24;

/// Smaller of two distances, rounded off where they differ by less than `melting`. [Quilez, Smooth Minimum]
double melted(double a, double b, double melting) {
  const double h = std::max(melting - std::abs(a - b), 0.) / melting;
  return std::min(a, b) - 0.25 * melting * h * h;
}

struct Nearest {
  double distance;
  float along;  // the segment, 0 to 1
};

Nearest nearest_on_segment(const Vec3& p, const Vec3& from, const Vec3& to) {
  const Vec3 d = to - from;
  const float along = std::clamp(dot(p - from, d) / length2(d), 0.f, 1.f);
  return {double{length(p - from - d * along)}, along};
}

/// A tube along a cubic Bezier curve in the plane z = 0.
class Tube {
 public:
  Tube(Vec2 a, Vec2 b, Vec2 c, Vec2 d, float radius_from, float radius_to) : from_(radius_from), to_(radius_to) {
    for (int i = 0; i <= kCurveSteps; ++i) {
      const float t = static_cast<float>(i) / kCurveSteps, s = 1 - t;
      const Vec2 p = a * (s * s * s) + b * (3 * s * s * t) + c * (3 * s * t * t) + d * (t * t * t);
      points_.push_back({p.x, p.y, 0});
    }
  }

  double distance(const Vec3& p) const {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i + 1 < points_.size(); ++i) {
      const Nearest near = nearest_on_segment(p, points_[i], points_[i + 1]);
      const float t = (static_cast<float>(i) + near.along) / kCurveSteps;
      least = std::min(least, near.distance - double{from_ + (to_ - from_) * t});
    }
    return least;
  }

 private:
  std::vector<Vec3> points_;
  float from_, to_;
};

/// A body turned around y, its profile (radius, height) rounded through the given points from axis to axis.
class Turned {
 public:
  explicit Turned(const std::vector<Vec2>& through) {
    const auto point = [&](std::size_t i) { return through[std::min(i, through.size() - 1)]; };
    for (std::size_t i = 0; i + 1 < through.size(); ++i)
      for (int k = 0; k < 6; ++k) {
        // [Catmull, Rom 1974]
        const Vec2 a = point(i > 0 ? i - 1 : 0), b = point(i), c = point(i + 1), d = point(i + 2);
        const float t = static_cast<float>(k) / 6, t2 = t * t, t3 = t2 * t;
        const Vec2 p = (b * 2 + (c - a) * t + (a * 2 - b * 5 + c * 4 - d) * t2 + (b * 3 - a - c * 3 + d) * t3) * 0.5f;
        profile_.push_back({std::max(p.x, 0.f), p.y, 0});
      }
    profile_.push_back({through.back().x, through.back().y, 0});
  }

  double distance(const Vec3& p) const {
    const Vec3 q{std::hypot(p.x, p.z), p.y, 0};
    double least = std::numeric_limits<double>::infinity();
    bool inside = false;
    for (std::size_t i = 0; i + 1 < profile_.size(); ++i) {
      const Vec3 a = profile_[i], b = profile_[i + 1];
      least = std::min(least, nearest_on_segment(q, a, b).distance);
      if ((a.y > q.y) != (b.y > q.y) && q.x < a.x + (q.y - a.y) / (b.y - a.y) * (b.x - a.x)) inside = !inside;
    }
    return inside ? -least : least;
  }

 private:
  std::vector<Vec3> profile_;
};

/// Negative inside; near the surface about the distance to it.
double coffee_pot(const Vec3& p) {
  static const Turned body({{0, 0},
                            {.56f, 0},
                            {.66f, .06f},
                            {.86f, .4f},
                            {.96f, .8f},
                            {.9f, 1.2f},
                            {.72f, 1.6f},
                            {.56f, 1.95f},
                            {.52f, 2.2f},
                            {.545f, 2.3f},
                            {0, 2.3f}});
  static const Turned lid(
      {{0, 2.3f}, {.3f, 2.29f}, {.49f, 2.29f}, {.58f, 2.33f}, {.55f, 2.4f}, {.42f, 2.51f}, {.22f, 2.59f}, {0, 2.62f}});
  static const Tube spout({.6f, .75f}, {1.5f, .75f}, {1.15f, 1.95f}, {1.75f, 2.15f}, .3f, .13f);
  static const Tube mouth({1.5f, 1.99f}, {1.6f, 2.07f}, {1.7f, 2.12f}, {2, 2.27f}, .05f, .085f);
  static const Tube handle({-.5f, 1.95f}, {-1.6f, 2.5f}, {-1.95f, .7f}, {-.88f, .7f}, .085f, .1f);
  const double knob = double{length(p - Vec3{0, 2.74f, 0})} - 0.15;
  const double vessel = melted(melted(body.distance(p), spout.distance(p), 0.3), handle.distance(p), 0.16);
  const double closed = melted(melted(vessel, lid.distance(p), 0.05), knob, 0.12);
  return -melted(-closed, mouth.distance(p), 0.06);
}

/// Finer where the surface bends most: at the spout's mouth, where the lid rests, and at the foot.
double coarseness(const Vec3& p) {
  const bool bends = p.x > 1.5f || std::abs(p.y - 2.31f) < 0.1f || p.y < 0.08f;
  return bends ? 0.4 : 1;
}

}  // namespace

void make_coffee_pot(const std::filesystem::path& directory) {
  MeshData mesh = isosurface(coffee_pot, {{-2.1f, -0.1f, -1.2f}, {2.3f, 3.1f, 1.2f}}, 0.02f, 30000, coarseness);
  for (const Vec3& p : mesh.vertices) mesh.normals.push_back(gradient(coffee_pot, p));
  write_ply(directory / "coffee_pot.ply", mesh);
}

}  // namespace dspm
