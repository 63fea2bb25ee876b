// Who may use the page: whoever knows the token, which is part of the printed address, on dspm's own pages only. If only
// this machine can reach the page, its own names are required, too.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace dspm {

/// Where to listen.
struct ServeAddress {
  std::string host = "127.0.0.1";
  int port = 8780;  // 0: any that is free

  bool is_local() const { return host == "127.0.0.1" || host == "localhost" || host == "::1"; }
};

/// "8080", "0.0.0.0:8080", "[::1]:0" or "192.168.1.5"; nullopt for anything else.
std::optional<ServeAddress> parse_serve_address(std::string_view text);

/// The parts of a request that say who asks; empty if it does not have them.
struct RequestSource {
  std::string_view host, origin, fetch_site, path;
};

class Access {
 public:
  /// `port`: the one that was opened.
  Access(const ServeAddress& address, int port);

  /// "/<token>/": all paths begin so.
  const std::string& prefix() const { return prefix_; }
  std::string url() const;
  /// Why the request is refused; empty: it is not.
  std::string_view refusal(const RequestSource& source) const;

 private:
  bool is_own(std::string_view host) const;

  ServeAddress address_;
  std::string prefix_;
};

}  // namespace dspm
