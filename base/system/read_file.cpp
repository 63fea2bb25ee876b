#include "dspm/base/system/read_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>
#include <zlib.h>

#include <algorithm>
#include <ext/stdio_filebuf.h>
#include <iostream>
#include <limits>
#include <new>
#include <stdexcept>

#include "dspm/base/system/file_access.h"
#include "dspm/base/system/files_read.h"
#include "dspm/base/system/inner_files.h"

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

  /// Expands all members of the file, one after the other.
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

/// Opens a regular file without waiting: a pipe may have taken its place meanwhile.
int open_to_read(const std::filesystem::path& path) {
  struct stat status = {};
  const bool exists = stat(path.c_str(), &status) == 0;
  const bool is_pipe = exists && may_read_pipes() && !S_ISREG(status.st_mode) && !S_ISCHR(status.st_mode);
  if (exists && S_ISDIR(status.st_mode)) throw std::runtime_error("it is a directory");
  if (exists && !S_ISREG(status.st_mode) && !is_pipe) throw std::runtime_error("it is not a regular file");
  const int descriptor = open(path.c_str(), O_RDONLY | O_CLOEXEC | (is_pipe ? 0 : O_NONBLOCK));
  if (descriptor < 0) throw std::runtime_error("there is no such file, or it cannot be read");
  if (!is_pipe && (fstat(descriptor, &status) != 0 || !S_ISREG(status.st_mode))) {
    close(descriptor);
    throw std::runtime_error("it is not a regular file");
  }
  return descriptor;
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
  const int descriptor = open_to_read(path);
  __gnu_cxx::stdio_filebuf<char> buffer(descriptor, std::ios::in | std::ios::binary);  // closes it
  struct stat status = {};
  fstat(descriptor, &status);
  const std::size_t size = S_ISREG(status.st_mode) ? static_cast<std::size_t>(status.st_size) : 0;
  if (size > kMostBytes) throw std::runtime_error("it is larger than 16 GiB");
  std::istream file(&buffer);
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
