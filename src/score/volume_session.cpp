#include "score/volume_session.h"

#include <algorithm>

#include "base/check.h"

namespace espalier {
namespace {

constexpr std::uint32_t kLongestWait = 64;

/// Taking away and adding cost a little more than drawing; where much changes, the whole is cheaper.
bool is_small(const ModelChange& change) {
  return change.before.size() >= VolumeSession::kFewestParts &&
         2 * (change.removed.size() + change.added.size()) <= change.before.size();
}

}  // namespace

double VolumeSession::score(const Derivation& derivation, const Model& model, const ModelChange& change,
                            TargetScratch* scratch) {
  CHECK(scratch != nullptr);
  take_back();
  auto& memory = static_cast<VolumeScratch&>(*scratch);
  if (is_small(change) && (holds_ || hold(change.before, memory)) && apply(change, memory)) {
    proposal_ = Proposal::counted;
    return target_.evaluate(proposed_);
  }
  proposal_ = Proposal::whole;
  return target_.score(derivation, model, scratch);
}

void VolumeSession::take_back() {
  if (proposal_ == Proposal::counted) canvas_->undo();
  proposal_ = Proposal::none;
}

void VolumeSession::commit() {
  CHECK(proposal_ != Proposal::none);
  if (proposal_ == Proposal::counted) {
    canvas_->keep();
    std::swap(counts_, proposed_);
  } else {
    holds_ = false;  // until it is worth while again
  }
  proposal_ = Proposal::none;
  if (wait_ > 0) --wait_;
}

void VolumeSession::restart() {
  take_back();
  holds_ = false;
}

bool VolumeSession::hold(std::span<const Instance> state, VolumeScratch& scratch) {
  if (wait_ > 0) return false;
  if (!canvas_) canvas_ = std::make_unique<CountingCanvas>(Lattice(kernel_.grid()));
  canvas_->clear();
  canvas_->copying = canvas_->down = false;
  kernel_.draw(state, target_.settings().view, scratch, *canvas_);
  if (canvas_->overflowed()) {
    wait_ = next_wait_;
    next_wait_ = std::min(2 * next_wait_, kLongestWait);
    return false;
  }
  next_wait_ = 1;
  counts_ = VolumeCounts();
  counts_.inside.assign(kernel_.targets().size(), 0);
  kernel_.add_change(*canvas_, counts_);
  counts_.hits = canvas_->hits;
  counts_.outside = canvas_->outside;
  canvas_->keep();
  canvas_->copying = holds_ = true;
  return true;
}

/// Sets proposed_; false, and the canvas as before, where too many parts lie in one place.
bool VolumeSession::apply(const ModelChange& change, VolumeScratch& scratch) {
  proposed_ = counts_;
  canvas_->down = true;
  kernel_.draw(change.removed, target_.settings().view, scratch, *canvas_);
  DCHECK(!canvas_->overflowed());
  proposed_.hits -= canvas_->hits;
  proposed_.outside -= canvas_->outside;
  canvas_->down = false;
  kernel_.draw(change.added, target_.settings().view, scratch, *canvas_);
  if (canvas_->overflowed()) {
    canvas_->undo();
    return false;
  }
  proposed_.hits += canvas_->hits;
  proposed_.outside += canvas_->outside;
  kernel_.add_change(*canvas_, proposed_);
  return true;
}

}  // namespace espalier
