#include "dspm/shapes/curve_pieces.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "dspm/base/math/vec.h"
#include "dspm/base/math/z_curve.h"
#include "dspm/base/system/parallel.h"
#include "dspm/base/system/parallel_sort.h"

namespace dspm {
namespace {

/// The pieces of segments that follow one another.
class Cut {
 public:
  explicit Cut(std::size_t segments) : segments_(segments) {}

  void add(const CurveSegment& segment, std::uint32_t number, int split_depth) {
    halve(segment, split_depth);
    if (pieces_.empty()) pieces_.reserve(segments_ * parts_.size());  // others are likely cut alike
    const auto count = static_cast<int>(parts_.size());
    for (int i = 0; i < count; ++i)
      pieces_.push_back(CurvePiece::of(segment, number, i, count, parts_[static_cast<std::size_t>(i)]));
  }
  std::vector<CurvePiece> pieces() && { return std::move(pieces_); }

 private:
  /// Halves a piece as long as the boxes get much smaller: those of slanting curves do, those along an axis do not.
  void halve(const CurveSegment& segment, int split_depth) {
    constexpr float kWorthwhile = 0.7f;
    const auto surface = [&](const std::vector<CurvePart>& parts) {
      float sum = 0;
      for (const CurvePart& part : parts) sum += bounds_of(segment, part).half_area();
      return sum;
    };
    parts_.assign(1, CurvePart::of(segment, 0, 1));
    float whole = surface(parts_);
    for (int depth = 0; depth < split_depth; ++depth) {
      const std::size_t count = 2 * parts_.size();
      halves_.clear();
      for (std::size_t i = 0; i < count; ++i)
        halves_.push_back(CurvePart::of(segment, double(i) / double(count), double(i + 1) / double(count)));
      const float halved = surface(halves_);
      if (!(halved < kWorthwhile * whole)) break;
      whole = halved;
      parts_.swap(halves_);
    }
  }

  std::size_t segments_;
  std::vector<CurvePart> parts_, halves_;
  std::vector<CurvePiece> pieces_;
};

/// Pieces by lists of segments that follow one another.
using PieceLists = std::vector<std::vector<CurvePiece>>;

PieceLists cut_all(std::span<const CurveSegment> segments, std::span<const std::uint8_t> split_depths) {
  constexpr std::int64_t kGrain = 1 << 12;
  const auto count = static_cast<std::int64_t>(segments.size());
  PieceLists lists(static_cast<std::size_t>(chunk_count(count, kGrain)));
  parallel_chunks(count, kGrain, [&](std::int64_t begin, std::int64_t end) {
    Cut cut(static_cast<std::size_t>(end - begin));
    for (auto s = static_cast<std::size_t>(begin); s < static_cast<std::size_t>(end); ++s)
      cut.add(segments[s], static_cast<std::uint32_t>(s), split_depths[s]);
    lists[static_cast<std::size_t>(begin / kGrain)] = std::move(cut).pieces();
  });
  return lists;
}

/// Sorts pieces along the curve through space, those in one place by their order in the lists: first into cells, then
/// within each.
class Sorting {
 public:
  explicit Sorting(PieceLists lists)
      : lists_(std::move(lists)), cell_bits_(lists_.size() > 1 ? kCellBits : 0), next_(lists_.size()) {
    for (const auto& list : lists_)
      for (const CurvePiece& piece : list) box_.add(piece.start);
  }

  UntouchedVector<CurvePiece> sorted() && {
    count();
    UntouchedVector<CurvePiece> pieces(ends_.back());
    for_each_list([&](std::size_t l) {
      for (const CurvePiece& piece : lists_[l]) pieces[next_[l][cell_of(piece)]++] = piece;
      lists_[l] = {};
    });
    parallel_for(static_cast<std::int64_t>(cells()), 16, [&](std::int64_t cell) {
      const auto c = static_cast<std::size_t>(cell);
      sort(std::span(pieces).subspan(ends_[c], ends_[c + 1] - ends_[c]));
    });
    return pieces;
  }

 private:
  static constexpr int kCellBits = 12;
  using Numbers = std::vector<std::uint32_t>;

  std::size_t cells() const { return std::size_t{1} << cell_bits_; }
  template <class Fn>
  void for_each_list(const Fn& fn) const {
    parallel_for(static_cast<std::int64_t>(lists_.size()), 1, [&](std::int64_t l) { fn(static_cast<std::size_t>(l)); });
  }
  std::uint64_t place_of(const CurvePiece& piece) const {
    return place_along_z_curve(piece.start + piece.chord * 0.5f, box_);
  }
  std::size_t cell_of(const CurvePiece& piece) const { return place_of(piece) >> (kZCurveBits - cell_bits_); }

  /// Counts where the pieces of each cell begin, and among them those of each list.
  void count() {
    for_each_list([&](std::size_t l) {
      next_[l].resize(cells());
      for (const CurvePiece& piece : lists_[l]) ++next_[l][cell_of(piece)];
    });
    ends_.assign(1, 0);
    for (std::size_t cell = 0; cell < cells(); ++cell) {
      std::uint32_t end = ends_.back();
      for (Numbers& of_list : next_) end += std::exchange(of_list[cell], end);
      ends_.push_back(end);
    }
  }

  void sort(std::span<CurvePiece> cell) const {
    UntouchedVector<AlongZCurve> places(cell.size());
    for (std::uint32_t i = 0; i < cell.size(); ++i) places[i] = {place_of(cell[i]), i};
    parallel_sort(places);
    const std::vector<CurvePiece> before(cell.begin(), cell.end());
    for (std::size_t i = 0; i < cell.size(); ++i) cell[i] = before[places[i].number];
  }

  PieceLists lists_;
  int cell_bits_;
  Bounds3 box_;
  std::vector<Numbers> next_;
  Numbers ends_;
};

}  // namespace

UntouchedVector<CurvePiece> cut_into_pieces(std::span<const CurveSegment> segments,
                                            std::span<const std::uint8_t> split_depths) {
  return Sorting(cut_all(segments, split_depths)).sorted();
}

}  // namespace dspm
