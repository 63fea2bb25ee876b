// ParamReader: files, looked for next to the file that names them and next to the main one.
#include <fmt/format.h>

#include <algorithm>
#include <system_error>

#include "dspm/base/params/params.h"
#include "dspm/base/system/file_access.h"

namespace dspm {
namespace {

/// Returns a hint for a name that is numbered as other programs write it: "wave.####.ply".
std::string numbered_as(const std::string& name) {
  const std::size_t first = name.find('#'), end = std::min(name.find_first_not_of('#', first), name.size());
  if (first == std::string::npos) return {};
  const std::string ours = fmt::format("{}%0{}d{}", name.substr(0, first), end - first, name.substr(end));
  return fmt::format("a frame's number is written as in \"{}\", in a Dynamic block; ", ours);
}

}  // namespace

std::filesystem::path ParamReader::file(std::string_view name, std::string_view sentence) {
  return take_file(name, true, sentence);
}

std::filesystem::path ParamReader::optional_file(std::string_view name, std::string_view sentence) {
  return take_file(name, false, sentence);
}

std::filesystem::path ParamReader::take_file(std::string_view name, bool required, std::string_view sentence) {
  const Param* param = take_some(name, {ParamType::text}, 1, required ? "required" : "none", "file", sentence);
  if (described_) return {};
  if (!param) {
    if (required && !has(name)) error({}, fmt::format("{} needs a file: \"string {}\"", subject_, name));
    return {};
  }
  const std::string& file_name = std::get<std::vector<std::string>>(param->values).front();
  if (file_name.empty() && !required) return {};  // exporters write it where there is none
  std::filesystem::path found = existing_file(*param, file_name);
  if (!found.empty()) return found;
  std::vector<std::string> tried;
  for (const auto& place : places(*param, file_name)) tried.push_back(place.string());
  diagnostics_.error(param->values_where, fmt::format("there is no file \"{}\"", file_name),
                     fmt::format("{}looked for {}", numbered_as(file_name), fmt::join(tried, " and ")));
  return {};
}

std::vector<std::filesystem::path> ParamReader::places(const Param& param, const std::string& name) const {
  const std::filesystem::path naming_file = param.where.file ? param.where.file->name : "";
  std::vector<std::filesystem::path> places{naming_file.parent_path() / name};
  if (main_directory_ / name != places.front()) places.push_back(main_directory_ / name);
  return places;
}

std::filesystem::path ParamReader::existing_file(const Param& param, const std::string& name) const {
  for (const std::filesystem::path& place : places(param, name)) {
    std::error_code ignored;
    if (!name.empty() && seems_to_exist(place) && !std::filesystem::is_directory(place, ignored)) return place;
  }
  return {};
}

}  // namespace dspm
