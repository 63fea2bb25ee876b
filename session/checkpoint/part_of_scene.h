// Tells which elements of a scene matter to a part of its frames.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "dspm/base/math/moments.h"
#include "dspm/lang/canonical.h"
#include "dspm/lang/description.h"
#include "dspm/world/objects/variations.h"

namespace dspm {

class PartOfScene {
 public:
  PartOfScene(const SceneDescription& scene, const FramesPart& part);

  /// Returns whether the element has a place among others, whose order matters.
  bool places(const ElementDigest& element) const;
  /// Returns whether the frames would be the same without it.
  bool can_do_without(const ElementDigest& element) const;
  /// Calls fn(FileFrame) for each frame that has the Dynamic block.
  template <class Fn>
  void for_each_with(const ElementDigest& block, Fn&& fn) const {
    const std::vector<bool> present = presence(scene_, block.dynamic_block);
    for (const FileFrame f : frames_)
      if (present[f.slot()]) fn(f);
  }

 private:
  bool is_there(int block) const { return block < 0 || there_[static_cast<std::size_t>(block)]; }

  const SceneDescription& scene_;
  std::vector<FileFrame> frames_;          // of the part
  std::vector<bool> there_;                // by Dynamic block: in some of the frames
  std::vector<std::vector<bool>> chosen_;  // by axis and variation: likewise
  std::set<std::string> objects_;          // objects that have instances there
  bool reads_materials_ = false;           // geometry files may name materials
};

}  // namespace dspm
