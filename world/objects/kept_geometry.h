// Keeps the geometry of scenes that were loaded before, for one that is loaded after an edit: shapes whose parameters
// and files are what they were are neither read nor checked again, and a tree over the same shapes at the same places
// is not built again. A scene that is loaded with it has the same bits as one that is loaded without.
#pragma once

#include <chrono>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "dspm/base/math/frames.h"
#include "dspm/base/system/file_stamp.h"
#include "dspm/base/system/files_read.h"
#include "dspm/world/objects/content_key.h"
#include "dspm/world/objects/displacements.h"
#include "dspm/world/scene/scene.h"

namespace dspm {

class KeptGeometry {
 public:
  using Clock = std::chrono::system_clock;
  using Owned = std::shared_ptr<const Shape>;

  /// If all scenes come of one description, `of_one`, files within others (inner_files.h) stay what they are, so what is
  /// made of them is kept as well.
  explicit KeptGeometry(bool of_one = false) : of_one_(of_one) {}

  /// Returns whether what was made of these files may be kept.
  bool may_keep(const FilesReadHere& files) const { return of_one_ || files.files(); }

  /// Returns what was made for that key; nullopt if it is unknown or a file that was read for it has changed.
  std::optional<MadeShapes> find(const ContentKey& key);
  /// Keeps what was made. `begin` is a time before the first of `files` was read. What may have been read while its
  /// file was being saved is not kept.
  void keep(const ContentKey& key, const MadeShapes& made, const FilesReadHere& files, Clock::time_point begin);

  /// Returns what make() returns, which must be a function of `shapes` and `what`.
  template <class T, class Make>
  std::shared_ptr<T> derived(std::vector<Owned> shapes, const ContentKey& what, Make&& make) {
    if (const std::shared_ptr<void> known = derived_before(shapes, what)) return std::static_pointer_cast<T>(known);
    std::shared_ptr<T> made = std::make_shared<T>(make());
    keep_derived(std::move(shapes), what, made);
    return made;
  }

  using MakeTree = std::function<std::unique_ptr<Accel>(std::span<const PlacedShape>)>;
  /// Returns the tree that make() builds over shapes without holes, which `owners` hold. An accelerator is a function
  /// of `which` (its name and parameters), of the shapes, and of their places and frames.
  std::unique_ptr<Accel> tree(const ContentKey& which, const std::vector<PlacedShape>& shapes,
                              std::vector<Owned> owners, FrameSet frames, const MakeTree& make);

  /// Drops what the last scenes did not have.
  void scene_is_loaded();

 private:
  struct Made {
    MadeShapes shapes;
    std::map<std::filesystem::path, std::uint64_t> digests;
    FileStamps stamps;
    int used = 0;
  };
  struct Derived {
    std::vector<Owned> shapes;  // so that no other gets the address of one
    std::shared_ptr<void> result;
    int used = 0;
  };
  using DerivedKey = std::pair<std::vector<const void*>, ContentKey>;
  struct KeptTree;

  void share_parts(KeptTree& built);
  std::shared_ptr<void> derived_before(const std::vector<Owned>& shapes, const ContentKey& what);
  void keep_derived(std::vector<Owned> shapes, const ContentKey& what, std::shared_ptr<void> made);

  const bool of_one_;
  std::mutex mutex_;  // one scene may be loaded while another is rendered
  int scenes_ = 0;
  std::map<ContentKey, Made> made_;
  std::map<DerivedKey, Derived> derived_;               // lookups only, so addresses affect no result
  std::vector<std::shared_ptr<const KeptTree>> trees_;  // the latest last
};

/// Calls kept->derived(), or make() if `kept` is null.
template <class T, class Make>
std::shared_ptr<T> derived(KeptGeometry* kept, std::vector<KeptGeometry::Owned> shapes, const ContentKey& what,
                           Make&& make) {
  if (kept != nullptr) return kept->derived<T>(std::move(shapes), what, std::forward<Make>(make));
  return std::make_shared<T>(make());
}

}  // namespace dspm
