#include <fmt/format.h>

#include <filesystem>

#include "dspm/app/options/options.h"
#include "dspm/app/tasks/tasks.h"
#include "dspm/base/system/atomic_file.h"
#include "dspm/base/system/readable.h"
#include "dspm/lang/formatter.h"
#include "dspm/lang/gltf/translation.h"
#include "dspm/session/load.h"
#include "dspm/session/messages.h"

namespace dspm {
namespace {

namespace fs = std::filesystem;

std::string write_one(const std::string& scene, const Options& options, Messages& messages) {
  if (!gltf::is_gltf_name(scene)) throw UsageError(fmt::format("--to-dsc {}: it is not a .glb or .gltf", scene));
  const fs::path out = options.outfile.empty() ? fs::path(scene).stem() += ".dsc" : fs::path(options.outfile);
  const std::string name = out.filename().string(), stem = out.stem().string();
  gltf::Translation translation;
  try {
    translation = gltf::translate(scene, stem, gltf_settings_of(options));
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(fmt::format("cannot read \"{}\": {}", scene, error.what()));
  }
  Diagnostics diagnostics;
  for (const std::string& note : translation.notes) diagnostics.note({}, fmt::format("{}: {}", scene, note));
  const std::string text = format_scene({name, translation.text}, diagnostics).value_or(translation.text);
  messages.show(diagnostics);
  const fs::path folder = out.parent_path();  // of it, which the scene's names of files are relative to
  if (const fs::path needed = translation.files.empty() ? folder : folder / stem; !needed.empty()) make_folder(needed);
  for (const auto& [file, bytes] : translation.files) write_file(folder / file, bytes());
  write_file(out, text);
  return fmt::format("{}, and {} in {}/\n", out.string(), counted(translation.files.size(), "file"),
                     (folder / stem).string());
}

}  // namespace

std::string written_as_dsc(const Options& options) {
  Messages messages(options.quiet);
  std::string written;
  for (const std::string& scene : options.scenes) written += write_one(scene, options, messages);
  return written;
}

}  // namespace dspm
