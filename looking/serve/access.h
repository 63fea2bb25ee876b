// Decides who may use the page: whoever knows the token, which is part of the printed address, on dspm's own pages
// only. If only this machine can reach the page, its own names are required, too.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace dspm {

/// The address to listen at.
struct ServeAddress {
  std::string host = "127.0.0.1";
  int port = 8780;  // 0: any that is free

  bool is_local() const { return host == "127.0.0.1" || host == "localhost" || host == "::1"; }
};

/// Reads "8080", "0.0.0.0:8080", "[::1]:0" or "192.168.1.5"; nullopt for anything else.
std::optional<ServeAddress> parse_serve_address(std::string_view text);

/// The parts of a request that say who asks; a part is empty if the request does not have it.
struct RequestSource {
  std::string_view host, origin, fetch_site, path;
};

class Access {
 public:
  /// `port` is the one that was opened.
  Access(const ServeAddress& address, int port);

  /// The prefix of all paths: "/<token>/".
  const std::string& prefix() const { return prefix_; }
  std::string url() const;
  /// Returns why the request is refused; empty if it is not.
  std::string_view refusal(const RequestSource& source) const;

 private:
  bool is_own(std::string_view host) const;

  ServeAddress address_;
  std::string prefix_;
};

}  // namespace dspm
