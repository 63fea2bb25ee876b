// Curves as a shape: the segments of one Shape directive, or of the thousands of directives that it has absorbed. Each
// primitive is a piece of a segment; there are none before settle().
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "dspm/base/math/ray.h"
#include "dspm/base/math/vec.h"
#include "dspm/base/system/untouched.h"
#include "dspm/shapes/curve_segment.h"
#include "dspm/shapes/shape.h"

namespace dspm {

enum class CurveType { flat, ribbon, cylinder };

/// The normals of a ribbon at both ends of a segment, of unit length.
struct RibbonNormals {
  Vec3 at[2];
  /// Returns the normal in between, which turns evenly. [Shoemake 1985]
  DoubleVec3 between(double u) const;
};

class Curves final : public Shape {
 public:
  /// Cuts each segment into up to 2^split_depth pieces. `normals` are those of ribbons, one pair for each segment.
  Curves(CurveType type, std::span<const CurveSegment> segments, std::vector<RibbonNormals> normals, int split_depth);

  int primitive_count() const override { return static_cast<int>(pieces_.size()); }
  Bounds3 bounds(int primitive) const override;
  std::optional<PrimitiveHit> intersect(int primitive, const Ray& ray) const override;
  SurfacePoint surface_point(int primitive, Vec2 uv) const override;
  SurfacePoint seen(int primitive, Vec2 uv, const Vec3& direction) const override;
  bool turns() const override { return true; }
  /// Returns the strip of a segment.
  Strip strip(int primitive, Vec2 uv, const Vec3& direction) const override;
  bool absorb(Shape& next) override;
  void settle() override;
  float area(int primitive) const override;
  Vec2 sample_area(int primitive, Vec2 u) const override;

 private:
  const CurvePiece& piece(int primitive) const { return pieces_[static_cast<std::size_t>(primitive)]; }
  const CurveSegment& segment(int primitive) const { return segments_[piece(primitive).segment]; }
  std::optional<PrimitiveHit> facing_hit(const CurveSegment& segment, const Passage& passage, const Ray& ray) const;
  std::optional<PrimitiveHit> ribbon_hit(int primitive, const Passage& passage, const Ray& ray) const;
  SurfacePoint facing_point(const CurveSegment& segment, Vec2 uv, const Vec3& direction) const;
  SurfacePoint ribbon_point(std::uint32_t segment, Vec2 uv) const;

  CurveType type_;
  std::vector<CurveSegment> segments_;
  std::vector<RibbonNormals> normals_;      // by segment; empty unless ribbons
  std::vector<std::uint8_t> split_depths_;  // by segment; empty once settled
  std::size_t most_pieces_;
  UntouchedVector<CurvePiece> pieces_;
};

}  // namespace dspm
