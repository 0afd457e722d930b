#pragma once
// Publisher: makes of a derivation what pages are told of it: the model, its meshes where they are new, and the words
// beside them. Of one thread at a time.

#include <cstdint>
#include <memory>

#include "model/expand.h"
#include "score/target.h"
#include "studio/outbox.h"
#include "studio/shown_model.h"
#include "studio/workbench.h"

namespace espalier::studio {

struct Published {
  ShownModelPtr model;
  ModelPacket packet;
};

class Publisher {
 public:
  /// `setup`: the bench's, at its state of `revision`. `steps`: as of ShownModel.
  Published publish(const Workbench& bench, const std::shared_ptr<const Setup>& setup, std::int64_t revision,
                    Derivation derivation, std::uint64_t steps);

 private:
  Explanation explain(const ShownModel& shown, Expander& expander);
  void update_table(const Workbench& bench, const Setup& setup);

  std::uint32_t number_ = 0;
  Bytes meshes_;
  std::uint32_t table_ = 0, meshes_of_ = 0;  // number of the mesh table; of the grammar that it was made of
  Model model_, view_;
};

}  // namespace espalier::studio
