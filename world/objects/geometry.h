// The shapes of a scene at all their places over the frames of the file.
#pragma once

#include <algorithm>
#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "dspm/base/math/moments.h"
#include "dspm/base/params/params.h"
#include "dspm/lang/description.h"
#include "dspm/shapes/placed_shape.h"
#include "dspm/world/objects/alphas.h"
#include "dspm/world/objects/distinct_names.h"
#include "dspm/world/objects/frame_ranges.h"
#include "dspm/world/objects/kept_geometry.h"
#include "dspm/world/objects/looks.h"
#include "dspm/world/objects/shape_state.h"

namespace dspm {

class ShapeMaker;
struct UnlikeFiles;

/// A shape at one place, and the frames in which it is there.
struct WorldShape {
  PlacedShape placed;  // `frames` and `light` are set when a scene is cut
  std::shared_ptr<const Shape> shape;
  FrameRanges present;            // in the file
  FrameRanges only_parts;         // frames in which its surface is not there, but parts media
  int emitter = -1;               // which of Geometry::emitters it belongs to
  int dynamic_block = -1;         // of the description; -1: static
  bool moves = false;             // while the shutter is open, it may differ from what it is at the frame's moment
  bool is_catcher = false;        // of shadows
  const ShapeUse* use = nullptr;  // its medium_interface says what it parts
  const ObjectUse* instance = nullptr;   // null: it is no instance's
  int alpha = -1, alpha_state = 0;       // of Looks::number; -1: no holes
  bool nowhere = false;                  // a hole everywhere: no ray can meet it
  std::shared_ptr<const Cutout> cutout;  // of an emitter, whose light is made once for all frames
  bool is_unread = false;                // a box stands for its mesh, see Geometry::read
};

/// The reason why a shape emits light: its AreaLightSource, or its material. Both are null if it does not.
struct EmissionUse {
  const AreaLightUse* use = nullptr;
  int of_material = -1;  // the material, in Looks, whose light it is; -1: the directive's
};

/// An emitter: all places of one MadeShape.
struct Emitter : EmissionUse {
  std::vector<int> shapes;  // into Geometry::shapes, disjoint in frames
  bool is_hidden = false;   // a hole everywhere, in all frames: its light is there, but cannot be seen
};

/// Returns whether the shape is there in any of the first `frames` frames, or parts media.
inline bool is_there(const WorldShape& shape, int frames) {
  return shape.present.any(FileFrame(0), FileFrame(frames)) || shape.only_parts.any(FileFrame(0), FileFrame(frames));
}

class Geometry {
 public:
  /// `kept` holds the geometry of earlier scenes; null if nothing is kept.
  Geometry(const SceneDescription& description, bool check_meshes, Looks& looks, KeptGeometry* kept,
           Diagnostics& diagnostics);

  /// Reads the meshes of these frames that scenes say the extent of. Until then boxes stand for them, and bounds are
  /// those of the boxes, whichever frames are read.
  void read(std::span<const FileFrame> frames);

  const std::deque<WorldShape>& shapes() const { return shapes_; }  // addresses are stable
  const std::vector<Emitter>& emitters() const { return emitters_; }
  const Bounds3& bounds() const { return bounds_; }  // over the base of the file's frames
  /// Returns whether meshes move by the velocities of their vertices while the shutter is open.
  bool has_velocities() const { return has_velocities_; }
  /// The names by PlacedShape::object.
  const std::vector<std::string>& object_names() const { return objects_.all(); }

 private:
  struct Source;
  struct Place;
  struct Placement;
  /// A mesh that has an extent, in one state of its directive, and the shapes that it becomes.
  struct Unread {
    struct Use {
      std::size_t shape;
      Transform moved_by;
    };
    const ShapeUse* use;
    ShapeState state;
    std::vector<Use> uses;
  };
  class Joining;
  void refuse_unknown_objects();
  void find_bounds();
  /// Returns what makes the shapes of a directive whose type there is.
  ShapeMaker maker_of(const ShapeUse& use) const;
  void add_sources(const std::vector<ShapeUse>& uses, const std::vector<const ObjectUse*>& instances);
  std::optional<Source> make_source(const ShapeUse& use, Diagnostics& diagnostics, bool by_extent = true) const;
  void take_extent(const ShapeUse& use, Source& source, Diagnostics& diagnostics) const;
  bool is_wanted(const Unread& mesh, std::span<const FileFrame> frames) const;
  void put(const Unread& mesh, MadeShapes made);
  std::optional<Source> make_source(const ShapeUse& first, std::size_t begin, std::size_t end) const;
  void share_kept(Source& source) const;
  KeptGeometry* kept_for(const Source& source) const;
  void note_unlike(const ShapeUse& use, const std::optional<UnlikeFiles>& files);
  void add_source(const ShapeUse& use, const std::vector<const ObjectUse*>& instances, Source& source);
  Timeline<Place> places_of(const Source& source, const Timeline<Matrix4>& matrices, const std::vector<bool>& present,
                            std::size_t made) const;
  Placement placement(const ShapeUse& use, const ObjectUse* instance, const Source& source) const;
  static std::vector<int> only_matrices(const Timeline<Place>& places, std::size_t geometries, int base);
  void add_emitter(Emitter emitter);
  void place(const ShapeUse& use, const ObjectUse* instance, Source& source, bool alone);
  void check(const ShapeUse& use, Source& source);
  bool is_seen(int material, FileFrame frame) const;
  void leave_out_lights_of_unseen(const ShapeUse& use, Source& source);
  int object_of(const ShapeUse& use, const ObjectUse* instance);
  void warn_of_relief(const ShapeUse& use, const Source& source);
  EmissionUse emission(const ShapeUse& use, const Shape& shape, int material);

  /// Returns the file's frames, which show what blurs at other moments than the rest while the shutter is open.
  const FileFrames& frames_of(bool blurs) const { return blurs ? description_.frames : whole_frames_; }

  const SceneDescription& description_;
  const FileFrames whole_frames_;  // at the moments that they are named after
  Looks& looks_;
  Alphas alphas_;
  Diagnostics& diagnostics_;
  KeptGeometry* kept_;
  bool check_meshes_;
  std::deque<std::vector<ShapeUse>> told_apart_;  // directives of runs; addresses are stable
  std::deque<WorldShape> shapes_;
  std::vector<Unread> unread_;
  std::vector<Emitter> emitters_;
  std::deque<AreaLightUse> lights_of_materials_;  // addresses are stable
  Bounds3 bounds_;
  bool has_velocities_ = false;
  std::set<const ShapeUse*> unlike_;  // those of which it has been said that their files are unlike
  DistinctNames objects_;
  std::uint64_t placed_ = 0;                    // shapes so far, each counted once for all of its states
  std::map<const void*, int> object_of_use_;    // of an instance, or of a shape outside of blocks
  std::map<std::string, int> object_of_block_;  // blocks of one name are one object
};

}  // namespace dspm
