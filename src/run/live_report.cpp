#include "run/live_report.h"

#include <algorithm>
#include <ctime>
#include <exception>
#include <filesystem>

#include "io/file.h"
#include "io/png.h"
#include "run/model_files.h"
#include "run/output_look.h"
#include "run/report.h"
#include "run/report_text.h"
#include "run/scene_scorer.h"

namespace espalier {
namespace {

namespace fs = std::filesystem;

constexpr double kLargestShare = 0.1;  // of the search's computing
constexpr double kHindrance = 2;  // a second of painting costs the search up to two: its threads wait for each other
constexpr double kFirst_s = 1;         // a first picture comes soon
constexpr std::uint32_t kMostAcross = 480;
constexpr int kSamples = 4;
constexpr std::uint32_t kLeastAcross = 160;

RenderSettings small_look(const SceneOutput& output) {
  RenderSettings look = look_of(output);
  const std::uint32_t longer = std::max({look.width, look.height, kMostAcross});
  look.width = std::max(1u, look.width * kMostAcross / longer);
  look.height = std::max(1u, look.height * kMostAcross / longer);
  look.samples = kSamples;
  return look;
}

/// In proportion to the picture, so that they never cost much more.
OutcomeLook small_outcomes(const RenderSettings& look) {
  const std::uint32_t across = std::clamp(look.width, kLeastAcross, kMostAcross);
  return {{look.width * 3 / 4 + 1, look.width * 3 / 4 + 1}, look.samples, across, across * 3 / 2, 1};
}

/// Computing time so far: CLOCK_THREAD_CPUTIME_ID or CLOCK_PROCESS_CPUTIME_ID.
double computed_s(clockid_t clock) {
  timespec now{};
  clock_gettime(clock, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

}  // namespace

/// Everything that the thread uses, and nobody else.
class LiveReport::Painter {
 public:
  Painter(const Setup& setup, std::string settings, std::string folder, LiveNote note)
      : setup_(setup),
        settings_(std::move(settings)),
        folder_(std::move(folder)),
        note_(std::move(note)),
        executor_(make_serial_executor()),
        scorer_(setup.graph(), setup.objective, *executor_),
        look_(small_look(setup.scene.output)),
        expander_(setup.graph()) {}

  void paint(const Snapshot& snapshot) {
    if (!targets_) targets_ = target_pictures(setup_, look_, *executor_);
    result_.best = snapshot.best;
    result_.log = snapshot.log;
    const StepReport last = result_.log.steps().back();
    result_.steps = last.step, result_.evaluations = last.evaluations, result_.seconds = last.seconds;
    result_.explanation = scorer_.explain(result_.best.derivation);
    expander_.expand(result_.best.derivation, ExpandTo::full, model_);
    const std::vector<Material>& materials = setup_.graph().materials;
    const Surfaces surfaces = materials;
    const Picture picture = render(model_, setup_.meshes, surfaces, setup_.targets, look_, *executor_);
    const Provenance from = provenance();
    const std::string png = encode_png(picture.width, picture.height, picture.rgb, "espalier", to_json(from));
    ReportInput input{setup_, result_, from, {"Best so far", "", png}, *targets_, {}, {}, {}, note_};
    input.outcomes = outcome_pictures({setup_, model_, surfaces}, small_outcomes(look_), *executor_);
    input.model = make_report_model(model_, setup_.meshes, materials, setup_.targets);
    const std::string page = report_page(input);
    write_file((fs::path(folder_) / "best.png").string(), png);
    write_file((fs::path(folder_) / "report.html").string(), page);
  }

 private:
  Provenance provenance() const {
    Provenance p = provenance_in_folder("run", setup_.scene.seed, 0, setup_.inputs, settings_, result_.best.derivation);
    p.steps = result_.steps;
    p.engine = name_of(setup_.scene.search.engine);
    p.score = result_.best.score;
    p.optimum = setup_.objective.optimum();
    return p;
  }

  const Setup& setup_;
  std::string settings_, folder_;
  LiveNote note_;
  std::unique_ptr<Executor> executor_;
  SceneScorer scorer_;
  RenderSettings look_;
  Expander expander_;
  Model model_;
  std::optional<std::vector<ReportPicture>> targets_;
  SearchResult result_;
};

LiveReport::LiveReport(const Setup& setup, std::string settings, std::string folder, const std::string& final_folder,
                       double refresh_seconds)
    : refresh_seconds_(refresh_seconds),
      before_s_(computed_s(CLOCK_PROCESS_CPUTIME_ID)),
      due_s_(std::min(kFirst_s, refresh_seconds)) {
  LiveNote note;
  note.refresh_seconds = refresh_seconds;
  note.final_folder = "../" + url_component(fs::path(final_folder).filename().string()) + "/";
  painter_ = std::make_unique<Painter>(setup, std::move(settings), std::move(folder), std::move(note));
  thread_ = std::thread([this] { work(); });
}

LiveReport::~LiveReport() { end(); }

void LiveReport::stepped(const StepReport& report, const Individual& best) {
  log_.add(report);
  const std::lock_guard lock(mutex_);
  if (!idle_ || snapshot_ || report.seconds < due_s_ || !problem_.empty() || !affordable()) return;
  snapshot_ = Snapshot{best, log_};
  due_s_ = report.seconds + refresh_seconds_;
  wake_.notify_one();
}

/// Whether one more as dear as the last would still be within the share; the first is on credit.
bool LiveReport::affordable() const {
  if (painted_s_ == 0) return true;
  const double searched_s = computed_s(CLOCK_PROCESS_CPUTIME_ID) - before_s_ - painted_s_;
  return kHindrance * (painted_s_ + last_s_) <= kLargestShare * searched_s;
}

std::string LiveReport::end() {
  {
    const std::lock_guard lock(mutex_);
    ended_ = true;
    wake_.notify_one();
  }
  if (thread_.joinable()) thread_.join();
  return problem_;
}

void LiveReport::work() {
  std::unique_lock lock(mutex_);
  for (;;) {
    wake_.wait(lock, [this] { return ended_ || snapshot_; });
    if (ended_) return;
    const Snapshot snapshot = std::move(*snapshot_);
    snapshot_.reset();
    idle_ = false;
    lock.unlock();
    const double begin = computed_s(CLOCK_THREAD_CPUTIME_ID);
    std::string problem;
    try {
      painter_->paint(snapshot);
    } catch (const std::exception& error) {  // the search goes on without it, and is told in the end
      problem = error.what();
    }
    const double cost = computed_s(CLOCK_THREAD_CPUTIME_ID) - begin;
    lock.lock();
    problem_ = problem;
    idle_ = true;
    last_s_ = cost, painted_s_ += cost;
  }
}

}  // namespace espalier
