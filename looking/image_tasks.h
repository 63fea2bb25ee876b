// The tasks that dspm does with images that exist, instead of rendering.
#pragma once

#include <string>
#include <vector>

#include "dspm/output/contact_sheet.h"
#include "dspm/output/view.h"

namespace dspm {

/// The files on the command line, and how they are shown.
struct ImageTask {
  std::vector<std::string> files;  // numbered_files() of each
  ViewSettings view;
  std::string written;  // a false colour image; empty: a name of its own
};

/// Returns the figures of the second file against the first, in words; writes where FLIP sees errors. Throws UsageError
/// if there are not two, std::runtime_error if they cannot be read or compared.
std::string compare_images(const ImageTask& task);
/// Returns how the files flicker, in their order; writes where they do. Throws what compare_images() does.
std::string measure_flicker(const ImageTask& task);

/// The names of a sheet and a video of files; an empty name means none. make_pages() returns what it has written, and
/// throws what compare_images() does, and WriteError.
struct PageFiles {
  std::string sheet, video;
  SheetStyle style;
  double fps = 0;  // 0: as the first file says, else 24
};
std::string make_pages(const ImageTask& task, const PageFiles& pages);

}  // namespace dspm
