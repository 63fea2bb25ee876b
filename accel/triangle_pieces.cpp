#include "dspm/accel/triangle_pieces.h"

#include <algorithm>
#include <bit>
#include <utility>
#include <vector>

#include "dspm/accel/box_ray.h"
#include "dspm/base/system/parallel.h"
#include "dspm/shapes/triangle_mesh.h"

namespace dspm {
namespace {

// A triangle that moves little keeps its place in a packet for up to 8 frames: as long as the area of the frames'
// united box is at most this many times that of one frame's box.
constexpr float kMostGrowth = 4;

/// Cuts primitives of meshes of the same topology, in frame order.
class Cutter {
 public:
  explicit Cutter(std::span<const PlacedShape> shapes) : shapes_(shapes) {}

  std::vector<Piece> pieces;
  std::vector<std::uint32_t> ends;  // of the pieces' triangles
  std::vector<TrianglePieces::Triangle> triangles;

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
    pieces.push_back(piece);
    for (const int s : sequence) triangles.push_back({s, primitive});
    ends.push_back(static_cast<std::uint32_t>(triangles.size()));
  }

 private:
  const PlacedShape& shape(int s) const { return shapes_[static_cast<std::size_t>(s)]; }
  void cut_in_two(std::span<const int> sequence, int primitive) {
    const std::size_t half = std::bit_floor(sequence.size() - 1);
    cut(sequence.first(half), primitive);
    cut(sequence.subspan(half), primitive);
  }

  std::span<const PlacedShape> shapes_;
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

  while (!which.empty()) {
    const std::size_t length = sequence_length(shapes, which);
    if (length == 1)
      add_each(which.front(), shapes[static_cast<std::size_t>(which.front())]);
    else
      add_cut(shapes, which.first(length));
    which = which.subspan(length);
  }
}

void TrianglePieces::add_cut(std::span<const PlacedShape> shapes, std::span<const int> sequence) {
  constexpr int kAtOnce = 1 << 10;
  const int primitives = shapes[static_cast<std::size_t>(sequence.front())].shape->primitive_count();
  std::vector<Cutter> parts(static_cast<std::size_t>(chunk_count(primitives, kAtOnce)), Cutter(shapes));
  parallel_for(primitives, kAtOnce, [&](std::int64_t p) {
    parts[static_cast<std::size_t>(p / kAtOnce)].cut(sequence, static_cast<int>(p));
  });
  std::vector<std::size_t> first_piece{pieces.size()}, first{triangles.size()};  // of each part
  for (const Cutter& part : parts) {
    first_piece.push_back(first_piece.back() + part.pieces.size());
    first.push_back(first.back() + part.triangles.size());
  }
  pieces.resize(first_piece.back()), first_triangle.resize(first_piece.back() + 1), triangles.resize(first.back());
  parallel_for(static_cast<std::int64_t>(parts.size()), 1, [&](std::int64_t i) {
    const auto p = static_cast<std::size_t>(i);
    const Cutter part = std::move(parts[p]);
    std::copy(part.pieces.begin(), part.pieces.end(), pieces.data() + first_piece[p]);
    std::copy(part.triangles.begin(), part.triangles.end(), triangles.data() + first[p]);
    std::transform(part.ends.begin(), part.ends.end(), first_triangle.data() + first_piece[p] + 1,
                   [&](std::uint32_t end) { return static_cast<std::uint32_t>(first[p] + end); });
  });
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
