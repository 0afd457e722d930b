#pragma once
// quietly: what is done because something has failed must not fail itself.

#include <exception>

namespace espalier::studio {

/// Does it as far as it goes: where even this cannot be done (no memory, no disk), the thread lives on.
template <class Work>
void quietly(const Work& work) noexcept {
  try {
    work();
  } catch (const std::exception&) {
  }
}

}  // namespace espalier::studio
