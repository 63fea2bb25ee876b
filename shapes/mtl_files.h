// The material files that an OBJ file names.
#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <string_view>

#include "dspm/shapes/mtl.h"
#include "dspm/shapes/obj.h"

namespace dspm {

class MtlFiles {
 public:
  /// Adds materials and complaints to `out`.
  MtlFiles(const std::filesystem::path& directory, const ObjCompanion& companion, ObjFile& out)
      : directory_(directory), companion_(companion), out_(out) {}

  /// Reads the files that follow `mtllib`: one name or several. Names may have spaces, so the most words that name a
  /// file are one.
  void read_named(std::string_view names);
  void complain_of_what_is_left_out();

 private:
  bool read(std::string_view name);

  const std::filesystem::path& directory_;
  const ObjCompanion& companion_;
  ObjFile& out_;
  MtlLeftOut left_out_;
  std::set<std::string> read_;
};

}  // namespace dspm
