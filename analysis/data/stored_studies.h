#pragma once

#include <map>
#include <string>

#include "core/storage/study_store.h"
#include "experiments/study/study.h"

namespace jnd::analysis {

/// The study files that the sessions of a folder were begun with, each read once.
class StoredStudies {
 public:
  explicit StoredStudies(const core::StudyStore& store) : store_(store) {}

  /// The study of this SHA-256, as it is written; it lives as long as this does. Throws `Error`
  /// where it is none.
  const experiments::Study& study(const std::string& protocol_sha256) &;
  /// The block of that name; an empty one where the study has none, as only a study made by
  /// hand does.
  const experiments::Block& block(const std::string& protocol_sha256,
                                  const std::string& name) &;

 private:
  const core::StudyStore& store_;
  std::map<std::string, experiments::Study> studies_;
  std::map<std::string, std::map<std::string, const experiments::Block*>> blocks_;
};

/// A text in English, or in the first language that it has; "" for an empty one.
[[nodiscard]] std::string in_english(const experiments::Text& text);
/// The same in the language that results are told in, where the study has it.
[[nodiscard]] std::string in_spoken_language(const experiments::Text& text);

}  // namespace jnd::analysis
