// The command line, an argument a line.
#include <string>
#include <vector>

#include "dspm/app/options/options.h"
#include "tests/fuzz/target.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace dspm;
  std::vector<std::string> arguments;
  std::string_view rest = fuzz::text(data, size);
  while (!rest.empty()) {
    const std::size_t end = std::min(rest.find('\n'), rest.size());
    arguments.emplace_back(rest.substr(0, end));
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  try {
    const Options options = parse_options(arguments);
    fuzz::require(options.threads >= 0, "a number of threads below nothing");
  } catch (const UsageError&) {
  } catch (const Information&) {}
  return 0;
}
