#include "dspm/world/objects/kept_geometry.h"

#include <algorithm>
#include <utility>

#include "dspm/base/math/frames.h"
#include "dspm/base/math/ray.h"

namespace dspm {
namespace {

// An edit is loaded in the coarse size and in the full one, and one scene may have errors in between.
constexpr int kScenesKept = 3;
// The tree of the frames that are rendered, that of the whole file's sample, and those of the scene before.
constexpr std::size_t kTreesKept = 3;

std::vector<const void*> addresses_of(const std::vector<KeptGeometry::Owned>& shapes) {
  std::vector<const void*> addresses;
  for (const KeptGeometry::Owned& shape : shapes) addresses.push_back(shape.get());
  return addresses;
}

bool are_met_alike(const PlacedShape& a, const PlacedShape& b) {
  return are_placed_alike(a, b) && a.moves == b.moves && a.cutout == b.cutout;
}

}  // namespace

struct KeptGeometry::KeptTree {
  ContentKey which;
  FrameSet frames;
  std::vector<PlacedShape> shapes;  // those that the tree refers to
  std::vector<Owned> owners;
  std::shared_ptr<const KeptTree> sooner;  // whose parts `accel` shares; null if it shares none
  std::unique_ptr<const Accel> accel;
};

namespace {

/// A tree that is kept, in a scene that has it.
template <class Kept>
class SharedTree final : public Accel {
 public:
  explicit SharedTree(std::shared_ptr<const Kept> kept) : kept_(std::move(kept)), accel_(*kept_->accel) {}

  HitPartition partition(const Ray& ray, FrameSet frames) const override { return accel_.partition(ray, frames); }
  FrameSet occluded(const Ray& ray, FrameSet frames) const override { return accel_.occluded(ray, frames); }
  std::size_t memory() const override { return accel_.memory(); }
  std::unique_ptr<Accel> with(std::span<const PlacedShape> shapes, FrameSet all) const override {
    return accel_.with(shapes, all);
  }

 private:
  std::shared_ptr<const Kept> kept_;
  const Accel& accel_;
};

}  // namespace

std::optional<MadeShapes> KeptGeometry::find(const ContentKey& key) {
  const std::lock_guard lock(mutex_);
  const auto found = made_.find(key);
  if (found == made_.end()) return std::nullopt;
  Made& made = found->second;
  const bool is_same = std::all_of(made.stamps.begin(), made.stamps.end(),
                                   [](const auto& file) { return stamp_of(file.first) == file.second; });
  if (!is_same) return made_.erase(found), std::nullopt;
  made.used = scenes_;
  note_files_known(made.digests);
  return made.shapes;
}

void KeptGeometry::keep(const ContentKey& key, const MadeShapes& made, const FilesReadHere& files,
                        Clock::time_point begin) {
  if (!may_keep(files)) return;
  Made kept{made, files.files().value_or(std::map<std::filesystem::path, std::uint64_t>()), {}};
  for (const auto& [file, digest] : kept.digests) {
    const FileStamp stamp = stamp_of(file);
    if (may_be_newer(stamp, begin)) return;
    kept.stamps.emplace(file, stamp);
  }
  const std::lock_guard lock(mutex_);
  kept.used = scenes_;
  made_.insert_or_assign(key, std::move(kept));
}

std::shared_ptr<void> KeptGeometry::derived_before(const std::vector<Owned>& shapes, const ContentKey& what) {
  const std::lock_guard lock(mutex_);
  const auto found = derived_.find({addresses_of(shapes), what});
  if (found == derived_.end()) return nullptr;
  found->second.used = scenes_;
  return found->second.result;
}

void KeptGeometry::keep_derived(std::vector<Owned> shapes, const ContentKey& what, std::shared_ptr<void> made) {
  const std::lock_guard lock(mutex_);
  DerivedKey key{addresses_of(shapes), what};
  derived_.insert_or_assign(std::move(key), Derived{std::move(shapes), std::move(made), scenes_});
}

std::unique_ptr<Accel> KeptGeometry::tree(const ContentKey& which, const std::vector<PlacedShape>& shapes,
                                          std::vector<Owned> owners, FrameSet frames, const MakeTree& make) {
  std::shared_ptr<const KeptTree> kept;
  {
    const std::lock_guard lock(mutex_);
    const auto is_it = [&](const auto& tree) {
      return tree->which == which && tree->frames == frames &&
             std::equal(shapes.begin(), shapes.end(), tree->shapes.begin(), tree->shapes.end(), are_met_alike);
    };
    if (const auto found = std::find_if(trees_.begin(), trees_.end(), is_it); found != trees_.end()) {
      kept = *found;
      std::rotate(found, found + 1, trees_.end());
    }
  }
  if (kept == nullptr) {
    auto built = std::make_shared<KeptTree>(KeptTree{which, frames, shapes, std::move(owners), nullptr, nullptr});
    share_parts(*built);
    if (built->accel == nullptr) built->accel = make(built->shapes);
    kept = std::move(built);
    const std::lock_guard lock(mutex_);
    if (trees_.size() == kTreesKept) trees_.erase(trees_.begin());
    trees_.push_back(kept);
  }
  return std::make_unique<SharedTree<KeptTree>>(std::move(kept));
}

/// Makes the tree from the parts of one before, if what is static has stayed.
void KeptGeometry::share_parts(KeptTree& built) {
  std::vector<std::shared_ptr<const KeptTree>> trees;
  {
    const std::lock_guard lock(mutex_);
    trees = trees_;
  }
  for (const auto& tree : trees) {
    const auto& whole = tree->sooner != nullptr ? tree->sooner : tree;
    if (whole->which != built.which || whole->frames != built.frames) continue;
    built.accel = whole->accel->with(built.shapes, built.frames);
    if (built.accel != nullptr) return void(built.sooner = whole);
  }
}

void KeptGeometry::scene_is_loaded() {
  const std::lock_guard lock(mutex_);
  ++scenes_;
  const auto is_old = [this](const auto& kept) { return kept.second.used + kScenesKept <= scenes_; };
  std::erase_if(made_, is_old);
  std::erase_if(derived_, is_old);
}

}  // namespace dspm
