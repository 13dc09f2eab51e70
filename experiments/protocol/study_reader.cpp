#include "experiments/protocol/study_reader.h"

#include <optional>
#include <utility>

#include "core/error.h"
#include "experiments/protocol/checked_file.h"
#include "experiments/protocol/design_rules.h"
#include "experiments/protocol/drawing_rules.h"
#include "experiments/protocol/level_doubts.h"
#include "experiments/protocol/located_json.h"
#include "experiments/protocol/session_limit_rules.h"
#include "experiments/protocol/structure_check.h"
#include "experiments/protocol/study_builder.h"
#include "experiments/protocol/study_rules.h"

namespace jnd::experiments {
namespace {

namespace fs = std::filesystem;

constexpr const char* kKind = "study file";

/// Whether sessions of the study have begun.
enum class Begun { kNo, kYes };

LocatedJson checked(const std::string& text, const std::string& file_name,
                    std::vector<StudyProblem>& problems, Begun begun = Begun::kNo) {
  if (!is_of_a_size(text, file_name, kKind, problems)) {
    std::vector<StudyProblem> of_nothing;
    return {"", file_name, of_nothing};
  }
  LocatedJson file(text, file_name, problems);
  if (file.usable()) {
    StructureCheck(file, problems).run();
    check_study_rules(file, problems);
    if (problems.empty()) {
      const Study study = build_study(file, text);
      check_drawing(file, study, problems, begun == Begun::kNo);
      check_session_limit_rules(file, study, problems);
      check_contrasts(file, study, problems);
    }
  }
  arrange(problems, file_name);
  return file;
}

}  // namespace

static Study read_text(const std::string& text, const std::string& file_name, Begun begun) {
  std::vector<StudyProblem> problems;
  const LocatedJson file = checked(text, file_name, problems, begun);
  if (!problems.empty()) throw ProtocolError(std::move(problems));
  return build_study(file, text);
}

Study read_study_text(const std::string& text, const std::string& file_name) {
  return read_text(text, file_name, Begun::kNo);
}

Study read_stored_study(const std::string& text, const std::string& file_name) {
  return read_text(text, file_name, Begun::kYes);
}

Study study_as_written(const std::string& text, const std::string& file_name) {
  std::vector<StudyProblem> problems;
  const LocatedJson file(text, file_name, problems);
  if (!file.usable()) throw ProtocolError(std::move(problems));
  if (!file.root().is_object()) {
    throw core::Error(file_name + ": expected a study, found no JSON object");
  }
  try {
    return build_study(file, text);
  } catch (const nlohmann::json::exception& error) {
    throw core::Error(file_name + ": expected a study, found " + error.what() +
                      "; was it begun with a later version?");
  }
}

Study read_study(const fs::path& file) {
  std::vector<StudyProblem> problems;
  const std::optional<std::string> text = text_of_file(file, kKind, problems);
  if (!text) throw ProtocolError(std::move(problems));
  return read_study_text(*text, file.string());
}

std::vector<StudyProblem> study_text_problems(const std::string& text,
                                              const std::string& file_name) {
  std::vector<StudyProblem> problems;
  static_cast<void>(checked(text, file_name, problems));
  return problems;
}

std::vector<StudyProblem> study_problems(const fs::path& file) {
  std::vector<StudyProblem> problems;
  const std::optional<std::string> text = text_of_file(file, kKind, problems);
  return text ? study_text_problems(*text, file.string()) : problems;
}

std::vector<StudyProblem> study_text_doubts(const std::string& text,
                                            const std::string& file_name) {
  std::vector<StudyProblem> problems;
  const LocatedJson file = checked(text, file_name, problems);
  return problems.empty() ? level_doubts(file, text) : std::vector<StudyProblem>{};
}

std::vector<StudyProblem> study_doubts(const fs::path& file) {
  std::vector<StudyProblem> problems;
  const std::optional<std::string> text = text_of_file(file, kKind, problems);
  return text ? study_text_doubts(*text, file.string()) : std::vector<StudyProblem>{};
}

}  // namespace jnd::experiments
