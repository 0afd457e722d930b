#pragma once
// Settings of a breeding session between the page, the file of projects, and the room that breeds.

#include <string>
#include <string_view>
#include <vector>

#include <studio_types.h>

#include "breed/settings.h"
#include "breed/viability.h"

namespace espalier::studio {

/// All that apply, where `asked` says nothing by the defaults of its method.
api::RoomSettings complete(const api::RoomSettings& asked);
/// `change` laid over them. Throws Error where the method would change: a session keeps its own.
api::RoomSettings changed(api::RoomSettings settings, const api::RoomSettings& change);

bool may_rate(const api::RoomSettings& settings);
bool may_edit(const api::RoomSettings& settings);

/// Of complete ones. Throw Error.
BreedSettings breed_settings(const api::RoomSettings& settings);
ViabilitySettings viability_settings(const api::RoomSettings& settings);

/// As kept in the file of projects. The inverses throw Error.
std::string settings_text(const api::RoomSettings& settings);
api::RoomSettings read_settings(std::string_view text);
std::string locked_text(const std::vector<api::DrawPlace>& locked);
std::vector<api::DrawPlace> read_locked(std::string_view text);

}  // namespace espalier::studio
