// A Markdown document whose figures a program writes and whose prose people write. What stands between
// `<!-- figures: NAME -->` and the next `<!-- end -->` is the program's; all else stays as it is.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace dspm {

/// The names of the blocks, in order. Throws std::runtime_error where a block has no end or two have one name.
std::vector<std::string> block_names(std::string_view document);

/// The document with other content in the block; throws where there is no such block.
std::string with_block(std::string_view document, std::string_view name, std::string_view content);

}  // namespace dspm
