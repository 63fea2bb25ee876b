#include "dspm/base/system/plain_text.h"

#include <cstring>
#include <stdexcept>
#include <string_view>

#include "dspm/base/system/read_file.h"

namespace dspm {
namespace {

using namespace std::string_view_literals;

/// Recognises a text by its mark, or by the zero bytes of two ASCII characters; null for other texts.
const char* wide_encoding(std::string_view text) {
  const auto is_zero = [&](std::size_t i) { return text[i] == '\0'; };
  if (text.starts_with("\xFF\xFE\0\0"sv) || text.starts_with("\0\0\xFE\xFF"sv)) return "UTF-32";
  if (text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF")) return "UTF-16";
  if (text.size() < 4 || is_zero(0) == is_zero(1)) return nullptr;
  if (is_zero(0) == is_zero(2) && is_zero(1) == is_zero(3)) return "UTF-16";
  return nullptr;
}

/// Works in place: a mesh may have gigabytes of text.
void end_lines_plainly(std::string& text) {
  const void* const first = std::memchr(text.data(), '\r', text.size());
  if (first == nullptr) return;
  auto to = static_cast<std::size_t>(static_cast<const char*>(first) - text.data());
  for (std::size_t from = to; from < text.size(); ++from) {
    const bool ends_line = text[from] == '\r';
    if (ends_line && from + 1 < text.size() && text[from + 1] == '\n') continue;
    text[to++] = ends_line ? '\n' : text[from];
  }
  text.resize(to);
}

}  // namespace

std::string plain_text(std::string text) {
  if (const char* encoding = wide_encoding(text))
    throw std::runtime_error(std::string("it is text in ") + encoding + ": save it as UTF-8");
  if (text.starts_with("\xEF\xBB\xBF")) text.erase(0, 3);
  end_lines_plainly(text);
  return text;
}

std::string read_text(const std::filesystem::path& path) { return plain_text(read_file(path)); }

}  // namespace dspm
