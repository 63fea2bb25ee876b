#include "dspm/looking/serve/access.h"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <sys/random.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <stdexcept>

namespace dspm {
namespace {

std::string random_token() {
  std::array<unsigned char, 16> bytes;
  if (getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size()))
    throw std::runtime_error("there are no random numbers for the page's token");
  std::string token;
  for (const unsigned char byte : bytes) token += fmt::format("{:02x}", byte);
  return token;
}

std::optional<int> parse_port(std::string_view text) {
  int port = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), port);
  if (error != std::errc() || end != text.data() + text.size() || text.front() == '-' || port > 65535) return {};
  return port;
}

bool is_address(const std::string& host) {
  std::array<unsigned char, sizeof(in6_addr)> binary;
  return host == "localhost" || inet_pton(AF_INET, host.c_str(), binary.data()) == 1 ||
         inet_pton(AF_INET6, host.c_str(), binary.data()) == 1;
}

std::string bracketed(const std::string& host) { return host.find(':') == host.npos ? host : "[" + host + "]"; }

/// Compares in a time that does not tell how much of the text is right.
bool begins_with_secret(std::string_view text, std::string_view secret) {
  if (text.size() < secret.size()) return false;
  unsigned difference = 0;
  for (std::size_t i = 0; i < secret.size(); ++i)
    difference |= static_cast<unsigned>(static_cast<unsigned char>(text[i]) ^ static_cast<unsigned char>(secret[i]));
  return difference == 0;
}

}  // namespace

std::optional<ServeAddress> parse_serve_address(std::string_view text) {
  ServeAddress address;
  if (text.empty()) return {};
  if (const auto port = parse_port(text)) return address.port = *port, address;
  std::string_view host = text;
  const bool in_brackets = text.front() == '[';
  const std::size_t end = in_brackets ? text.find(']') : text.find(':');
  if (in_brackets && end == text.npos) return {};
  host = in_brackets ? text.substr(1, end - 1) : text.substr(0, end);
  std::string_view rest = end == text.npos ? "" : text.substr(in_brackets ? end + 1 : end);
  if (!rest.empty()) {
    const auto port = rest.front() == ':' ? parse_port(rest.substr(1)) : std::nullopt;
    if (!port) return {};
    address.port = *port;
  }
  address.host = host;
  return is_address(address.host) ? std::optional(address) : std::nullopt;
}

Access::Access(const ServeAddress& address, int port)
    : address_{address.host, port}, prefix_(fmt::format("/{}/", random_token())) {}

std::string Access::url() const {
  return fmt::format("http://{}:{}{}", bracketed(address_.host), address_.port, prefix_);
}

bool Access::is_own(std::string_view host) const {
  std::string small(host);
  std::transform(small.begin(), small.end(), small.begin(),
                 [](char c) { return static_cast<char>(std::tolower(static_cast<unsigned char>(c))); });
  for (const char* name : {"127.0.0.1", "localhost", "[::1]"}) {
    if (small == fmt::format("{}:{}", name, address_.port)) return true;
    if (address_.port == 80 && small == name) return true;
  }
  return false;
}

/// Refuses requests from other pages. A name in Host that is not ours is that of a foreign page whose server points it
/// to this machine. Browsers send Origin or Sec-Fetch-Site if another page asks.
std::string_view Access::refusal(const RequestSource& source) const {
  if (address_.is_local() && !is_own(source.host)) return "this is not the page's address";
  if (!source.origin.empty() && source.origin != "http://" + std::string(source.host)) return "another page asks";
  if (!source.fetch_site.empty() && source.fetch_site != "same-origin" && source.fetch_site != "none")
    return "another page asks";
  if (!begins_with_secret(source.path, prefix_))
    return "the address has a token: use the whole address that dspm printed";
  return {};
}

}  // namespace dspm
