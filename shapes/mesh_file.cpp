#include "shapes/mesh_file.h"

#include <zlib.h>

#include <algorithm>
#include <memory>
#include <stdexcept>

#include "core/files_read.h"

namespace dspm {

// zlib hands on files that are not compressed as they are.
std::string read_mesh_file(const std::filesystem::path& path) {
  constexpr std::size_t kChunk = std::size_t{1} << 20, kMost = std::size_t{1} << 34;  // above: an attack or a mistake
  const std::unique_ptr<gzFile_s, int (*)(gzFile)> file(gzopen(path.c_str(), "rb"), gzclose);
  if (!file) throw std::runtime_error("the file cannot be read");
  gzbuffer(file.get(), 1 << 17);
  std::string bytes;
  std::size_t size = 0;
  while (true) {
    bytes.resize(size + std::max(kChunk, size / 2));
    const std::size_t room = std::min(bytes.size() - size, kMost / 16);
    const int count = gzread(file.get(), bytes.data() + size, static_cast<unsigned>(room));
    int status = Z_OK;
    gzerror(file.get(), &status);
    if (count < 0 || status == Z_BUF_ERROR) throw std::runtime_error("the gzip data is damaged or ends early");
    size += static_cast<std::size_t>(count);
    if (count == 0) break;
    if (size > kMost) throw std::runtime_error("the file is larger than 16 GiB when expanded");
  }
  bytes.resize(size);
  note_file_read(path, bytes);
  return bytes;
}

}  // namespace dspm
