// Whole sessions of the breeding room out of the file of projects, and into it.
#include <fmt/format.h>

#include "base/error.h"
#include "studio/breeding_writer.h"

namespace espalier::studio {

WholeBreeding BreedingStore::whole(std::int64_t project, std::int64_t session) {
  WholeBreeding whole;
  std::map<std::string, std::string> texts;
  // At one go: people may be breeding meanwhile.
  store_.alone([&](Database& database) {
    whole.head = open(project, session);
    for (const GenerationSummary& one : generations(session)) {
      whole.generations.push_back(generation(session, one.number));
      for (const StoredFile& file : whole.generations.back().state.files) {
        if (whole.files.count(file.hash) == 0) whole.files[file.hash] = store_.blob(project, file.hash);
      }
    }
    whole.individuals = individuals(session);
    whole.comparisons = comparisons(session);
    // All that no state names: derivations, those among them that recipes alone name.
    Statement ask = database.prepare(
        "select hash, bytes from breeding_text where session = ?1 and hash not in (select grammar from "
        "breeding_generation where session = ?1 union select scene from breeding_generation where "
        "session = ?1 union select files from breeding_generation where session = ?1)");
    ask.bind(session);
    while (ask.step()) texts.emplace(ask.text(0), ask.text(1));
  });
  whole.derivations = std::move(texts);
  return whole;
}

std::int64_t BreedingStore::insert(std::int64_t project, const WholeBreeding& whole) {
  std::int64_t session = 0;
  store_.alone([&](Database& database) {
    Transaction transaction(database);
    session = add_session(database, project, whole.head);
    for (const auto& [hash, bytes] : whole.files) {
      if (bytes.size() > Store::kMostFileBytes)
        throw Error(fmt::format("a file has at most {} bytes", Store::kMostFileBytes));
      database.prepare("insert or ignore into blob values (?, ?, ?)").bind(project).bind(hash).bind_blob(bytes).run();
    }
    {
      Statement ask = database.prepare("select coalesce(sum(length(bytes)), 0) from blob where project = ?");
      if (ask.bind(project).step() && static_cast<std::uint64_t>(ask.whole(0)) > Store::kMostProjectBytes) {
        throw Error(fmt::format("the files of a project have at most {} bytes", Store::kMostProjectBytes));
      }
    }
    BreedingWriter writer(database, session);
    BreedingStep texts;  // first: what was there before all generations is never taken for a gesture's
    texts.texts = whole.derivations;
    writer.add(texts);
    for (const StoredGeneration& generation : whole.generations) {
      BreedingStep content;
      content.generation = generation;
      writer.add(content);
    }
    BreedingStep content;
    content.individuals = whole.individuals;
    content.comparisons = whole.comparisons;
    writer.add(content);
    transaction.commit();
  });
  return session;
}

}  // namespace espalier::studio
