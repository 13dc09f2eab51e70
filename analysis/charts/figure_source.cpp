#include "analysis/charts/figure_source.h"

namespace jnd::analysis {

const ResultsSection* FigureSource::section(const std::string& name) const {
  for (const ResultsSection& one : results.sections) {
    if (one.name == name) return &one;
  }
  return nullptr;
}

const ParticipantEstimate* FigureSource::own(const std::string& section_name,
                                             const std::string& participant,
                                             const std::string& estimate) const {
  const ResultsSection* const found = section(section_name);
  if (found == nullptr) return nullptr;
  for (const ParticipantEstimate& one : found->participants) {
    if (one.participant == participant && one.name == estimate) return &one;
  }
  return nullptr;
}

std::vector<std::string> FigureSource::participants() const {
  std::vector<std::string> names;
  for (const ParticipantData& participant : data.participants) {
    names.push_back(participant.participant);
  }
  return names;
}

bool is_of_thesis(const StudyResults& results) {
  return results.citation.starts_with("Schmidt, A. (2018)");
}

}  // namespace jnd::analysis
