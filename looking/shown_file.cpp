#include "dspm/looking/shown_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <regex>
#include <stdexcept>
#include <system_error>

#include "dspm/base/system/extension.h"
#include "dspm/image/exr.h"
#include "dspm/image/png.h"
#include "dspm/output/layer_settings.h"

namespace dspm {
namespace {

constexpr const char* kRadianceKinds[] = {".exr", ".hdr", ".pfm"};
constexpr const char* kShownKinds[] = {".png",  ".jpg", ".jpeg", ".tif", ".tiff",
                                       ".webp", ".qoi", ".bmp",  ".ppm", ".tga"};

template <class List>
bool has_extension(const std::filesystem::path& path, const List& extensions) {
  return std::find(std::begin(extensions), std::end(extensions), extension_of(path)) != std::end(extensions);
}

/// Returns an expression for a whole name, in which the number is a group; empty if the name has no place for one.
std::string expression_of(const std::string& name) {
  static const std::regex place("##+|%0?[0-9]{0,2}d"), special(R"([.^$|()\[\]{}*+?\\])");
  std::smatch found;
  if (!std::regex_search(name, found, place)) return "";
  const auto quoted = [&](const std::string& text) { return std::regex_replace(text, special, R"(\$&)"); };
  return quoted(found.prefix()) + "([0-9]{1,9})" + quoted(found.suffix());
}

}  // namespace

bool names_an_image(const std::string& name) {
  return has_extension(name, kRadianceKinds) || has_extension(name, kShownKinds);
}

Image shown_file(const std::filesystem::path& path, const View& view) {
  Image image = read_image(path);
  return has_extension(path, kRadianceKinds) ? view.shown(std::move(image)) : view.flattened(std::move(image));
}

void write_shown(const std::filesystem::path& path, const View& view, const std::filesystem::path& png) {
  const ExrHeader header = read_exr_header(path);
  const auto number = header.integers.find(kTransparentNumber);
  const bool is_transparent = number != header.integers.end() && number->second == 1;
  write_png(png, is_transparent ? view.cut_out(read_image(path)) : shown_file(path, view), view.png());
}

std::vector<std::string> numbered_files(const std::string& pattern) {
  const std::filesystem::path path(pattern);
  const std::string expression = expression_of(path.filename().string());
  if (expression.empty()) return {pattern};
  const std::regex whole(expression);
  const std::filesystem::path folder = path.has_parent_path() ? path.parent_path() : ".";
  std::map<std::pair<int, std::string>, std::string> found;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error)) {
    const std::string name = entry.path().filename().string();
    if (std::smatch parts; std::regex_match(name, parts, whole))
      found[{std::stoi(parts[1]), name}] = (path.parent_path() / name).string();
  }
  if (found.empty()) throw std::runtime_error(fmt::format("{}: there are no such files", pattern));
  std::vector<std::string> files;
  for (auto& [number, name] : found) files.push_back(name);
  return files;
}

}  // namespace dspm
