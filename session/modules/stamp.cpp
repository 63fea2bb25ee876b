#include "dspm/session/modules/stamp.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>

namespace dspm {
namespace {

constexpr const char* kBuildAgain = "rebuild it against the dspm that is to load it";

std::string in_words(const std::uint32_t (&version)[3]) {
  return fmt::format("dspm {}.{}.{}", version[0], version[1], version[2]);
}

}  // namespace

std::string why_unfit(std::string_view note) {
  constexpr ModuleStamp here = current_stamp();
  ModuleStamp there;
  if (note.size() < offsetof(ModuleStamp, sizes)) return fmt::format("its stamp is truncated: {}", kBuildAgain);
  std::memcpy(&there, note.data(), std::min(note.size(), sizeof(there)));
  if (!std::equal(here.version, here.version + 2, there.version))  // patch releases change no layout
    return fmt::format("it was built for {}, and this is {}: {}", in_words(there.version), in_words(here.version),
                       kBuildAgain);
  if (there.cxx_abi != here.cxx_abi || there.new_strings != here.new_strings)
    return fmt::format("it was built for {} with another C++ ABI than this {}: {}, with g++ 12 or clang 14",
                       in_words(there.version), in_words(here.version), kBuildAgain);
  if (there.interface != here.interface || there.type_count != here.type_count || note.size() < sizeof(there))
    return fmt::format("it was built with the headers of another {}: {}", in_words(here.version), kBuildAgain);
  for (std::size_t i = 0; i < std::size(kStampedTypes); ++i)
    if (there.sizes[i] != here.sizes[i])
      return fmt::format("{} takes {} bytes there, but {} in this {}: {}, with the settings of dspm::dspm",
                         kStampedTypes[i].name, there.sizes[i], here.sizes[i], in_words(here.version), kBuildAgain);
  return {};
}

}  // namespace dspm
