#include "work_stage.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace condyle::cli {
namespace {

WholeProgress* whole = nullptr;  // the one there is

}  // namespace

WholeProgress::WholeProgress(std::string what, std::vector<std::vector<double>> pieces)
    : progress_(std::in_place, std::move(what)), pieces_(std::move(pieces)) {
  whole = this;
}

WholeProgress::~WholeProgress() {
  whole = nullptr;
}

void WholeProgress::end_piece() {
  ++piece_, stage_ = 0, done_ = 0, name_.clear();
}

void WholeProgress::update(std::string_view name, std::size_t done, std::size_t total) {
  // A name may come again: of limits, then of measures.
  if (!name_.empty() && (name != name_ || done < done_)) ++stage_;
  name_ = name, done_ = done;
  double before = 0, all = 0;
  for (std::size_t p = 0; p < pieces_.size(); ++p)
    for (std::size_t s = 0; s < pieces_[p].size(); ++s) {
      const bool is_now = p == piece_ && s == stage_;
      if (p < piece_ || (p == piece_ && s < stage_)) before += pieces_[p][s];
      if (is_now) before += pieces_[p][s] * static_cast<double>(done) / static_cast<double>(total);
      all += pieces_[p][s];
    }
  share_ = std::max(share_, before / all);
  if (progress_) progress_->update(share_);
}

WorkStage::WorkStage(Writes writes)
    : kept_(writes == Writes::parts ? "the same command goes on from here" : "nothing is written") {}

void WorkStage::update(std::string_view name, std::size_t done, std::size_t total) {
  const std::scoped_lock lock(mutex_);
  if (whole) {
    whole->update(name, done, total);
    name_ = name;
  } else {
    if (!progress_ || name_ != name) progress_.emplace(name_ = name);
    progress_->update(done, total);
  }
  done_ = done, total_ = total;
}

std::string WorkStage::interrupted() {
  const std::scoped_lock lock(mutex_);
  progress_.reset();
  if (whole) whole->wipe();
  if (name_.empty()) return "interrupted; " + kept_;
  return fmt::format("interrupted after {} of {} {}; {}", done_, total_, name_, kept_);
}

void WorkStage::end_piece() {
  if (whole) whole->end_piece();
}

}  // namespace condyle::cli
