#pragma once

#include <map>
#include <string>

#include "core/storage/study_store.h"
#include "experiments/study/study.h"

namespace jnd::analysis {

/// The study files with which the sessions of a folder were begun. Each is read once.
class StoredStudies {
 public:
  explicit StoredStudies(const core::StudyStore& store) : store_(store) {}

  /// The study with this SHA-256, as it is written. It lives as long as this object. Throws
  /// `Error` if there is none.
  const experiments::Study& study(const std::string& protocol_sha256) &;
  /// The block of that name. It is empty if the study has none, which happens only in a study
  /// that was made by hand.
  const experiments::Block& block(const std::string& protocol_sha256,
                                  const std::string& name) &;

 private:
  const core::StudyStore& store_;
  std::map<std::string, experiments::Study> studies_;
  std::map<std::string, std::map<std::string, const experiments::Block*>> blocks_;
};

/// A text in English, or in its first language; "" for an empty text.
[[nodiscard]] std::string in_english(const experiments::Text& text);
/// The text in the language of the results, if the study has it.
[[nodiscard]] std::string in_spoken_language(const experiments::Text& text);

}  // namespace jnd::analysis
