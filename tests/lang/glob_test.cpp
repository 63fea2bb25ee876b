// Patterns of names, at once and piece by piece.
#include "dspm/lang/glob.h"

#include <gtest/gtest.h>

namespace dspm {
namespace {

TEST(Glob, MatchesWholeNames) {
  EXPECT_TRUE(Glob("oak-red").matches("oak-red"));
  EXPECT_FALSE(Glob("oak").matches("oak-red"));
  EXPECT_FALSE(Glob("oak-red").matches("oak"));
  EXPECT_TRUE(Glob("").matches(""));
  EXPECT_FALSE(Glob("").matches("a"));
}

TEST(Glob, StarsStandForAnythingAndQuestionMarksForOne) {
  EXPECT_TRUE(Glob("oak-*").matches("oak-"));
  EXPECT_TRUE(Glob("*-red").matches("dark-oak-red"));
  EXPECT_TRUE(Glob("*a*a*").matches("banana"));
  EXPECT_FALSE(Glob("*a*a*").matches("bonna"));
  EXPECT_TRUE(Glob("***").matches(""));
  EXPECT_TRUE(Glob("f?bric").matches("fabric"));
  EXPECT_FALSE(Glob("f?bric").matches("fbric"));
  EXPECT_TRUE(Glob("*?").matches("x"));
  EXPECT_FALSE(Glob("*?").matches(""));
}

TEST(Glob, ReadsNamesPieceByPiece) {
  const Glob glob("o*-re?");
  Glob::State state = glob.start();
  for (const char* piece : {"oa", "k-", "r", "", "ed"}) {
    EXPECT_FALSE(glob.accepts(state));
    state = glob.after(state, piece);
  }
  EXPECT_TRUE(glob.accepts(state));
}

TEST(Glob, TakesTimeInProportionWhereBacktrackingWouldNotEnd) {
  const std::string name(5000, 'a');
  EXPECT_FALSE(Glob("*a*a*a*a*a*a*a*a*a*a*b").matches(name));
}

}  // namespace
}  // namespace dspm
