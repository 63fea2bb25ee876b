#include "dspm/system/read_file.h"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <fstream>
#include <iostream>
#include <limits>
#include <new>
#include <stdexcept>

#include "dspm/system/file_access.h"
#include "dspm/system/files_read.h"
#include "dspm/system/inner_files.h"

namespace dspm {
namespace {

constexpr std::size_t kMiB = std::size_t{1} << 20;
constexpr std::size_t kMostBytes = std::size_t{1} << 34;  // more is taken for an attack or a mistake
// Deflate reaches 1032 : 1; text and meshes stay far below 100 : 1. Small files are trusted.
constexpr std::size_t kMostRatio = 100, kOnTrust = 64 * kMiB;

class Inflater {
 public:
  explicit Inflater(const std::string& data) : data_(data) {
    if (inflateInit2(&stream_, 15 + 16) != Z_OK) throw std::runtime_error("zlib cannot be initialised");
  }
  ~Inflater() { inflateEnd(&stream_); }
  Inflater(const Inflater&) = delete;
  Inflater& operator=(const Inflater&) = delete;

  /// All members of the file, one after the other.
  std::string run() {
    std::string text;
    while (true) {
      const int status = step(text);
      if (status == Z_STREAM_END) {
        const std::size_t rest = data_.size() - fed_ + stream_.avail_in;
        const std::size_t at = data_.size() - rest;
        if (rest < 2 || data_[at] != '\x1f' || data_[at + 1] != '\x8b') return text;
        inflateReset(&stream_);
      } else if (status == Z_BUF_ERROR && fed_ == data_.size() && stream_.avail_in == 0) {
        throw std::runtime_error("the gzip data ends early");
      } else if (status != Z_OK) {
        throw std::runtime_error("the gzip data is damaged");
      }
      check_ratio(text.size());
    }
  }

 private:
  void check_ratio(std::size_t size) const {
    if (size > kMostBytes || (size > kOnTrust && size / kMostRatio > data_.size()))
      throw std::runtime_error(
          fmt::format("the gzip data expands to more than {} times its {} bytes, as in an "
                      "attack; if this is intended, expand it first with gunzip",
                      size > kMostBytes ? kMostBytes / data_.size() : kMostRatio, data_.size()));
  }

  int step(std::string& text) {
    if (stream_.avail_in == 0) {
      const std::size_t count = std::min<std::size_t>(data_.size() - fed_, std::numeric_limits<uInt>::max());
      stream_.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(data_.data() + fed_));  // zlib never writes to it
      stream_.avail_in = static_cast<uInt>(count);
      fed_ += count;
    }
    stream_.next_out = buffer_;
    stream_.avail_out = sizeof buffer_;
    const int status = inflate(&stream_, Z_NO_FLUSH);
    text.append(reinterpret_cast<const char*>(buffer_), sizeof buffer_ - stream_.avail_out);
    return status;
  }

  const std::string& data_;
  std::size_t fed_ = 0;
  z_stream stream_{};
  Bytef buffer_[1 << 16];
};

std::string read_stream(std::istream& stream, std::size_t expected) {
  std::string data(expected, '\0');
  std::size_t size = 0;
  while (true) {  // a pipe has no size, and a file may grow meanwhile
    stream.read(data.data() + size, static_cast<std::streamsize>(data.size() - size));
    size += static_cast<std::size_t>(stream.gcount());
    if (size < data.size()) break;
    if (stream.peek() == std::istream::traits_type::eof()) break;
    if (size > kMostBytes) throw std::runtime_error("it holds more than 16 GiB");
    data.resize(size + std::max(size / 2, kMiB));
  }
  if (stream.bad()) throw std::runtime_error("it cannot be read to the end");
  data.resize(size);
  return data;
}

}  // namespace

std::string read_bytes(const std::filesystem::path& path) {
  if (is_inner_file(path)) return note_inner_file_read(), read_other_bytes(path);  // the one around it has been noted
  std::string bytes = read_other_bytes(path);
  note_file_read(path, bytes);
  return bytes;
}

std::string read_other_bytes(const std::filesystem::path& path) {
  expect_allowed(path);
  if (auto bytes = inner_file(path)) return *std::move(bytes);
  std::error_code ignored;
  const std::filesystem::file_status status = std::filesystem::status(path, ignored);
  if (is_directory(status)) throw std::runtime_error("it is a directory");
  if (exists(status) && (is_character_file(status) || (files_are_confined() && !is_regular_file(status))))
    throw std::runtime_error("it is not a regular file");
  std::ifstream file(path, std::ios::binary);
  if (!file) throw std::runtime_error("there is no such file, or it cannot be read");
  const std::uintmax_t size = is_regular_file(status) ? std::filesystem::file_size(path, ignored) : 0;
  if (size > kMostBytes) throw std::runtime_error("it is larger than 16 GiB");
  try {
    return read_stream(file, size);
  } catch (const std::bad_alloc&) {
    throw std::runtime_error(fmt::format("there is not enough memory for its {} bytes", size));
  }
}

std::string read_file(const std::filesystem::path& path) { return expand_gzip(read_bytes(path)); }

std::string read_input(const std::string& name) {
  if (name != "-") return read_file(name);
  std::string bytes = read_stream(std::cin, 0);
  note_file_read(name, bytes);
  return expand_gzip(std::move(bytes));
}

std::string expand_gzip(std::string data) {
  if (!data.starts_with("\x1f\x8b")) return data;
  return Inflater(data).run();
}

}  // namespace dspm
