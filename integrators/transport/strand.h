// Frames that differ only in appearance or light share a path, each with its own throughput: the strands of a path.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "dspm/base/colour/spectrum.h"
#include "dspm/base/math/frame_array.h"
#include "dspm/base/math/frames.h"

namespace dspm {

/// Frames of a path with the same throughput. The strands of a list are contiguous and have disjoint sets; they may
/// contain frames that have left the path.
struct Strand {
  FrameSet frames;
  Spectrum weight;         // times the path's throughput
  std::uint16_t rest = 0;  // strands that follow in the list
  bool grey = false;  // all weights of the list are: anything that depends only on colour is the same for all frames
};

/// Calls fn(FrameSet, const Spectrum& weight) for every strand in `frames`; without a list, once with weight 1.
template <class Fn>
void for_each_strand(const Strand* list, FrameSet frames, Fn&& fn) {
  if (list == nullptr) return fn(frames, Spectrum(1));
  for (;; ++list) {
    if (const FrameSet common = list->frames & frames; !common.empty()) fn(common, list->weight);
    if (list->rest == 0) return;
  }
}

/// The number of a list in its table; 0 if there is no list and all frames carry the path's throughput.
using StrandList = std::uint32_t;

/// The throughputs of a path's frames, before they become a list.
class Strands {
 public:
  void add(FrameSet frames, const Spectrum& weight) {
    strands_.add({frames, weight});
    frames_ |= frames;
  }
  FrameSet frames() const { return frames_; }
  std::span<const Strand> strands() const { return strands_; }
  /// Divides out and returns the common factor: a colour of which all weights are multiples; 1 if none exists. Equal
  /// weights become a single strand.
  Spectrum take_common();

 private:
  FrameArray<Strand> strands_;
  FrameSet frames_;
};

/// The lists of many paths.
class StrandTable {
 public:
  StrandTable() : strands_(1) {}  // list 0 means no list
  void clear() { strands_.resize(1); }
  const Strand* of(StrandList list) const { return list == 0 ? nullptr : &strands_[list]; }
  std::span<const Strand> lists_before(StrandList list) const { return std::span(strands_).first(list); }
  /// The number of the next list to be added.
  StrandList end() const { return static_cast<StrandList>(strands_.size()); }
  /// Makes a list of the frames' throughputs and moves their common factor into `common`; 0 if nothing else remains.
  StrandList add(Strands& strands, Spectrum& common);
  /// Returns the list that `frames` need: if one strand holds all of them, multiplies its weight into `carried` and
  /// returns 0.
  StrandList folded(StrandList list, FrameSet frames, Spectrum& carried) const {
    for (const Strand* strand = of(list); strand != nullptr; ++strand) {
      if (!(strand->frames & frames).empty()) {
        if (!strand->frames.contains(frames)) return list;
        carried *= strand->weight;
        return 0;
      }
      if (strand->rest == 0) break;
    }
    return list;
  }
  std::size_t bytes() const { return strands_.capacity() * sizeof(Strand); }

 private:
  std::vector<Strand> strands_;
};

/// A sum for each of a few lists.
template <class Sum>
class FewListSums {
 public:
  /// Returns null if there are already too many lists.
  Sum* of(const Strand* list) {
    for (std::size_t i = 0; i < count_; ++i)
      if (lists_[i] == list) return &sums_[i];
    if (count_ == lists_.size()) return nullptr;
    lists_[count_] = list, sums_[count_] = {};
    return &sums_[count_++];
  }
  /// Calls fn(list, sum) for every list that has a sum.
  template <class Fn>
  void for_each(Fn&& fn) const {
    for (std::size_t i = 0; i < count_; ++i) fn(lists_[i], sums_[i]);
  }

 private:
  static constexpr std::size_t kMost = 8;
  std::array<const Strand*, kMost> lists_;
  std::array<Sum, kMost> sums_;
  std::size_t count_ = 0;
};

}  // namespace dspm
