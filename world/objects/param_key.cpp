#include "dspm/world/objects/param_key.h"

#include <filesystem>
#include <string>
#include <system_error>
#include <type_traits>
#include <variant>
#include <vector>

namespace dspm {
namespace {

template <class Number>
void add(ContentKey& key, const std::vector<Number>& numbers) {
  key.add(std::string_view(reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(Number)));
}
void add(ContentKey& key, const std::vector<bool>& flags) {
  for (const bool flag : flags) key.add(std::uint64_t{flag});
}

/// Adds texts. A text may name a file, which is looked for next to the file that names it first.
void add(ContentKey& key, const std::vector<std::string>& texts, const std::filesystem::path& folder) {
  for (const std::string& text : texts) {
    std::error_code ignored;
    key.add(text);
    key.add(std::uint64_t{std::filesystem::exists(folder / text, ignored)});
  }
}

void add(ContentKey& key, const Param& param) {
  const std::filesystem::path folder =
      param.where.file != nullptr ? std::filesystem::path(param.where.file->name).parent_path() : "";
  key.add(param.name);
  key.add(static_cast<std::uint64_t>(param.type)), key.add(static_cast<std::uint64_t>(param.space));
  key.add(std::uint64_t{param.values.index()}), key.add(folder.string());
  std::visit(
      [&](const auto& values) {
        key.add(std::uint64_t{values.size()});
        if constexpr (std::is_same_v<decltype(values), const std::vector<std::string>&>)
          add(key, values, folder);
        else
          add(key, values);
      },
      param.values);
}

}  // namespace

void add(ContentKey& key, const ParamList& params) {
  key.add(static_cast<std::uint64_t>(params.space));
  for (const Param& param : params.params) add(key, param);
}

}  // namespace dspm
