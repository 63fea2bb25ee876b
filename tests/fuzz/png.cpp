// PNG files. Each chunk ends in a check sum, which no mutation would hit, so it is made right before libpng sees it: a
// chunk is a length, a type, so many bytes, the sum of type and bytes, all numbers with the most significant byte
// first.
#include <zlib.h>

#include <string>

#include "tests/fuzz/image.h"

namespace {

std::size_t number_at(const std::string& bytes, std::size_t at) {
  std::size_t value = 0;
  for (std::size_t i = 0; i < 4; ++i) value = value << 8 | static_cast<std::uint8_t>(bytes[at + i]);
  return value;
}

void mend_sums(std::string& png) {
  constexpr std::size_t kSignature = 8, kAround = 12;
  for (std::size_t at = kSignature; at + kAround <= png.size();) {
    const std::size_t length = number_at(png, at), sum_at = at + 8 + length;
    if (length > png.size() - at - kAround) return;
    const uLong sum = crc32(0, reinterpret_cast<const Bytef*>(png.data() + at + 4), static_cast<uInt>(4 + length));
    for (std::size_t i = 0; i < 4; ++i) png[sum_at + i] = static_cast<char>(sum >> (24 - 8 * i));
    at = sum_at + 4;
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::string png(dspm::fuzz::text(data, size));
  mend_sums(png);
  dspm::fuzz::decode(png);
  return 0;
}
