#include "dspm/accel/triangle_pieces.h"

#include <bit>

#include "dspm/accel/box_ray.h"
#include "dspm/base/system/parallel.h"
#include "dspm/shapes/triangle_mesh.h"

namespace dspm {
namespace {

// A triangle that moves little keeps its place in a packet for up to 8 frames: as long as the area of the frames'
// united box is at most this many times that of one frame's box.
constexpr float kMostGrowth = 4;

class Cutter {
 public:
  Cutter(std::span<const PlacedShape> shapes, TrianglePieces& out) : shapes_(shapes), out_(out) {}

  /// Cuts the same primitive of meshes of the same topology, in frame order.
  void cut(std::span<const int> sequence, int primitive) {
    if (sequence.size() > kLeafSize) return cut_in_two(sequence, primitive);
    Piece piece{{}, {}, static_cast<int>(sequence.size())};
    float area = 0;
    for (const int s : sequence) {
      const Bounds3 bounds = with_margin(shape(s).shape->bounds(primitive));
      piece.bounds.add(bounds), piece.frames |= shape(s).frames, area += bounds.half_area();
    }
    if (piece.size > 1 && piece.bounds.half_area() * static_cast<float>(piece.size) > kMostGrowth * area)
      return cut_in_two(sequence, primitive);
    out_.pieces.push_back(piece);
    for (const int s : sequence) out_.triangles.push_back({s, primitive});
    out_.first_triangle.push_back(static_cast<std::uint32_t>(out_.triangles.size()));
  }

 private:
  const PlacedShape& shape(int s) const { return shapes_[static_cast<std::size_t>(s)]; }
  void cut_in_two(std::span<const int> sequence, int primitive) {
    const std::size_t half = std::bit_floor(sequence.size() - 1);
    cut(sequence.first(half), primitive);
    cut(sequence.subspan(half), primitive);
  }

  std::span<const PlacedShape> shapes_;
  TrianglePieces& out_;
};

/// Returns how many of the first shapes are meshes with the same faces.
std::size_t sequence_length(std::span<const PlacedShape> shapes, std::span<const int> which) {
  const auto faces = [&](std::size_t i) -> const std::vector<Face>& {
    return shapes[static_cast<std::size_t>(which[i])].shape->triangles()->faces();
  };
  std::size_t length = 1;
  while (length < which.size() && faces(length) == faces(0)) ++length;
  return length;
}

}  // namespace

TrianglePieces::TrianglePieces(std::span<const PlacedShape> shapes, std::span<const int> which) {
  // Memory that is never written to is not resident; growing vectors take more than they need.
  std::size_t most = 0;
  for (const int s : which)
    most += static_cast<std::size_t>(shapes[static_cast<std::size_t>(s)].shape->primitive_count());
  pieces.reserve(most + shapes.size());  // including a piece for each shape that is not a mesh
  first_triangle.reserve(most + 1), triangles.reserve(most);
  first_triangle.push_back(0);

  Cutter cutter(shapes, *this);
  while (!which.empty()) {
    const std::size_t length = sequence_length(shapes, which);
    const int count = shapes[static_cast<std::size_t>(which.front())].shape->primitive_count();
    if (length == 1)
      add_each(which.front(), shapes[static_cast<std::size_t>(which.front())]);
    else
      for (int p = 0; p < count; ++p) cutter.cut(which.first(length), p);
    which = which.subspan(length);
  }
}

/// Makes of each mesh alone what cut() makes of a sequence.
void TrianglePieces::add_each(int shape, const PlacedShape& placed) {
  const std::size_t before = count(), first = triangles.size();
  const auto added = static_cast<std::size_t>(placed.shape->primitive_count());
  pieces.resize(before + added), first_triangle.resize(before + added + 1), triangles.resize(first + added);
  parallel_for(static_cast<std::int64_t>(added), 1 << 12, [&](std::int64_t p) {
    const auto i = static_cast<std::size_t>(p);
    const auto number = static_cast<int>(p);
    pieces[before + i] = {with_margin(placed.shape->bounds(number)), placed.frames, 1};
    triangles[first + i] = {shape, number};
    first_triangle[before + i + 1] = static_cast<std::uint32_t>(first + i + 1);
  });
}

}  // namespace dspm
