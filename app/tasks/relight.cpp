#include "dspm/output/relight.h"

#include <fmt/format.h>

#include <filesystem>
#include <vector>

#include "dspm/app/options/options.h"
#include "dspm/app/tasks/tasks.h"
#include "dspm/base/params/errors.h"
#include "dspm/base/system/extension.h"
#include "dspm/looking/shown_file.h"
#include "dspm/output/group_factor.h"
#include "dspm/output/name_template.h"
#include "dspm/output/relit_names.h"
#include "dspm/output/view.h"
#include "dspm/session/distinct_files.h"
#include "dspm/session/messages.h"

namespace dspm {
namespace {

bool is_image(const std::string& argument) { return extension_of(argument) == ".exr"; }

std::filesystem::path png_of(std::filesystem::path image) { return image.replace_extension(".png"); }

}  // namespace

int relight_images(const Options& options) {
  std::vector<std::filesystem::path> images;
  std::vector<GroupFactor> factors;
  for (const std::string& argument : options.scenes)
    if (is_image(argument))
      images.emplace_back(argument);
    else
      factors.push_back(parse_group_factor(argument));
  if (images.empty()) throw UsageError("--relight: which images? They end with .exr");
  if (factors.empty())
    throw UsageError("--relight: how? \"key 0.5 [1 .8 .6]\" makes the lights of the group key darker");
  if (!is_image(options.outfile)) throw UsageError("--relight: -o names the new images, which end with .exr");

  const std::vector<std::filesystem::path> names = relit_names(images, options.outfile);
  std::vector<NamedFile> read, written, shown;
  for (std::size_t i = 0; i < images.size(); ++i) {
    read.push_back({images[i], "an image"});
    written.push_back({names[i], "its new mix"});
    if (options.png) shown.push_back({png_of(written.back().path), "its PNG"});
  }
  std::vector<NamedFile> all = written;
  all.insert(all.end(), shown.begin(), shown.end());
  expect_distinct(read, all);
  const View view(options.view);
  Messages messages(options.quiet);
  for (std::size_t i = 0; i < images.size(); ++i) {
    make_folders_of_template(options.outfile, names[i]);
    relight(images[i], factors, written[i].path);
    messages.say("{}", written[i].path.string());
    if (shown.empty()) continue;
    write_shown(written[i].path, view, shown[i].path);
    messages.say("{}", shown[i].path.string());
  }
  return 0;
}

}  // namespace dspm
