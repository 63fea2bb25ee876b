// An OpenEXR file in memory. For the files named exr*, which alone know the library.
#pragma once

#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfInputFile.h>

#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string_view>

#include "dspm/image/exr_check.h"

namespace dspm {

class MemoryInput : public Imf::IStream {
 public:
  explicit MemoryInput(std::string_view bytes) : Imf::IStream("OpenEXR"), bytes_(bytes) {}
  bool read(char* to, int count) override {
    const auto size = static_cast<std::size_t>(count);
    if (count < 0 || position_ > bytes_.size() || size > bytes_.size() - position_) {
      throw std::runtime_error("the file ends too early");
    }
    std::memcpy(to, bytes_.data() + position_, size);
    position_ += size;
    return position_ < bytes_.size();
  }
  std::uint64_t tellg() override { return position_; }
  void seekg(std::uint64_t position) override { position_ = position; }

 private:
  std::string_view bytes_;
  std::uint64_t position_ = 0;
};

/// A file that is known to be sane.
struct OpenExr {
  MemoryInput input;
  Imf::InputFile file;

  explicit OpenExr(std::string_view bytes) : input(checked(bytes)), file(input) {}
  const Imf::Header& header() const { return file.header(); }

 private:
  static std::string_view checked(std::string_view bytes) {
    check_exr(bytes);
    return bytes;
  }
};

}  // namespace dspm
