#include "chaos/told_events.h"

#include <sstream>

#include "core/error.h"
#include "core/storage/study_store.h"

namespace jnd::chaos {
namespace {

bool says_complete(const std::string& json) {
  return json.find("\"complete\": true") != std::string::npos;
}

/// Returns whether the study contains the line, for example "EVENT 12 trial_answered" as its
/// event number 12.
bool stands(const std::string& line, const std::vector<core::EventRow>& events) {
  std::istringstream words(line);
  std::string word, kind;
  std::size_t sequence = 0;
  words >> word >> sequence >> kind;
  return sequence >= 1 && sequence <= events.size() && events[sequence - 1].kind == kind;
}

}  // namespace

void ToldEvents::take(const test_support::ProgramOutcome& outcome) {
  std::istringstream lines(outcome.out.substr(0, outcome.out.rfind('\n') + 1));
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("EVENT ")) add(line);
  }
}

std::string ToldEvents::problem(const test_support::ProgramOptions& options) const {
  if (empty()) return "";
  const test_support::ProgramOutcome verified =
      test_support::run_program({"verify", study_, "--json"}, options);
  if (verified.exit_code != 0 || !says_complete(verified.out)) {
    return "`jnd verify` says: " + verified.out + verified.err;
  }
  const core::StudyStore store(study_, core::StudyStore::Mode::kReadOnly);
  const std::vector<core::EventRow> events = store.events(1);
  for (const std::string& line : lines_) {
    if (!stands(line, events)) return "told and lost: " + line;
  }
  return "";
}

bool ToldEvents::has_session() const {
  if (!empty()) return true;
  try {
    return !core::StudyStore(study_, core::StudyStore::Mode::kReadOnly).sessions().empty();
  } catch (const core::Error&) {
    return false;  // The program was killed before there was a session.
  }
}

bool ToldEvents::session_is_complete() const {
  return core::StudyStore(study_, core::StudyStore::Mode::kReadOnly).completed(1);
}

}  // namespace jnd::chaos
