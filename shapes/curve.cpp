// Shape "curve" "point3 P" [0 0 0  0 1 0  1 1 0  1 2 0] "float width" 0.1
//
// Cubic or quadratic curves with a width, such as hair, fur and grass. Directives that follow one another and are alike
// in all but their curves become one shape, so hair may have a directive for each of millions of strands.
//
// | parameter  | default | meaning |
// | ---------- | ------- | ------- |
// | P          |         | control points; several segments share theirs |
// | basis      | bezier  | bezier or bspline |
// | degree     | 3       | 2 or 3 |
// | type       | flat    | flat faces every ray; cylinder does too, with the normals of a tube; ribbon lies across N |
// | N          |         | normals of a ribbon: at the ends of all segments |
// | width      | 1       | of the whole curve |
// | width0     | width   | at its beginning |
// | width1     | width   | at its end |
// | splitdepth | 3       | a segment has boxes of its own for up to 2^splitdepth pieces, 10 at most |
//
// u runs along each segment from 0 to 1, v across it. A flat curve is a ribbon that turns to each ray. It emits no
// light: that has no density by area. Rays leave it half a width off its centre (twice the width in pbrt). [Pharr,
// Jakob, Humphreys, Physically Based Rendering, 6.7]
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "dspm/base/math/vec.h"
#include "dspm/base/params/params.h"
#include "dspm/shapes/curves.h"

namespace dspm {
namespace {

using Controls = std::array<Vec3, 4>;

Vec3 mix(float t, const Vec3& a, const Vec3& b) { return a * (1 - t) + b * t; }

/// Returns a quadratic Bezier curve as a cubic one.
Controls raised(const Vec3& a, const Vec3& b, const Vec3& c) { return {a, mix(2 / 3.f, a, b), mix(1 / 3.f, b, c), c}; }

/// Returns segment i of a uniform B-spline, as a Bezier curve. [Farin, Curves and Surfaces for CAGD, ch. 8]
Controls spline_segment(std::span<const Vec3> p, int degree) {
  if (degree == 2) return raised(mix(0.5f, p[0], p[1]), p[1], mix(0.5f, p[1], p[2]));
  const Vec3 left = mix(2 / 3.f, p[0], p[1]), b = mix(1 / 3.f, p[1], p[2]), c = mix(2 / 3.f, p[1], p[2]);
  return {mix(0.5f, left, b), b, c, mix(0.5f, c, mix(1 / 3.f, p[2], p[3]))};
}

struct Strand {
  std::vector<Vec3> points;
  bool spline;
  int degree;

  std::size_t order() const { return static_cast<std::size_t>(degree); }
  std::size_t segments() const { return spline ? points.size() - order() : (points.size() - 1) / order(); }
  Controls segment(std::size_t i) const {
    const auto p = std::span(points).subspan(spline ? i : i * order());
    if (spline) return spline_segment(p, degree);
    return degree == 2 ? raised(p[0], p[1], p[2]) : Controls{p[0], p[1], p[2], p[3]};
  }
  /// Returns what is wrong with the number of points; empty if nothing is.
  std::string fault() const {
    if (points.size() <= order()) return fmt::format("at least {} control points are needed", degree + 1);
    if (!spline && (points.size() - 1) % order() != 0)
      return fmt::format("a Bezier curve of degree {0} has {1}, {2}, {3}, ... control points", degree, degree + 1,
                         2 * degree + 1, 3 * degree + 1);
    return "";
  }
};

std::vector<CurveSegment> segments_of(const Strand& strand, float width0, float width1) {
  const std::size_t count = strand.segments();
  const auto width = [&](std::size_t i) {
    const float t = static_cast<float>(i) / static_cast<float>(count);
    return (1 - t) * width0 + t * width1;
  };
  std::vector<CurveSegment> segments;
  for (std::size_t i = 0; i < count; ++i) {
    const Controls c = strand.segment(i);
    segments.push_back(CurveSegment::of({c[0], c[1], c[2], c[3]}, width(i), width(i + 1)));
  }
  return segments;
}

/// Returns no normals if the curve is no ribbon, or something is wrong.
std::vector<RibbonNormals> read_normals(ParamReader& reader, CurveType type, std::size_t segments) {
  const std::vector<Vec3> normals = reader.points3("N", "normals of a ribbon: at the ends of all its segments");
  if (type != CurveType::ribbon) {
    if (!normals.empty()) reader.warning("N", "\"N\" has no effect: only curves of type \"ribbon\" have normals");
    return {};
  }
  const bool valid = std::all_of(normals.begin(), normals.end(), [](const Vec3& n) { return length(n) > 0; });
  if (normals.size() != segments + 1 || !valid) {
    if (segments > 0)
      reader.error("N", fmt::format("a ribbon of {} segment{} needs {} normals \"N\", none of them 0", segments,
                                    segments == 1 ? "" : "s", segments + 1));
    return {};
  }
  std::vector<RibbonNormals> pairs;
  for (std::size_t i = 0; i < segments; ++i) pairs.push_back({{normalize(normals[i]), normalize(normals[i + 1])}});
  return pairs;
}

Strand read_strand(ParamReader& reader) {
  Strand strand;
  strand.points = reader.points3("P", "control points");
  static const std::vector<std::string> bases{"bezier", "bspline"};
  strand.spline = reader.choice("basis", "bezier", bases, "of the control points") == "bspline";
  strand.degree = reader.integer("degree", 3, "", "2 or 3");
  if (strand.degree != 2 && strand.degree != 3) {
    reader.error("degree", "\"degree\" must be 2 or 3");
    strand.degree = 3;
  }
  return strand;
}

CurveType read_type(ParamReader& reader) {
  static const std::vector<std::string> types{"flat", "ribbon", "cylinder"};
  const std::string type =
      reader.choice("type", "flat", types,
                    "flat faces every ray; cylinder does too, with the normals of a tube; ribbon lies across N");
  return type == "ribbon" ? CurveType::ribbon : type == "cylinder" ? CurveType::cylinder : CurveType::flat;
}

float read_width(ParamReader& reader, std::string_view name, float fallback, std::string_view sentence) {
  const float width = reader.number(name, fallback, "scene units", sentence);
  if (width >= 0) return width;
  reader.error(name, fmt::format("\"{}\" must not be negative", name));
  return 0;
}

}  // namespace

std::vector<MadeShape> make_curve(ParamReader& reader) {
  constexpr int kDeepestSplit = 10;
  const Strand strand = read_strand(reader);
  const CurveType type = read_type(reader);
  const std::string fault = strand.fault();
  const auto normals = read_normals(reader, type, fault.empty() ? strand.segments() : 0);
  const float width = read_width(reader, "width", 1, "of the whole curve");
  const float width0 = read_width(reader, "width0", width, "at its beginning; width if not given");
  const float width1 = read_width(reader, "width1", width, "at its end; width if not given");
  const int depth =
      reader.integer("splitdepth", 3, "", "a segment has boxes for up to 2^splitdepth pieces; at most 10");
  reader.finish();

  std::vector<MadeShape> made;
  if (!fault.empty())
    reader.error("P", fmt::format("{}, but \"P\" has {}", fault, strand.points.size()));
  else if (type != CurveType::ribbon || !normals.empty())
    made.push_back({std::make_unique<Curves>(type, segments_of(strand, width0, width1), normals,
                                             std::clamp(depth, 0, kDeepestSplit)),
                    std::nullopt});
  return made;
}

}  // namespace dspm
