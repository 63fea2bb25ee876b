#include "lang/read_file.h"

#include <zlib.h>

#include <algorithm>
#include <fstream>
#include <iostream>
#include <iterator>
#include <limits>
#include <stdexcept>

#include "core/files_read.h"

namespace dspm {
namespace {

constexpr std::size_t kMostBytes = std::size_t{1} << 32;  // more is taken for an attack or a mistake

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
      if (text.size() > kMostBytes) throw std::runtime_error("the file is larger than 4 GiB when expanded");
    }
  }

 private:
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

std::string read_bytes(const std::filesystem::path& path) {
  if (path == "-") return {std::istreambuf_iterator<char>(std::cin), {}};
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) throw std::runtime_error("it is a directory");
  std::ifstream file(path, std::ios::binary);
  if (!file) throw std::runtime_error("there is no such file, or it cannot be read");
  const auto size = std::filesystem::file_size(path, ignored);
  std::string data;
  if (!ignored && size > kMostBytes) throw std::runtime_error("the file is larger than 4 GiB");
  if (!ignored && size > 0) {
    data.resize(size);
    file.read(data.data(), static_cast<std::streamsize>(size));
    data.resize(static_cast<std::size_t>(file.gcount()));
  }
  data.append(std::istreambuf_iterator<char>(file), {});  // a pipe has no size
  note_file_read(path, data);
  return data;
}

}  // namespace

std::string read_file(const std::filesystem::path& path) { return expand_gzip(read_bytes(path)); }

std::string expand_gzip(std::string data) {
  if (!data.starts_with("\x1f\x8b")) return data;
  return Inflater(data).run();
}

}  // namespace dspm
