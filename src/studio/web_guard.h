#pragma once
// Who may speak to the server: names that mean this machine, pages that it served itself, and whoever knows its token.

#include <cstdint>
#include <string>
#include <string_view>

namespace espalier::studio {

/// 256 random bits as hex digits. Throws Error where the system gives none.
std::string make_token();

/// Whether it looks like one.
bool is_token(std::string_view text);

/// In time that depends on the lengths alone.
bool same_token(std::string_view given, std::string_view token);

/// Whether a Host header names this machine's loopback: localhost, 127.0.0.1 or [::1], with the port. Names that other
/// sites point at 127.0.0.1 are refused by this.
bool host_allowed(std::string_view host, std::uint16_t port);

/// The same for an Origin header: "http://" and such a host.
bool origin_allowed(std::string_view origin, std::uint16_t port);

/// Headers of every answer, each ending with \r\n: nothing is loaded from elsewhere, no script stands in a page's text.
std::string guard_headers(std::uint16_t port);

/// A path below some folder: no empty, dotted or hidden parts, letters, digits and " ._-()+" alone, at most 200 bytes.
bool is_plain_path(std::string_view path);

}  // namespace espalier::studio
