// The media of a scene file, and what lies on which side of its shapes.
#pragma once

#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "dspm/base/math/moments.h"
#include "dspm/base/params/errors.h"
#include "dspm/lang/description.h"
#include "dspm/world/objects/content_key.h"
#include "dspm/world/objects/look.h"
#include "dspm/world/objects/timeline.h"
#include "dspm/world/scene/scene_media.h"

namespace dspm {

class Media {
 public:
  /// What is made of the same is shared with `sooner`, the media of the same scene at another time; it may be null.
  Media(const SceneDescription& description, const Media* sooner, Diagnostics& diagnostics);

  /// Returns whether any interface names a medium. If none does, scenes have no media.
  bool are_used() const { return used_; }
  /// One that gives off light in some frame, and that an interface names.
  struct Glowing {
    int medium;
    const std::string& name;
    const PluginUse& use;
    const Timeline<std::shared_ptr<const Medium>>& states;
    const std::vector<ContentKey>& keys;  // by state
  };
  std::vector<Glowing> glowing() const;
  std::vector<SceneMedium> in(const std::vector<FileFrame>& frames) const;
  /// By SceneDescription::medium_interfaces.
  const std::vector<MediumInterface>& interfaces() const { return interfaces_; }
  /// Returns one of them; of -1, none.
  MediumInterface interface(int use) const;
  const PluginUse& use_of(int medium, FileFrame frame) const;
  /// Says which of them differ between these frames, for --explain.
  std::vector<std::string> explain(std::span<const FileFrame> frames) const;

 private:
  struct OfFile {
    std::string name;
    Definition definition;
    Timeline<std::shared_ptr<const Medium>> states;
    std::vector<ContentKey> keys;                             // by state: what it is made of
    std::vector<std::shared_ptr<const Majorants>> majorants;  // by state
  };

  void add(const MediumUse& use, const Media* sooner);
  int find(const std::string& name, const SourceLocation& where);

  const SceneDescription& description_;
  Diagnostics& diagnostics_;
  std::vector<OfFile> media_;
  std::map<std::string, int> by_name_;
  std::vector<MediumInterface> interfaces_;
  bool used_ = false;
};

}  // namespace dspm
