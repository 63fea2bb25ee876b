// The code in docs/plugins.md and in the pages of the interfaces is quoted from examples/, which are built.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace dspm {
namespace documentation_test {

namespace fs = std::filesystem;

std::string text_of(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

std::vector<std::string> quotes_in(const fs::path& page) {
  std::istringstream lines(text_of(page));
  std::vector<std::string> quotes;
  bool inside = false;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("```")) {
      inside = !inside && line == "```cpp";
      if (inside) quotes.emplace_back();
    } else if (inside) {
      quotes.back() += line + "\n";
    }
  }
  return quotes;
}

TEST(PluginDocumentation, QuotesWhatIsBuilt) {
  const fs::path root = DSPM_SOURCE_DIR;
  std::string sources;
  for (const auto& entry : fs::recursive_directory_iterator(root / "examples"))
    if (entry.path().extension() == ".cpp") sources += text_of(entry.path());
  std::vector<fs::path> pages = {root / "docs/plugins.md"};
  for (const auto& entry : fs::directory_iterator(root / "docs/plugins")) pages.push_back(entry.path());
  std::size_t found = 0;
  for (const fs::path& page : pages) {
    for (const std::string& quote : quotes_in(page)) {
      EXPECT_NE(sources.find(quote), sources.npos) << page << " quotes what no example says:\n" << quote;
      ++found;
    }
  }
  EXPECT_GE(found, 8u);
}

TEST(PluginDocumentation, LinksLeadSomewhere) {
  const fs::path root = DSPM_SOURCE_DIR;
  std::vector<fs::path> pages = {root / "docs/plugins.md"};
  for (const auto& entry : fs::directory_iterator(root / "docs/plugins")) pages.push_back(entry.path());
  for (const fs::path& page : pages) {
    std::string text = text_of(page);  // without its code, where brackets are no links
    for (std::size_t at; (at = text.find("```cpp")) != text.npos;) text.erase(at, text.find("```\n", at + 6) + 4 - at);
    for (std::size_t at = 0; (at = text.find("](", at)) != text.npos; ++at) {
      const std::string link = text.substr(at + 2, text.find_first_of(")#", at) - at - 2);
      if (link.empty()) continue;
      EXPECT_TRUE(fs::exists(page.parent_path() / link)) << page << ": " << link;
    }
  }
}

}  // namespace documentation_test
}  // namespace dspm
