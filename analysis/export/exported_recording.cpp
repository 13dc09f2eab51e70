#include "analysis/export/exported_recording.h"

#include <algorithm>
#include <filesystem>

namespace jnd::analysis {
namespace {

std::vector<core::TickRange> claimed_ticks(const core::StudyStore& store,
                                           const core::SessionRow& session) {
  if (!session.recorded) return {};
  std::vector<core::TickRange> claimed;
  for (const core::TickClaim& claim : core::tick_claims(store.events(session.session))) {
    claimed.push_back(claim.ticks);
  }
  return core::merged(std::move(claimed));
}

/// The claimed ticks that are not recorded.
std::vector<core::TickRange> lost_ticks(const std::vector<core::TickRange>& recorded,
                                        const std::vector<core::TickRange>& claimed) {
  std::vector<core::TickRange> lost;
  for (const core::TickRange& claim : claimed) {
    const std::vector<core::TickRange> missing = core::missing_in(recorded, claim);
    lost.insert(lost.end(), missing.begin(), missing.end());
  }
  return lost;
}

std::vector<core::TickRange> gaps_of(const std::vector<core::TickRange>& recorded,
                                     const std::vector<core::TickRange>& lost) {
  std::vector<core::TickRange> gaps = lost;
  for (std::size_t i = 1; i < recorded.size(); ++i) {
    gaps.push_back({recorded[i - 1].last_tick + 1, recorded[i].first_tick - 1});
  }
  return core::merged(std::move(gaps));
}

std::string told(const std::string& file, const core::SessionRow& session, std::int64_t claimed,
                 std::int64_t lost, bool exists) {
  const std::string ticks = std::to_string(lost) + " of them";
  return file + ": expected the " + std::to_string(claimed) +
         " ticks that the events of session " + std::to_string(session.session) +
         " speak of, found " + (exists ? "" : "no such file, so ") +
         (lost == claimed ? "all of them" : ticks) +
         " missing; the rest is written and the gaps are told in it, and a backup may have "
         "them";
}

}  // namespace

ExportedRecording::ExportedRecording(const core::StudyStore& store,
                                     const core::SessionRow& session,
                                     const ExportOptions& options)
    : keep_going_(options.keep_going) {
  const std::filesystem::path file = store.recording_file(session.session);
  const bool exists = std::filesystem::exists(file);
  std::vector<core::TickRange> accounted;
  if (exists) {
    ticks_ = reader_.emplace(file).ticks();
    missed_ = reader_->missed();
    accounted = reader_->accounted();
  }
  const std::vector<core::TickRange> claimed = claimed_ticks(store, session);
  const std::vector<core::TickRange> lost = lost_ticks(accounted, claimed);
  gaps_ = gaps_of(ticks_, lost_ticks(ticks_, claimed));
  if (lost.empty()) return;
  problem_ =
      told(file.string(), session, core::num_ticks(claimed), core::num_ticks(lost), exists);
}

void ExportedRecording::read(std::int64_t first_tick, std::int64_t last_tick,
                             const std::function<void(const core::Sample&)>& visit) const {
  if (!any()) return;
  constexpr std::int64_t kTicksBetween = 4096;
  reader_->read(first_tick, last_tick, [&](const core::Sample& sample) {
    if (keep_going_ && sample.tick % kTicksBetween == 0) keep_going_();
    visit(sample);
  });
}

}  // namespace jnd::analysis
