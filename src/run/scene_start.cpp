#include "run/scene_start.h"

#include <fmt/format.h>

#include "base/error.h"
#include "run/toml_section.h"

namespace espalier {
namespace {

constexpr std::size_t kMostLocks = 10'000;

constexpr Choice<LockScope> kScopes[] = {
    {"subtree", LockScope::subtree}, {"draws", LockScope::draws}, {"structure", LockScope::structure}};

}  // namespace

SceneLock parse_scene_lock(const std::string& text) {
  const std::size_t colon = text.rfind(':');
  SceneLock lock = {text.substr(0, colon), LockScope::subtree};
  if (lock.path.empty()) throw Error(fmt::format("must begin with the path of a gene, got {}", quote_toml(text)));
  if (colon == std::string::npos) return lock;
  const std::string scope = text.substr(colon + 1);
  for (const auto& [name, value] : kScopes) {
    if (name != scope) continue;
    lock.scope = value;
    return lock;
  }
  throw Error(fmt::format("must end with :subtree, :draws or :structure, or without a colon, got {}",
                          quote_toml(text)));
}

SceneStart read_start(const TomlValue& table, const std::string& file) {
  TomlSection s(table, file, "start");
  SceneStart start;
  const auto derivation = s.text("derivation");
  if (!derivation || derivation->empty()) {
    s.fail("derivation", "must be the path of a .derivation.json to start from (--from)");
  }
  start.derivation = *derivation;
  if (const TomlValue* locks = s.member("locks")) {
    if (locks->kind != TomlValue::Kind::array) s.fail("locks", "must be a list of texts, got " + describe(*locks));
    if (locks->items.size() > kMostLocks) {
      s.fail("locks", fmt::format("must be at most {} texts, got {}", kMostLocks, locks->items.size()));
    }
    for (const TomlValue& item : locks->items) {
      if (item.kind != TomlValue::Kind::text) s.fail("locks", "must be a list of texts, got " + describe(item));
      try {
        start.locks.push_back(parse_scene_lock(item.text));
      } catch (const Error& error) {
        s.fail("locks", error.what());
      }
    }
  }
  s.finish();
  return start;
}

std::string start_to_toml(const SceneStart& start) {
  if (start.derivation.empty()) return "";
  std::string locks;
  for (const SceneLock& lock : start.locks) {
    std::string text = lock.path;
    for (const auto& [name, value] : kScopes) {
      if (value == lock.scope && value != LockScope::subtree) text += fmt::format(":{}", name);
    }
    locks += (locks.empty() ? "" : ", ") + quote_toml(text);
  }
  return fmt::format("[start]\nderivation = {}\nlocks = [{}]", quote_toml(start.derivation), locks);
}

}  // namespace espalier
