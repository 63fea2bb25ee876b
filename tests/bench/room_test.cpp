// The room in which a lamp dims and the camera moves: what -D says is all that differs.
#include <gtest/gtest.h>

#include "bench/measure/run.h"

namespace dspm {
namespace room_test {

struct Counts {
  std::size_t first_lamp, second_lamp, cameras;
  friend bool operator==(const Counts&, const Counts&) = default;
};

Counts distinct_states(const std::vector<std::string>& defines) {
  const LoadedScene loaded = load(std::filesystem::path(DSPM_SOURCE_DIR) / "bench/room.dsc", defines);
  const std::unique_ptr<Scene> scene = loaded.world->scene(loaded.job.frames);
  EXPECT_EQ(scene->frame_count(), 24);
  return {scene->lights[0].states.states.size(), scene->lights[1].states.states.size(), scene->camera.states.size()};
}

TEST(Room, IsTheSameInAllFramesUnlessToldOtherwise) {
  EXPECT_EQ(distinct_states({"lamp=1", "window=1", "way=0"}), (Counts{1, 1, 1}));
}

TEST(Room, DimsItsLampsOneByOne) {
  EXPECT_EQ(distinct_states({"lamp=.1", "window=1", "way=0"}), (Counts{24, 1, 1}));
  EXPECT_EQ(distinct_states({"lamp=.1", "window=.1", "way=0"}), (Counts{24, 24, 1}));
}

TEST(Room, HasAWayForTheCamera) { EXPECT_EQ(distinct_states({"lamp=1", "window=1", "way=.4"}), (Counts{1, 1, 24})); }

}  // namespace room_test
}  // namespace dspm
