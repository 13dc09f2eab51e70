#include "analysis/export/table_rows.h"

#include <algorithm>
#include <set>

namespace jnd::analysis {
std::vector<ExportedTrial> exported_trials(const core::StudyStore& store,
                                           std::int64_t session) {
  std::vector<std::int64_t> standing;
  for (const core::TrialRow& row : store.trials(session)) standing.push_back(row.sequence);
  std::sort(standing.begin(), standing.end());
  const std::string hash = store.session(session).protocol_sha256;
  StoredStudies studies(store);
  std::vector<ExportedTrial> trials;
  for (core::TrialRow& row : store.trials(session, true)) {
    const bool stands = std::binary_search(standing.begin(), standing.end(), row.sequence);
    const experiments::Block& block = studies.block(hash, row.block);
    trials.push_back({.row = std::move(row),
                      .excluded = !stands,
                      .is_practice = block.practice.has_value(),
                      .standard_medium = block.standard_medium});
  }
  return trials;
}

std::vector<ExportedPresentation> exported_presentations(
    const core::StudyStore& store, std::int64_t session,
    const std::vector<ExportedTrial>& trials) {
  std::set<std::int64_t> excluded;
  for (const ExportedTrial& trial : trials) {
    if (trial.excluded) excluded.insert(trial.row.trial);
  }
  std::vector<ExportedPresentation> presentations;
  for (core::PresentationRow& row : store.presentations(session, true)) {
    const bool is_excluded = excluded.contains(row.trial);
    presentations.push_back({.row = std::move(row), .excluded = is_excluded});
  }
  return presentations;
}

const std::vector<QuestionnaireItem>& StudyQuestions::of(const core::SessionRow& session) {
  const auto [found, is_new] = by_hash_.try_emplace(session.protocol_sha256);
  if (is_new) {
    found->second = questionnaire_items(studies_.study(session.protocol_sha256));
  }
  return found->second;
}

std::string field_column(const std::string& field, const std::vector<std::string>& taken) {
  return std::ranges::find(taken, field) == taken.end() ? field : "field_" + field;
}

}  // namespace jnd::analysis
