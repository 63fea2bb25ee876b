#include "dspm/output/name_template.h"

#include <fmt/format.h>

#include <algorithm>

#include "dspm/base/params/errors.h"
#include "dspm/base/system/atomic_file.h"

namespace dspm {
namespace {

constexpr std::string_view kFrame = "frame";
constexpr int kDigits = 4;

[[noreturn]] void fail(std::string_view pattern, const std::string& why) {
  throw UsageError(fmt::format("the images' name {}: {}", pattern, why));
}

std::string text_of(std::string_view name, std::string_view pattern, const std::vector<NamedPart>& parts, int frame) {
  if (name == kFrame) return fmt::format("{:0{}}", frame, kDigits);
  if (name.size() == kFrame.size() + 2 && name.starts_with("frame:") && name.back() >= '1' && name.back() <= '9')
    return fmt::format("{:0{}}", frame, name.back() - '0');
  std::vector<std::string> names;
  for (const NamedPart& part : parts) {
    if (part.name == name) return part.text;
    names.push_back(part.name);
  }
  names.emplace_back(kFrame);
  const std::string guess = did_you_mean(name, names);
  fail(pattern, fmt::format("{{{}}} is not known; {}there are {}", name, guess.empty() ? guess : guess + " ",
                            fmt::join(names, ", ")));
}

}  // namespace

bool is_template(std::string_view name) { return name.find('{') != name.npos; }

std::string filled_in(std::string_view pattern, const std::vector<NamedPart>& parts, int frame) {
  std::string name;
  for (std::size_t i = 0; i < pattern.size(); ++i) {
    const char c = pattern[i];
    const bool is_brace = c == '{' || c == '}';
    if (is_brace && i + 1 < pattern.size() && pattern[i + 1] == c) {
      name += pattern[i++];
    } else if (c == '{') {
      const std::size_t end = pattern.find('}', i);
      if (end == pattern.npos) fail(pattern, "a } is missing; {{ stands for the brace itself");
      name += text_of(pattern.substr(i + 1, end - i - 1), pattern, parts, frame);
      i = end;
    } else {
      name += c;
    }
  }
  return name;
}

void make_folders_of_template(std::string_view pattern, const std::filesystem::path& filled_in) {
  if (is_template(pattern) && filled_in.has_parent_path()) make_folder(filled_in.parent_path());
}

}  // namespace dspm
