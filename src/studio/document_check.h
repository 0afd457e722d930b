#pragma once
// DocumentCheck: what the checker says of the grammar of an open project, and the scene's reader of its scene. Of one
// thread.

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <studio_types.h>

#include "run/scene.h"
#include "studio/grammar_check.h"
#include "studio/store.h"
#include "studio/workbench.h"

namespace espalier::studio {

class DocumentCheck {
 public:
  /// Of the document that was checked last; -1: none was.
  std::int64_t revision() const { return revision_; }
  bool done() const { return revision_ >= 0; }
  void check(const StoredState& state, std::int64_t revision, const ReadBlob& read_blob);
  /// What setting the scene up said; "" once it is mended.
  void set_setup_fault(const std::string& text) { setup_fault_ = text; }

  api::Checked message() const;
  /// The graph of the text that was checked; nothing where it has errors.
  const std::shared_ptr<const GeneratorGraph>& graph() const { return text_.compiled.graph; }
  /// The scene of a state as far as it can be read: what is wrong in it is as if it were not there.
  Scene readable_scene(const StoredState& state) const;

 private:
  std::int64_t revision_ = -1;
  CheckedText text_;
  std::vector<api::Attribute> attributes_;  // of the last text without errors
  std::string scene_fault_, setup_fault_;   // as the scene's reader says; as setting it up said
};

}  // namespace espalier::studio
