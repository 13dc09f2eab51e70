#include "experiments/protocol/study_reader.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <optional>
#include <tuple>
#include <utility>

#include "core/error.h"
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

/// Far more than anybody writes; what is known of each value takes memory.
constexpr std::size_t kLargestStudy = std::size_t{4} << 20;

/// As much of a stream as a study may have, and a byte more if there is more: also of what has
/// no end, such as a device or a pipe.
std::string text_of(std::istream& stream) {
  std::string text(kLargestStudy + 1, '\0');
  stream.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(stream.gcount()));
  return text;
}

/// The whole file, or a problem in words.
std::optional<std::string> file_text(const fs::path& file,
                                     std::vector<StudyProblem>& problems) {
  const auto refuse = [&](const std::string& found) -> std::optional<std::string> {
    problems.push_back(
        {file.string(), 0, 0, "", "expected a study file that can be read, found " + found});
    return std::nullopt;
  };
  std::error_code error;
  const fs::file_status status = fs::status(file, error);
  if (!fs::exists(status)) return refuse("no such file");
  if (fs::is_directory(status)) return refuse("a folder");
  errno = 0;
  std::ifstream stream(file, std::ios::binary);
  if (!stream) return refuse(errno != 0 ? std::strerror(errno) : "a file that does not open");
  std::string text = text_of(stream);
  if (stream.bad()) return refuse("an error while reading it");
  return text;
}

/// A study that is to be begun, or one that was.
enum class Begun { kNo, kYes };

LocatedJson checked(const std::string& text, const std::string& file_name,
                    std::vector<StudyProblem>& problems, Begun begun = Begun::kNo) {
  if (text.size() > kLargestStudy) {
    problems.push_back({file_name, 0, 0, "",
                        "expected at most 4 MiB of text, found more; is this a study file?"});
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
    }
  }
  std::stable_sort(problems.begin(), problems.end(),
                   [](const StudyProblem& a, const StudyProblem& b) {
                     return std::tie(a.line, a.column) < std::tie(b.line, b.column);
                   });
  if (problems.size() > kMostProblems) {
    const StudyProblem last = problems[kMostProblems];
    problems.resize(kMostProblems);
    problems.push_back({file_name, last.line, last.column, "",
                        "expected no more than " + std::to_string(kMostProblems) +
                            " problems, found more; mend these first"});
  }
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
  const std::optional<std::string> text = file_text(file, problems);
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
  const std::optional<std::string> text = file_text(file, problems);
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
  const std::optional<std::string> text = file_text(file, problems);
  return text ? study_text_doubts(*text, file.string()) : std::vector<StudyProblem>{};
}

}  // namespace jnd::experiments
