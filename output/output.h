// The files of a run: an image for each frame, the contact sheet, the video.
#pragma once

#include <filesystem>
#include <mutex>
#include <optional>
#include <vector>

#include "dspm/base/math/moments.h"
#include "dspm/image/exr.h"
#include "dspm/image/image.h"
#include "dspm/output/denoised.h"
#include "dspm/output/layer_settings.h"
#include "dspm/output/output_layer.h"
#include "dspm/output/sheet_file.h"
#include "dspm/output/video.h"
#include "dspm/output/view.h"
#include "dspm/session/distinct_files.h"
#include "dspm/session/job/job.h"
#include "dspm/session/messages.h"
#include "dspm/world/world.h"

namespace dspm {

/// Files besides the images that the Film names.
struct OutputSettings : LayerSettings {
  bool images = true;                // false: only statistics and other files
  bool png = false;                  // of every image
  std::string contact_sheet, video;  // files; empty: none
  std::string index;                 // the table of all images, .csv or .json; empty: none
  SheetStyle sheet;                  // of the contact sheet
  ViewSettings view;                 // of PNGs, the sheet and the video
  std::string stats;                 // "table", or a file for JSON ("-": standard output); empty: no statistics
  bool stats_in_file() const { return !stats.empty() && stats != "table" && stats != "-"; }
};

/// The figures of an image for its header.
struct FrameFigures {
  int iterations = 0;
  std::uint64_t photons = 0;  // paths
  double seconds = 0;
  std::optional<double> error = {};  // estimated
  double radius_in_pixels = 0;       // within which photons are gathered; 0: none are
  CameraMatrices camera = {};
};

/// The other files of a run, which Output must not replace.
struct OtherFiles {
  std::vector<NamedFile> read, written;
};

class Output {
 public:
  /// Throws WriteError if a file cannot be written, and warns if there may be too little room for all of them: better
  /// before rendering than after. Calls `end_wanted` while the video is tried and made.
  Output(const Job& job, const OutputSettings& settings, const OtherFiles& others, Messages& messages,
         Video::EndWanted end_wanted);

  /// The path of the image of a frame of the file.
  std::filesystem::path name(FileFrame frame) const;
  /// The path of its second image, if there is a denoiser.
  std::filesystem::path denoised_name(FileFrame frame) const { return layer_file(frame, kDenoised); }
  /// A frame's image, and its PNG if that is another file.
  std::vector<std::filesystem::path> image_files(FileFrame frame) const { return with_png(name(frame)); }
  /// The most memory that writing takes.
  std::size_t bytes_while_writing() const;
  /// Writes the image of a frame of the file, given its radiance over the crop, and replaces an earlier one. Throws
  /// WriteError, but tries its PNG anyway. The contact sheet shows the image that was written last. Several threads may
  /// write images of different frames, `alone`: each by itself.
  void write(FileFrame frame, Image radiance, const std::vector<OutputLayer>& layers, const FrameFigures& figures,
             bool alone = false);
  /// Writes its second image in the same way, with no layer but alpha.
  void write_denoised(FileFrame frame, Image radiance, const std::vector<OutputLayer>& layers,
                      const FrameFigures& figures);
  /// Writes the sheet with all images so far, if one was asked for.
  void write_contact_sheet() const;
  /// To the video, if one was asked for: an image of every frame, one after the other.
  void add_to_video(Image radiance, const std::vector<OutputLayer>& layers);
  /// Writes the video. Throws WriteError if it cannot be made.
  void finish_video();

 private:
  /// Returns all files that the run writes, except the video.
  std::vector<NamedFile> files(const OutputSettings& settings, const OtherFiles& others) const;
  /// The path of an output that has a file of its own.
  std::filesystem::path layer_file(FileFrame frame, const std::string& label) const;
  /// The bytes of all images, uncompressed.
  std::uint64_t bytes_on_disk() const;
  ExrHeader header(FileFrame frame, const FrameFigures& figures) const;
  /// Returns the layers as a file holds them, and adds to its header what it has to say of them.
  std::vector<ExrLayer> exr_layers(const std::vector<const OutputLayer*>& layers, ExrHeader& header) const;
  /// A file and, if PNGs are wanted, its PNG.
  std::vector<std::filesystem::path> with_png(const std::filesystem::path& image) const;
  /// As PNGs, the sheet and the video show it: developed, and with the alpha among the layers if the film is transparent.
  Image to_be_shown(Image radiance, const std::vector<OutputLayer>& layers) const;
  /// What is to be shown, to both; for the sheet, too.
  void write_views(FileFrame frame, const std::filesystem::path& name, const Image& image, const ExrHeader& header,
                   const std::vector<ExrLayer>& more, const ExrFormat& format);
  /// Writes each output to a file of its own.
  void write_apart(FileFrame frame, const std::vector<const OutputLayer*>& layers, const ExrHeader& header,
                   const ExrFormat& format) const;

  const Job& job_;
  View view_;
  bool png_;
  LayerSettings layers_;
  std::optional<SheetFile> sheet_;
  std::mutex of_sheet_;
  std::optional<Video> video_;
};

}  // namespace dspm
