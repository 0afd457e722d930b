#include "run/checkpoint_writer.h"

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>

#include "base/error.h"
#include "io/file.h"
#include "run/results.h"
#include "run/stopwatch.h"

namespace espalier {
namespace {

namespace fs = std::filesystem;

constexpr double kLeastRest = 9;  // times what the last checkpoint cost

}  // namespace

CheckpointWriter::CheckpointWriter(RunFolder& folder, RunObserver& observer, std::string settings, double seconds,
                                   double begin_s)
    : folder_(folder),
      observer_(observer),
      settings_(std::move(settings)),
      seconds_(seconds),
      due_s_(begin_s + seconds) {}

void CheckpointWriter::stepped(const SearchSession& session) {
  if (session.last().seconds < due_s_) return;
  Stopwatch cost;
  cost.go();
  write(session);
  due_s_ = session.last().seconds + cost.seconds() + std::max(seconds_, kLeastRest * cost.seconds());
}

void CheckpointWriter::write(const SearchSession& session) {
  const fs::path staging = folder_.staging();
  try {
    folder_.guard();
    if (!begun_) {
      session.setup().inputs.write(staging.string());
      write_file((staging / kRunMarker).string(), settings_);
      begun_ = true;
    }
    write_file((staging / kCheckpointName).string(),
               encode_checkpoint(make_checkpoint(session, settings_, folder_.path())));
    folder_.keep();
  } catch (const Error& error) {
    if (!failed_) observer_.warning(fmt::format("no checkpoint at step {}: {}", session.last().step, error.what()));
    failed_ = true;
  }
}

}  // namespace espalier
