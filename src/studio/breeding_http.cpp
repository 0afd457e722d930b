#include "studio/breeding_http.h"

#include <charconv>
#include <vector>

#include <fmt/format.h>

#include "base/error.h"
#include "studio/breeding_bench.h"
#include "studio/breeding_file.h"
#include "studio/breeding_replay.h"
#include "studio/breeding_settings.h"
#include "studio/export_model.h"
#include "studio/species_zip.h"

namespace espalier::studio {
namespace {

constexpr std::int64_t kMostSpecies = 200;  // models

std::vector<std::string> split(const std::string& path) {
  std::vector<std::string> parts(1);
  for (const char c : path) {
    if (c == '/') parts.emplace_back();
    else parts.back() += c;
  }
  return parts;
}

/// -1 where it is no number.
std::int64_t number_of(const std::string& text) {
  std::int64_t number = -1;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc() && end == text.data() + text.size() ? number : -1;
}

/// An individual as the project's grammar shows it now.
ShownModel shown_model(Store& store, BreedingBench& bench, std::int64_t project, std::int64_t session,
                       std::int64_t individual) {
  BreedingStore breedings(store);
  breedings.open(project, session);
  const BredRow row = breedings.individual(session, individual);
  bench.take(store.open(project).state);
  ShownModel shown;
  shown.setup = bench.setup();
  shown.derivation = bench.read(breedings.text(session, row.derivation));
  return shown;
}

HttpResponse model_file(Store& store, std::int64_t project, std::int64_t session, std::int64_t individual,
                        const std::string& format, Executor& executor) {
  BreedingBench bench([&](const std::string& hash) { return store.blob(project, hash); }, executor);
  const ShownModel shown = shown_model(store, bench, project, session, individual);
  return export_model(shown, format, fmt::format("{} {}", store.open(project).project.name, individual));
}

HttpResponse species_file(Store& store, std::int64_t project, std::int64_t session, std::int64_t individual,
                          std::int64_t count, std::int64_t most_triangles, Executor& executor) {
  if (count < 1 || count > kMostSpecies) throw Error(fmt::format("a species pack has 1 .. {} models", kMostSpecies));
  if (most_triangles < 0) throw Error("the limit of triangles must be a number; 0 is none");
  BreedingBench bench([&](const std::string& hash) { return store.blob(project, hash); }, executor);
  const ShownModel shown = shown_model(store, bench, project, session, individual);
  const BreedingHead head = BreedingStore(store).open(project, session);
  SpeciesZipRequest request;
  request.count = static_cast<std::uint32_t>(count);
  request.settings = read_settings(head.settings);
  const std::int64_t limit = request.settings.max_triangles.value_or(0);
  if (limit == 0 || (most_triangles > 0 && most_triangles < limit)) request.settings.max_triangles = most_triangles;
  request.locked = read_locked(head.locked);
  request.seed = static_cast<std::uint64_t>(head.seed);
  request.stem = fmt::format("species-{}", individual);
  return {200, "application/zip", species_zip(bench, executor, shown.derivation, request), request.stem + ".zip"};
}

}  // namespace

BreedingAnswer answer_breeding(Store& store, std::int64_t project, const HttpRequest& request,
                               const std::string& rest, Executor& executor) {
  const std::vector<std::string> parts = split(rest);
  if (rest == "import") {
    if (request.method != "POST") return {{405, "text/plain", "POST\n"}};
    const WholeBreeding whole = parse_breeding_file(request.body);
    store.open(project);
    return {{200, "text/plain", fmt::format("{}\n", BreedingStore(store).insert(project, whole))}, true};
  }
  if (request.method != "GET") return {{405, "text/plain", "GET\n"}};
  const std::int64_t session = number_of(parts[0]);
  const std::string what = parts.size() > 1 ? parts[1] : "";
  if (what == "export" && parts.size() == 2) {
    const WholeBreeding whole = BreedingStore(store).whole(project, session);
    return {{200, "application/json", breeding_file(whole), fmt::format("breeding-{}.breeding", session)}};
  }
  if (what == "replay" && parts.size() == 2)
    return {{200, "text/plain; charset=utf-8", to_text(replay(store, project, session, executor))}};
  if (what == "model" && parts.size() == 4) return {model_file(store, project, session, number_of(parts[2]), parts[3], executor)};
  if (what == "species" && parts.size() == 5) {
    return {species_file(store, project, session, number_of(parts[2]), number_of(parts[3]), number_of(parts[4]),
                         executor)};
  }
  return {{404, "text/plain", "there is no such thing\n"}};
}

}  // namespace espalier::studio
