#include "dspm/shapes/mtl_statements.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <optional>
#include <string_view>
#include <vector>

#include "dspm/base/colour/observer.h"
#include "dspm/shapes/obj_statements.h"

namespace dspm {
namespace {

constexpr std::string_view kKeywords[] = {"newmtl", "Ka",     "Kd",     "Ks",     "Ke",       "Kt",      "Tf",
                                          "Ns",     "Ni",     "illum",  "d",      "Tr",       "Pr",      "Pm",
                                          "Ps",     "Pc",     "Pcr",    "aniso",  "anisor",   "norm",    "bump",
                                          "disp",   "refl",   "map_Ka", "map_Kd", "map_Ks",   "map_Ke",  "map_Ns",
                                          "map_Pr", "map_Pm", "map_Ps", "map_d",  "map_Bump", "map_disp"};
constexpr std::string_view kColours[] = {"Ka", "Kd", "Ks", "Ke", "Kt", "Tf"};

bool are_alike(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](unsigned char x, unsigned char y) { return std::tolower(x) == std::tolower(y); });
}

/// Returns a keyword in its usual case; words that are no keywords stay as they are.
std::string_view usual(std::string_view keyword) {
  for (const std::string_view each : kKeywords)
    if (are_alike(each, keyword)) return each;
  return keyword;
}

/// Reads three numbers. Missing ones are equal to the first.
std::optional<std::array<float, 3>> three_numbers(std::string_view text) {
  std::array<float, 3> numbers{};
  std::size_t count = 0;
  for (std::string_view word = next_value(text); !word.empty() && count < 3; word = next_value(text)) {
    const std::optional<float> number = obj_number(word);
    if (!number) break;
    numbers[count++] = *number;
  }
  if (count == 0) return std::nullopt;
  for (; count < 3; ++count) numbers[count] = numbers[0];
  return numbers;
}

/// Returns what a missing number of an option is; null if the option does not have three numbers.
const char* usual_number(std::string_view option) {
  return option == "-s" ? " 1" : option == "-o" || option == "-t" ? " 0" : nullptr;
}

/// Writes all three numbers after each -s, -o and -t: tinyobjloader would take the next words for them, the picture's
/// name among them.
std::string with_all_numbers(std::string_view options) {
  std::string result;
  const char* missing = nullptr;
  int count = 0;
  const auto fill = [&] {
    for (; count > 0; --count) result += missing;
  };
  while (!options.empty()) {
    const char* const begin = options.data();
    const std::string_view word = next_word(options);
    const std::string_view blanks(begin, static_cast<std::size_t>(word.data() - begin));
    if (count > 0 && obj_number(word))
      --count;
    else
      fill();
    result.append(blanks).append(word);
    if (usual_number(word) != nullptr) missing = usual_number(word), count = 3;
  }
  fill();
  return result;
}

// What stands for blanks in names of materials: newer tinyobjloaders end a name there.
constexpr std::string_view kSpaces = " \t", kStandIns = "\x1e\x1f";

std::string replaced(std::string_view text, std::string_view these, std::string_view by) {
  std::string result(text);
  for (char& c : result)
    if (const std::size_t which = these.find(c); which != these.npos) c = by[which];
  return result;
}

std::string one_word(std::string_view name) { return replaced(name, kSpaces, kStandIns); }

class Writer {
 public:
  Writer(MtlLeftOut& left_out) : left_out_(left_out) {}

  void add(const ObjStatement& s) {
    const std::string_view keyword = usual(s.keyword);
    std::string_view rest = s.rest;
    if (keyword == "newmtl") {
      material_ = rest;
      return put(keyword, one_word(rest));
    }
    if (std::find(std::begin(kColours), std::end(kColours), keyword) != std::end(kColours))
      return add_colour(keyword, rest);
    if (keyword == "d" && rest.starts_with("-halo")) {
      next_word(rest);
      leave_out("-halo of d");
    }
    const bool has_options = rest.starts_with('-') || rest.find(" -") != rest.npos || rest.find("\t-") != rest.npos;
    put(keyword, has_options ? with_all_numbers(rest) : std::string(rest));
  }
  std::string take() { return std::move(text_); }

 private:
  void add_colour(std::string_view keyword, std::string_view rest) {
    std::string_view values = rest;
    const std::string_view kind = next_word(values);
    if (kind == "spectral") return leave_out(fmt::format("{} spectral", keyword));
    const bool is_xyz = kind == "xyz";
    std::optional<std::array<float, 3>> colour = three_numbers(is_xyz ? values : rest);
    if (!colour) return put(keyword, std::string(rest));
    if (is_xyz) {
      const auto [x, y, z] = *colour;
      const std::array<double, 3> rgb = rec709({x, y, z});
      for (std::size_t c = 0; c < 3; ++c) (*colour)[c] = std::max(static_cast<float>(rgb[c]), 0.f);
    }
    put(keyword, fmt::format("{} {} {}", (*colour)[0], (*colour)[1], (*colour)[2]));
  }

  void put(std::string_view keyword, const std::string& rest) {
    text_.append(keyword).append(" ").append(rest) += '\n';
  }
  void leave_out(const std::string& what) { left_out_[what].push_back(material_); }

  MtlLeftOut& left_out_;
  std::string text_, material_;
};

}  // namespace

std::string name_from_tinyobj(std::string_view name) { return replaced(name, kStandIns, kSpaces); }

std::string for_tinyobj(const std::string& mtl, MtlLeftOut& left_out) {
  Writer writer(left_out);
  ObjStatements statements(mtl);
  while (const auto statement = statements.next()) writer.add(*statement);
  return writer.take();
}

}  // namespace dspm
