#include "dspm/base/system/beside_library.h"

#include <dlfcn.h>

#include <system_error>

namespace dspm {

std::filesystem::path beside_library(const std::string& name) {
  Dl_info info{};
  dladdr(reinterpret_cast<const void*>(&beside_library), &info);
  std::error_code error;
  return std::filesystem::canonical(info.dli_fname, error).parent_path() / name;
}

}  // namespace dspm
