// What viewers of the live page send, and the address on the command line.
#include <cmath>
#include <string>

#include "dspm/looking/serve/access.h"
#include "dspm/looking/serve/requests.h"
#include "tests/fuzz/target.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace dspm;
  const std::string_view text = fuzz::text(data, size);
  if (const auto request = parse_wishes(text)) {
    fuzz::require(request->seen.size() <= kMostWishes, "more wishes than are allowed");
    for (const Gallery::Seen& seen : request->seen)
      fuzz::require(seen.wish.frame >= 0 && seen.wish.halvings >= 0 && seen.wish.halvings <= 16 &&
                        !seen.wish.output.empty() && seen.wish.output.size() <= 64,
                    "a wish that nobody could have");
  }
  if (const auto count = parse_count(text, 1, 1000))
    fuzz::require(*count >= 1 && *count <= 1000, "a count out of bounds");
  if (const auto place = parse_look_at(text))
    for (const double number : *place) fuzz::require(std::isfinite(number), "a camera that is nowhere");
  if (const auto address = parse_serve_address(text))
    fuzz::require(address->port >= 0 && address->port <= 65535 && !address->host.empty(), "no address");
  // Whatever the headers hold, only the page's own names are let in.
  static const Access access({"127.0.0.1", 0}, 8780);
  const std::size_t half = size / 2;
  const std::string run = access.prefix() + "run";
  const RequestSource source{text.substr(0, half), text.substr(half), "", run};
  if (access.refusal(source).empty())
    fuzz::require(source.host.size() <= 14 && source.host.ends_with(":8780"), "a foreign name is let in");
  return 0;
}
