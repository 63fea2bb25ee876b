// What dspm does with images that exist, instead of rendering.
#pragma once

#include <string>
#include <vector>

#include "dspm/output/contact_sheet.h"
#include "dspm/output/view.h"

namespace dspm {

/// Files on the command line, and how they are shown.
struct ImageTask {
  std::vector<std::string> files;  // numbered_files() of each
  ViewSettings view;
  std::string written;  // a false colour image; empty: a name of its own
};

/// The figures of the second file against the first, in words; writes where FLIP sees errors. Throws UsageError if there
/// are not two, std::runtime_error if they cannot be read or compared.
std::string compare_images(const ImageTask& task);
/// Of the files, in their order; writes where it flickers. Likewise.
std::string measure_flicker(const ImageTask& task);

/// A sheet and a video of files; empty names: none. Says what it has written. Throws likewise, and WriteError.
struct PageFiles {
  std::string sheet, video;
  SheetStyle style;
  double fps = 0;  // 0: as the first file says, else 24
};
std::string make_pages(const ImageTask& task, const PageFiles& pages);

}  // namespace dspm
