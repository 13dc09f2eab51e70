#include "experiments/protocol/checked_file.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <tuple>

namespace jnd::experiments {
namespace {

namespace fs = std::filesystem;

/// Far larger than any real file. The limit matters because what is stored for each value takes
/// memory.
constexpr std::size_t kLargestText = std::size_t{4} << 20;

/// Reads as much of a stream as a file may have, and a byte more if there is more. So it also
/// ends for a device or a pipe, which has no end.
std::string text_of(std::istream& stream) {
  std::string text(kLargestText + 1, '\0');
  stream.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(stream.gcount()));
  return text;
}

}  // namespace

std::optional<std::string> text_of_file(const fs::path& file, const std::string& kind,
                                        std::vector<StudyProblem>& problems) {
  const auto refuse = [&](const std::string& found) -> std::optional<std::string> {
    problems.push_back(
        {file.string(), 0, 0, "", "expected a " + kind + " that can be read, found " + found});
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

bool is_of_a_size(const std::string& text, const std::string& file_name,
                  const std::string& kind, std::vector<StudyProblem>& problems) {
  if (text.size() <= kLargestText) return true;
  problems.push_back({file_name, 0, 0, "",
                      "expected at most 4 MiB of text, found more; is this a " + kind + "?"});
  return false;
}

void arrange(std::vector<StudyProblem>& problems, const std::string& file_name) {
  std::stable_sort(problems.begin(), problems.end(),
                   [](const StudyProblem& a, const StudyProblem& b) {
                     return std::tie(a.line, a.column) < std::tie(b.line, b.column);
                   });
  if (problems.size() <= kMostProblems) return;
  const StudyProblem last = problems[kMostProblems];
  problems.resize(kMostProblems);
  problems.push_back({file_name, last.line, last.column, "",
                      "expected no more than " + std::to_string(kMostProblems) +
                          " problems, found more; mend these first"});
}

}  // namespace jnd::experiments
