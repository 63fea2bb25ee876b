#include "dspm/integrators/transport/strand.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <optional>

namespace dspm {
namespace {

// The relative error between products of the same colours in different order.
constexpr float kRoundings = 1e-6f;

bool nearly_equal(float a, float b) { return std::abs(a - b) <= kRoundings * std::max(std::abs(a), std::abs(b)); }

/// Returns the factor s with a = s b, if a is a multiple of b.
std::optional<float> multiple_of(const Spectrum& a, const Spectrum& b) {
  const float s = max_component(a) / max_component(b);
  if (!std::isfinite(s)) return std::nullopt;
  for (int c = 0; c < 3; ++c)
    if (!nearly_equal(a[c], s * b[c])) return std::nullopt;
  return s;
}

}  // namespace

Spectrum Strands::take_common() {
  assert(!strands_.empty());
  const Spectrum common = strands_[0].weight;
  if (strands_.size() == 1) {
    strands_[0].weight = Spectrum(1);
    return common;
  }
  FrameArray<float> multiples;
  for (const Strand& strand : strands_) {
    const auto multiple = multiple_of(strand.weight, common);
    if (!multiple) return Spectrum(1);
    multiples.add(*multiple);
  }
  if (std::all_of(multiples.begin(), multiples.end(), [](float m) { return nearly_equal(m, 1); })) {
    strands_.shrink(0);
    strands_.add({frames_, Spectrum(1), 0, true});
    return common;
  }
  for (std::size_t i = 0; i < strands_.size(); ++i)
    strands_[i].weight = Spectrum(multiples[i]), strands_[i].grey = true;
  return common;
}

StrandList StrandTable::add(Strands& strands, Spectrum& common) {
  common = strands.take_common();
  const std::span<const Strand> added = strands.strands();
  if (added.size() == 1) return 0;
  const StrandList list = end();
  strands_.insert(strands_.end(), added.begin(), added.end());
  for (std::size_t i = 0; i < added.size(); ++i)
    strands_[list + i].rest = static_cast<std::uint16_t>(added.size() - 1 - i);
  return list;
}

}  // namespace dspm
