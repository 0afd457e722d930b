#pragma once
// Text from elsewhere, made fit for a message.

#include <string>
#include <string_view>

namespace espalier {

/// What is no valid UTF-8, and control characters, as \xNN: a message must not steer the terminal that shows it. With
/// `lines`, line ends stay. Text that is printable stays as it is.
std::string printable(std::string_view text, bool lines = false);

}  // namespace espalier
