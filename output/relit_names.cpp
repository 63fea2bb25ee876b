#include "dspm/output/relit_names.h"

#include <optional>
#include <set>
#include <string_view>
#include <utility>

#include "dspm/base/math/moments.h"
#include "dspm/image/exr.h"
#include "dspm/output/image_name.h"
#include "dspm/output/name_template.h"

namespace dspm {
namespace {

/// What a header says of its image: the choices, and the number of its moment.
struct Original {
  std::vector<NamedPart> parts;
  std::string variation;
  int frame = 1;
};

Original original_of(const std::filesystem::path& image) {
  constexpr std::string_view kVariation = "variation";
  const ExrHeader header = read_exr_header(image);
  Original original;
  for (const auto& [name, text] : header.texts) {
    if (name == kVariation) original.variation = text;
    if (name == kVariation) original.parts.push_back({name, text});
    if (name.starts_with("variation ")) original.parts.push_back({name.substr(kVariation.size() + 1), text});
  }
  if (const auto frame = header.integers.find("frame"); frame != header.integers.end()) original.frame = frame->second;
  return original;
}

}  // namespace

std::vector<std::filesystem::path> relit_names(const std::vector<std::filesystem::path>& images,
                                               const std::string& pattern) {
  std::vector<Original> originals;
  std::set<std::pair<std::string, int>> told_apart;
  std::set<int> moments;
  for (const std::filesystem::path& image : images) {
    originals.push_back(original_of(image));
    told_apart.emplace(originals.back().variation, originals.back().frame);
    moments.insert(originals.back().frame);
  }
  std::vector<std::filesystem::path> names;
  for (std::size_t i = 0; i < images.size(); ++i) {
    const bool are_told_apart = told_apart.size() == images.size();
    const int number = are_told_apart ? originals[i].frame : static_cast<int>(i) + 1;
    if (is_template(pattern))
      names.emplace_back(filled_in(pattern, originals[i].parts, number));
    else if (are_told_apart && moments.size() < 2)
      names.push_back(image_name(pattern, std::nullopt, originals[i].variation));
    else
      names.push_back(image_name(pattern, Moment::numbered(number), are_told_apart ? originals[i].variation : ""));
  }
  return names;
}

}  // namespace dspm
