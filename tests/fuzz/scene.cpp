// The scene language: text to description, its canonical form, which must not change when it is formatted again, and its
// translation from pbrt-v3.
#include "dspm/lang/formatter.h"
#include "dspm/lang/parse.h"
#include "dspm/lang/upgrade.h"
#include "tests/fuzz/target.h"

namespace {

using namespace dspm;

void parse(const char* name, std::string text) {
  Diagnostics diagnostics;
  const SceneDescription scene = parse_text(name, std::move(text), {{{"x", "1"}}}, diagnostics);
  for (const Diagnostic& each : diagnostics.all()) fuzz::require(!to_string(each).empty(), "a message without words");
  fuzz::require(diagnostics.error_count() > 0 || scene.frames.count() > 0, "a good scene without frames");
}

void format(const std::string& text) {
  Diagnostics diagnostics;
  const auto once = format_scene({"scene.dsc", text}, diagnostics);
  if (!once) return;
  const auto twice = format_scene({"scene.dsc", *once}, diagnostics);
  fuzz::require(twice == once, "the canonical form has another one");
}

void upgrade(const std::string& text) {
  Diagnostics diagnostics;
  const auto upgraded = upgrade_scene({"scene.pbrt", text}, diagnostics);
  fuzz::require(upgraded || diagnostics.error_count() > 0, "no translation, and no error");
  if (!upgraded) return;
  const auto again = format_scene({"scene.pbrt", *upgraded}, diagnostics);
  fuzz::require(again == upgraded, "the translation is not canonical");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(fuzz::text(data, size));
  if (text.find("Include") == text.npos && text.find("Import") == text.npos) {  // files have their own tests
    parse("scene.dsc", text);
    if (size % 4 == 0) parse("scene.pbrt", text);
  }
  format(text);
  upgrade(text);
  return 0;
}
