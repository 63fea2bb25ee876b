// "bool open" of a mesh: no warning of its holes; other faults are told as ever.
#include <gtest/gtest.h>

#include "dspm/session/load.h"

namespace dspm::test {
namespace open_mesh_test {

/// What is said about two sides of a glass box, or three if the second disagrees about the outside.
std::vector<std::string> warnings_of_mesh(const std::string& param, bool twisted = false) {
  const std::string scene = "WorldBegin LightSource \"infinite\" Material \"dielectric\" Shape \"trianglemesh\" " +
                            std::string("\"point3 P\" [0 0 0  1 0 0  0 1 0  0 0 1] \"integer indices\" ") +
                            (twisted ? "[0 1 2  0 1 3] " : "[0 1 2  0 3 1] ") + param;
  Diagnostics diagnostics;
  const LoadedScene loaded("scene.dsc", scene, {}, diagnostics);
  std::vector<std::string> texts;
  for (const Diagnostic& each : diagnostics.all()) texts.push_back(each.message);
  return texts;
}

TEST(OpenMesh, IsWarnedOfUnlessItIsMeantToBe) {
  ASSERT_EQ(warnings_of_mesh("").size(), 1u);
  EXPECT_NE(warnings_of_mesh("").front().find("it is not closed but has 1 hole"), std::string::npos)
      << warnings_of_mesh("").front();
  EXPECT_EQ(warnings_of_mesh("\"bool open\" false").size(), 1u);
  EXPECT_EQ(warnings_of_mesh("\"bool open\" true"), std::vector<std::string>{});
  ASSERT_EQ(warnings_of_mesh("\"bool open\" true", true).size(), 1u);
  EXPECT_NE(warnings_of_mesh("\"bool open\" true", true).front().find("disagree about the outside"), std::string::npos);
}

}  // namespace open_mesh_test
}  // namespace dspm::test
