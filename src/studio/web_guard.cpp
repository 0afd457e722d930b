#include "studio/web_guard.h"

#include <array>
#include <cctype>

#include <sys/random.h>

#include <fmt/format.h>

#include "base/error.h"

namespace espalier::studio {
namespace {

constexpr std::string_view kHosts[] = {"localhost", "127.0.0.1", "[::1]"};
constexpr std::size_t kTokenBytes = 32;

}  // namespace

std::string make_token() {
  std::array<unsigned char, kTokenBytes> bytes{};
  if (getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size())) {
    throw Error("the system gives no random numbers for the token");
  }
  std::string text;
  for (const unsigned char byte : bytes) text += fmt::format("{:02x}", byte);
  return text;
}

bool is_token(std::string_view text) {
  return text.size() == 2 * kTokenBytes && text.find_first_not_of("0123456789abcdef") == std::string_view::npos;
}

bool same_token(std::string_view given, std::string_view token) {
  if (given.size() != token.size()) return false;
  unsigned char differs = 0;
  for (std::size_t i = 0; i < token.size(); ++i) {
    differs = static_cast<unsigned char>(differs | (given[i] ^ token[i]));
  }
  return differs == 0;
}

bool host_allowed(std::string_view host, std::uint16_t port) {
  for (const std::string_view name : kHosts) {
    if (host == fmt::format("{}:{}", name, port)) return true;
  }
  return false;
}

bool origin_allowed(std::string_view origin, std::uint16_t port) {
  constexpr std::string_view kScheme = "http://";
  return origin.starts_with(kScheme) && host_allowed(origin.substr(kScheme.size()), port);
}

std::string guard_headers(std::uint16_t port) {
  // Older browsers do not take 'self' to mean the WebSocket too. A policy has no way to name [::1].
  return fmt::format(
      "Content-Security-Policy: default-src 'none'; script-src 'self'; style-src 'self'; "
      "img-src 'self' blob: data:; font-src 'self'; connect-src 'self' ws://localhost:{0} ws://127.0.0.1:{0}; worker-src 'self' blob:; base-uri 'none'; "
      "form-action 'none'; frame-ancestors 'none'\r\n"
      "X-Content-Type-Options: nosniff\r\nX-Frame-Options: DENY\r\nReferrer-Policy: no-referrer\r\n"
      "Cross-Origin-Opener-Policy: same-origin\r\nCross-Origin-Resource-Policy: same-origin\r\n",
      port);
}

bool is_plain_path(std::string_view path) {
  if (path.empty() || path.size() > 200) return false;
  bool begins = true;  // a part
  for (const char c : path) {
    if (c == '/') {
      if (begins) return false;
      begins = true;
      continue;
    }
    if (begins && (c == '.' || c == ' ')) return false;
    begins = false;
    if (std::isalnum(static_cast<unsigned char>(c)) == 0 && std::string_view(" ._-()+").find(c) == std::string_view::npos) {
      return false;
    }
  }
  return !begins;
}

}  // namespace espalier::studio
