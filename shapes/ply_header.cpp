#include "dspm/shapes/ply_header.h"

#include <fmt/format.h>

#include <charconv>
#include <optional>

namespace dspm {
namespace {

std::vector<std::string_view> words_of(std::string_view line) {
  std::vector<std::string_view> words;
  constexpr std::string_view kSpace = " \t\r";
  for (std::size_t at = line.find_first_not_of(kSpace); at != std::string_view::npos;) {
    const std::size_t end = std::min(line.find_first_of(kSpace, at), line.size());
    words.push_back(line.substr(at, end - at));
    at = line.find_first_not_of(kSpace, end);
  }
  return words;
}

std::optional<PlyType> type_of(std::string_view word) {
  static constexpr std::pair<std::string_view, PlyType> table[] = {
      {"char", PlyType::int8},      {"int8", PlyType::int8},       {"uchar", PlyType::uint8},
      {"uint8", PlyType::uint8},    {"short", PlyType::int16},     {"int16", PlyType::int16},
      {"ushort", PlyType::uint16},  {"uint16", PlyType::uint16},   {"int", PlyType::int32},
      {"int32", PlyType::int32},    {"uint", PlyType::uint32},     {"uint32", PlyType::uint32},
      {"float", PlyType::float32},  {"float32", PlyType::float32}, {"double", PlyType::float64},
      {"float64", PlyType::float64}};
  for (const auto& [name, type] : table)
    if (name == word) return type;
  return std::nullopt;
}

class HeaderReader {
 public:
  explicit HeaderReader(std::string_view file) : file_(file) {}

  /// Reads lines as plain_text() does, which is for texts that do not go on in bytes. The first line says whether lines
  /// end with \r alone: after the last, a \n may be the first byte of the numbers.
  PlyHeader read() {
    if (file_.starts_with("\xEF\xBB\xBF")) header_.size = 3;  // a byte order mark
    const std::size_t end = std::min(file_.find_first_of("\r\n", header_.size), file_.size());
    if (file_.substr(end, 1) == "\r" && file_.substr(end, 2) != "\r\n") line_end_ = '\r';
    if (next_line() != std::vector<std::string_view>{"ply"}) throw std::runtime_error("this is not a PLY file");
    bool has_format = false;
    while (true) {
      const std::vector<std::string_view> words = next_line();
      if (words.empty() || words[0] == "comment" || words[0] == "obj_info") continue;
      if (words[0] == "end_header") break;
      if (words[0] == "format")
        has_format = true, read_format(words);
      else if (words[0] == "element")
        read_element(words);
      else if (words[0] == "property")
        read_property(words);
      else
        fail(fmt::format("unknown word \"{}\"", words[0]));
    }
    if (!has_format) fail("the header has no format line");
    return std::move(header_);
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw std::runtime_error(fmt::format("{} (line {})", what, header_.lines));
  }

  std::vector<std::string_view> next_line() {
    const std::size_t end = file_.find(line_end_, header_.size);
    if (end == std::string_view::npos) throw std::runtime_error("the PLY header does not end");
    const std::string_view line = file_.substr(header_.size, end - header_.size);
    header_.size = end + 1;
    ++header_.lines;
    return words_of(line);
  }

  void read_format(const std::vector<std::string_view>& words) {
    const std::string_view name = words.size() > 1 ? words[1] : "";
    if (name == "ascii")
      header_.format = PlyFormat::ascii;
    else if (name == "binary_little_endian")
      header_.format = PlyFormat::little_endian;
    else if (name == "binary_big_endian")
      header_.format = PlyFormat::big_endian;
    else
      fail(fmt::format("unknown format \"{}\"", name));
  }

  void read_element(const std::vector<std::string_view>& words) {
    PlyElement element;
    if (words.size() != 3) fail("expected: element NAME COUNT");
    element.name = words[1];
    const char* end = words[2].data() + words[2].size();
    const auto [stop, error] = std::from_chars(words[2].data(), end, element.count);
    if (error != std::errc() || stop != end) fail(fmt::format("\"{}\" is not a count", words[2]));
    header_.elements.push_back(std::move(element));
  }

  void read_property(const std::vector<std::string_view>& words) {
    if (header_.elements.empty()) fail("a property before the first element");
    const bool is_list = words.size() == 5 && words[1] == "list";
    if (!is_list && words.size() != 3) fail("expected: property TYPE NAME, or property list TYPE TYPE NAME");
    const auto type = type_of(words[words.size() - 2]), count_type = is_list ? type_of(words[2]) : PlyType::uint8;
    if (!type || !count_type) fail("unknown number type");
    if (is_list && (*count_type == PlyType::float32 || *count_type == PlyType::float64))
      fail("a list's count must be of integer type");
    header_.elements.back().properties.push_back({std::string(words.back()), *type, is_list, *count_type});
  }

  std::string_view file_;
  char line_end_ = '\n';
  PlyHeader header_;
};

}  // namespace

PlyHeader read_ply_header(std::string_view file) { return HeaderReader(file).read(); }

}  // namespace dspm
