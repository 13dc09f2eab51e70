#include "analysis/data/presentation_use.h"
#include "experiments/study/media.h"

#include <map>
#include <set>

namespace jnd::analysis {
namespace {

/// A block with more intensities has set, not designed ones.
constexpr std::size_t kMostUsedLevels = 32;

struct Sums {
  int num_presented = 0, num_used = 0;
  std::set<std::string> participants;
  double width_m = 0.0, speed_m_per_s = 0.0;
};

using ByLevel = std::map<std::optional<double>, Sums>;

/// The sums of one interval of a block, for each level unless people set them.
ByLevel sums_of(const StudyData& data, const std::string& block, const std::string& interval,
                bool by_level) {
  ByLevel sums;
  for (const ParticipantData& participant : data.participants) {
    const auto found = participant.presentations.find(block);
    if (found == participant.presentations.end()) continue;
    for (const core::PresentationRow& row : found->second) {
      if (row.interval != interval) continue;
      Sums& sum = sums[by_level ? std::optional(row.intensity) : std::nullopt];
      ++sum.num_presented;
      if (!is_used(row)) continue;
      ++sum.num_used;
      sum.participants.insert(participant.participant);
      sum.width_m += row.measures.stroke_width_m.value_or(0.0);
      sum.speed_m_per_s += row.measures.max_speed_m_per_s.value_or(0.0);
    }
  }
  return sums;
}

std::map<std::string, std::set<double>> levels_by_interval(const StudyData& data,
                                                           const std::string& block) {
  std::map<std::string, std::set<double>> levels;
  for (const ParticipantData& participant : data.participants) {
    const auto found = participant.presentations.find(block);
    if (found == participant.presentations.end()) continue;
    for (const core::PresentationRow& row : found->second) {
      if (row.interval != "free_space") levels[row.interval].insert(row.intensity);
    }
  }
  return levels;
}

}  // namespace

bool is_used(const core::PresentationRow& row) {
  return row.interval != "free_space" && row.measures.num_strokes > 0 &&
         row.measures.stroke_width_m;
}

std::vector<PresentationUse> presentation_uses(const StudyData& data) {
  std::vector<PresentationUse> uses;
  for (const BlockDesign& block : data.blocks) {
    // A solid is pressed, so a presentation cannot hold a stroke.
    if (experiments::is_pressed(block.medium)) continue;
    for (const auto& [interval, levels] : levels_by_interval(data, block.block)) {
      const bool by_level = levels.size() <= kMostUsedLevels;
      for (const auto& [level, sum] : sums_of(data, block.block, interval, by_level)) {
        PresentationUse use{.block = block.block,
                            .interval = interval,
                            .intensity = level,
                            .num_presented = sum.num_presented,
                            .num_used = sum.num_used,
                            .num_participants = static_cast<int>(sum.participants.size())};
        if (sum.num_used > 0) {
          use.stroke_width_m = sum.width_m / sum.num_used;
          use.max_speed_m_per_s = sum.speed_m_per_s / sum.num_used;
        }
        uses.push_back(std::move(use));
      }
    }
  }
  return uses;
}

}  // namespace jnd::analysis
