#include "experiments/study/study_problem.h"

#include <algorithm>
#include <utility>

#include "experiments/study/shown_text.h"

namespace jnd::experiments {
namespace {

std::string describe(const std::vector<StudyProblem>& problems) {
  std::string text;
  for (const StudyProblem& problem : problems) {
    if (!text.empty()) text += '\n';
    text += to_string(problem);
  }
  return text;
}

/// Optimal string alignment: insertions, deletions, substitutions and swaps of neighbours.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::vector<std::size_t>> cost(a.size() + 1,
                                             std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i) cost[i][0] = i;
  for (std::size_t j = 0; j <= b.size(); ++j) cost[0][j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t substituted = cost[i - 1][j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      cost[i][j] = std::min({cost[i - 1][j] + 1, cost[i][j - 1] + 1, substituted});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) {
        cost[i][j] = std::min(cost[i][j], cost[i - 2][j - 2] + 1);
      }
    }
  }
  return cost[a.size()][b.size()];
}

/// Returns the shortest candidate of which only the end is missing: `viscosity` for
/// `viscosity_pa_s`.
std::string begun_word(std::string_view word, const std::vector<std::string>& candidates) {
  std::string found;
  for (const std::string& candidate : candidates) {
    const bool begins = word.size() >= 3 && candidate.size() > word.size() &&
                        candidate.starts_with(word) && candidate[word.size()] == '_';
    if (begins && (found.empty() || candidate.size() < found.size())) found = candidate;
  }
  return found;
}

}  // namespace

void add_problem(std::vector<StudyProblem>& problems, StudyProblem problem) {
  if (problems.size() > kMostProblems) return;
  problem.pointer = shortened_pointer(problem.pointer);
  problems.push_back(std::move(problem));
}

std::string to_string(const StudyProblem& problem) {
  if (problem.line == 0) return problem.file + ": " + problem.message;
  return problem.file + ':' + std::to_string(problem.line) + ':' +
         std::to_string(problem.column) + ": " +
         (problem.pointer.empty() ? "/" : shown_text(problem.pointer, 1000)) + ": " +
         problem.message;
}

ProtocolError::ProtocolError(std::vector<StudyProblem> problems)
    : core::Error(describe(problems)), problems_(std::move(problems)) {}

std::string nearest_word(std::string_view word, const std::vector<std::string>& candidates) {
  // A longer word cannot have been meant for a key of ours.
  constexpr std::size_t kLongestWord = 80;
  if (word.empty() || word.size() > kLongestWord) return "";
  // A third of the letters may be wrong, but two in a short word and one in a very short one:
  // "brake" may mean break, but "foo" means nothing.
  std::size_t nearest = (word.size() < 4 ? 1 : std::max<std::size_t>(2, word.size() / 3)) + 1;
  std::string found;
  for (const std::string& candidate : candidates) {
    const std::size_t distance = edit_distance(word, candidate);
    if (distance < nearest && distance < candidate.size()) {
      nearest = distance;
      found = candidate;
    }
  }
  return found.empty() ? begun_word(word, candidates) : found;
}

std::string did_you_mean(std::string_view word, const std::vector<std::string>& candidates) {
  const std::string nearest = nearest_word(word, candidates);
  return nearest.empty() ? "" : "; did you mean `" + shown_text(nearest) + "`?";
}

}  // namespace jnd::experiments
