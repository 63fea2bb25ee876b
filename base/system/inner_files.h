// Files that lie inside others, as if those were folders: "shoe.glb/seat.ply". Whoever reads the outer file offers
// them; read_bytes finds them, and they are made when they are read. Files in memory are found in the same way.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace dspm {

/// Offers a file. `bytes` may throw std::runtime_error with a sentence that does not name the file. A file that is
/// offered again is replaced. If it changes with time, `later` returns what it is so many frames later. Thread-safe.
void offer_inner_file(const std::filesystem::path& path, std::function<std::string()> bytes,
                      std::function<std::string(double frames)> later = {});

bool is_inner_file(const std::filesystem::path& path);
/// Returns whether it is a file that changes with time, which also has the names that name_later() returns.
bool is_moving_file(const std::filesystem::path& path);
std::string name_later(const std::string& name, double frames);
/// Returns nullopt if nobody has offered the file.
std::optional<std::string> inner_file(const std::filesystem::path& path);

/// Replaces files on disk, or adds to them, as long as it exists. The files count as read.
class FilesInMemory {
 public:
  explicit FilesInMemory(std::map<std::filesystem::path, std::string> files);
  ~FilesInMemory();
  FilesInMemory(const FilesInMemory&) = delete;
  FilesInMemory& operator=(const FilesInMemory&) = delete;

 private:
  struct Offer;
  std::vector<Offer> offers_;
};

}  // namespace dspm
