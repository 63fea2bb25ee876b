#include <algorithm>

#include "dspm/app/options/options.h"
#include "dspm/app/tasks/tasks.h"
#include "dspm/base/system/standard_streams.h"
#include "dspm/looking/image_tasks.h"
#include "dspm/looking/shown_file.h"
#include "dspm/session/messages.h"

namespace dspm {

bool are_images(const Options& options) {
  return !options.scenes.empty() && std::all_of(options.scenes.begin(), options.scenes.end(), names_an_image);
}

void look_at_images(const Options& options) {
  ImageTask task{{}, options.view, options.outfile};
  for (const std::string& name : options.scenes) {
    const std::vector<std::string> files = numbered_files(name);
    task.files.insert(task.files.end(), files.begin(), files.end());
  }
  if (options.task == Task::compare) return print_data(compare_images(task));
  if (options.task == Task::flicker) return print_data(measure_flicker(task));
  const std::string made = make_pages(task, {options.contact_sheet, options.video, options.sheet, options.page_fps});
  if (!options.quiet) print_message("dspm: " + made);
}

}  // namespace dspm
