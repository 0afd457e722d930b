#include "studio/document_check.h"

#include <map>

#include "base/error.h"
#include "studio/scene_json.h"

namespace espalier::studio {

void DocumentCheck::check(const StoredState& state, std::int64_t revision, const ReadBlob& read_blob) {
  revision_ = revision;
  // Kinds of attributes are known from the last good text; of new ones the next check knows.
  std::map<std::string, std::string> values;
  try {
    values = attributes_of(state.scene, text_.kinds);
  } catch (const Error&) {
  }
  const std::map<std::string, Kind> kinds_before = text_.kinds;
  CheckedText text = check_text(state.grammar, values, import_reader(state.files, read_blob));
  if (text.compiled.checked && text.kinds != kinds_before) {
    values = attributes_of(state.scene, text.kinds);
    if (!values.empty()) text = check_text(state.grammar, values, import_reader(state.files, read_blob));
  }
  if (!text.compiled.checked) text.kinds = kinds_before;
  text_ = std::move(text);
  if (text_.compiled.checked) attributes_ = text_.attributes;
  scene_fault_.clear();
  try {
    read_scene(state.scene, {kGrammarName, "", text_.kinds});
  } catch (const Error& error) {
    scene_fault_ = error.what();
  }
}

api::Checked DocumentCheck::message() const {
  api::Checked message;
  message.revision = revision_;
  message.problems = text_.problems;
  message.symbols = text_.symbols;
  message.attributes = attributes_;
  const std::string& fault = scene_fault_.empty() ? setup_fault_ : scene_fault_;
  if (!fault.empty()) message.scene_problem = fault;
  return message;
}

Scene DocumentCheck::readable_scene(const StoredState& state) const {
  try {
    return read_scene(state.scene, {kGrammarName, "", text_.kinds}).scene;
  } catch (const Error&) {
    return {};
  }
}

}  // namespace espalier::studio
