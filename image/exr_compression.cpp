#include "dspm/image/exr_compression.h"

#include <algorithm>
#include <iterator>

namespace dspm {
namespace {

struct NamedCompression {
  std::string_view name;
  ExrCompression ours;
  Imf::Compression imf;
};

constexpr NamedCompression kCompressions[] = {
    {"none", ExrCompression::none, Imf::NO_COMPRESSION},   {"rle", ExrCompression::rle, Imf::RLE_COMPRESSION},
    {"zips", ExrCompression::zips, Imf::ZIPS_COMPRESSION}, {"zip", ExrCompression::zip, Imf::ZIP_COMPRESSION},
    {"piz", ExrCompression::piz, Imf::PIZ_COMPRESSION},    {"dwaa", ExrCompression::dwaa, Imf::DWAA_COMPRESSION},
    {"dwab", ExrCompression::dwab, Imf::DWAB_COMPRESSION}};

template <class Fits>
const NamedCompression* find(Fits&& fits) {
  const auto* found = std::find_if(std::begin(kCompressions), std::end(kCompressions), fits);
  return found == std::end(kCompressions) ? nullptr : found;
}

}  // namespace

std::optional<ExrCompression> exr_compression(std::string_view name) {
  const NamedCompression* found = find([&](const auto& named) { return named.name == name; });
  return found != nullptr ? std::optional(found->ours) : std::nullopt;
}

Imf::Compression imf_compression(ExrCompression compression) {
  return find([&](const auto& named) { return named.ours == compression; })->imf;
}

ExrCompression exr_compression(Imf::Compression compression) {
  const NamedCompression* found = find([&](const auto& named) { return named.imf == compression; });
  return found != nullptr ? found->ours : ExrFormat().compression;
}

}  // namespace dspm
