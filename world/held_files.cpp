#include "dspm/world/held_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <string>

#include "dspm/base/params/numbered_files.h"
#include "dspm/base/params/params.h"

namespace dspm {
namespace {

class Holder {
 public:
  Holder(SceneDescription& description, const std::vector<FileFrame>& rendered, Diagnostics& diagnostics)
      : description_(description), main_directory_(description.main_directory()), diagnostics_(diagnostics) {
    for (FileFrame f(0); f.index() < description.frames.count(); ++f) all_.insert(description.frames.moment(f));
    for (const FileFrame f : rendered) rendered_.insert(description.frames.moment(f));
  }

  void hold() {
    for (auto* shapes : all_shapes())
      for (ShapeUse& use : *shapes) hold(use, use.dynamic_block);
    for (LightUse& use : description_.lights) hold(use, use.dynamic_block);
    hold_all(description_.area_lights), hold_all(description_.textures), hold_all(description_.materials);
    hold_all(description_.media);
    for (VariationAxis& axis : description_.axes)
      for (Variation& variation : axis.variations) {
        hold_all(variation.light_sources), hold_all(variation.area_lights);
        hold_all(variation.textures), hold_all(variation.materials);
        hold_all(variation.media);
      }
  }

 private:
  std::vector<std::vector<ShapeUse>*> all_shapes() {
    std::vector<std::vector<ShapeUse>*> lists{&description_.shapes};
    for (ObjectDefinition& object : description_.objects) lists.push_back(&object.shapes);
    return lists;
  }

  template <class Use>
  void hold_all(std::vector<Use>& uses) {
    for (Use& use : uses) hold(use, -1);
  }

  bool is_there(int block, Moment moment) const {
    for (; block >= 0; block = description_.dynamic_blocks[static_cast<std::size_t>(block)].outer)
      if (!description_.dynamic_blocks[static_cast<std::size_t>(block)].moments.contains(moment)) return false;
    return true;
  }

  bool is_there(const ParamList& params) const {
    Diagnostics ignored;
    return !ParamReader(params, "", {}, ignored, main_directory_).optional_file("filename", "").empty();
  }

  void hold(PluginUse& use, int block) {
    if (!has_numbered_file(use.params)) return;
    std::vector<Moment> kept, missing;
    std::string first_missing;
    for (const Moment moment : all_) {
      if (!is_there(block, moment)) continue;
      const ParamList params = use.params.at(moment);
      const Param& file = *params.find("filename");
      const std::string& name = std::get<std::vector<std::string>>(file.values).front();
      const bool is_needed = rendered_.contains(moment) || is_there(params);
      (is_needed ? kept : missing).push_back(moment);
      if (!is_needed && first_missing.empty()) first_missing = name;
    }
    if (missing.empty() || kept.empty()) return;
    const Param& file = *use.params.find("filename");
    diagnostics_.note(
        file.values_where,
        fmt::format("{} of {} files are missing, the first of them \"{}\": their frames are not rendered, "
                    "and nothing was looked at there",
                    missing.size(), missing.size() + kept.size(), first_missing));
    use.params = holding_files_of(use.params, kept);
  }

  SceneDescription& description_;
  const std::filesystem::path main_directory_;
  Diagnostics& diagnostics_;
  std::set<Moment> all_, rendered_;
};

}  // namespace

void hold_missing_files(SceneDescription& description, const std::vector<FileFrame>& rendered,
                        Diagnostics& diagnostics) {
  Holder(description, rendered, diagnostics).hold();
}

}  // namespace dspm
