#pragma once
// What is said of a model that is shown.

#include <studio_types.h>

#include "model/model.h"
#include "score/target.h"
#include "studio/model_message.h"
#include "studio/shown_model.h"

namespace espalier::studio {

api::Shown shown_text(const ShownModel& shown, const Explanation& explanation, const Model& model, const SentModel& sent);

}  // namespace espalier::studio
