#include "bench/report/document.h"

#include <gtest/gtest.h>

#include "bench/sections/section.h"
#include "dspm/base/system/read_file.h"

namespace dspm {
namespace document_test {

const std::string kDocument =
    "# Results\n\nProse.\n<!-- figures: first -->\nold\n<!-- end -->\nMore.\n<!-- figures: second -->\n<!-- end -->\n";

TEST(Document, KnowsItsBlocks) {
  EXPECT_EQ(block_names(kDocument), (std::vector<std::string>{"first", "second"}));
  EXPECT_TRUE(block_names("no block").empty());
}

TEST(Document, ReplacesABlockAndNothingElse) {
  EXPECT_EQ(with_block(kDocument, "first", "new\nlines"),
            "# Results\n\nProse.\n<!-- figures: first -->\nnew\nlines\n<!-- end -->\nMore.\n<!-- figures: second -->\n"
            "<!-- end -->\n");
  EXPECT_EQ(with_block(kDocument, "second", "x"),
            "# Results\n\nProse.\n<!-- figures: first -->\nold\n<!-- end -->\nMore.\n<!-- figures: second -->\nx\n"
            "<!-- end -->\n");
}

TEST(Document, ReplacingTwiceIsReplacingOnce) {
  const std::string once = with_block(kDocument, "first", "new");
  EXPECT_EQ(with_block(once, "first", "new"), once);
}

TEST(Document, ResultsHaveABlockForEverySection) {
  std::vector<std::string> names;
  for (const Section& section : sections()) names.emplace_back(section.name);
  EXPECT_EQ(block_names(read_file(DSPM_SOURCE_DIR "/docs/results.md")), names);
}

TEST(Document, RefusesWhatItCannotTell) {
  EXPECT_THROW(with_block(kDocument, "third", ""), std::runtime_error);
  EXPECT_THROW(block_names("<!-- figures: a -->\n"), std::runtime_error);
  EXPECT_THROW(block_names("<!-- figures: a"), std::runtime_error);
  EXPECT_THROW(block_names("<!-- figures: a --><!-- figures: b --><!-- end -->"), std::runtime_error);
  EXPECT_THROW(block_names("<!-- figures: a --><!-- end --><!-- figures: a --><!-- end -->"), std::runtime_error);
}

}  // namespace document_test
}  // namespace dspm
