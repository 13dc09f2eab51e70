#include <sys/stat.h>

#include <string>
#include <utility>
#include <vector>

#include "app/operator/study_outline.h"
#include "core/error.h"
#include "experiments/protocol/study_reader.h"

namespace jnd::app {

StudyWatch::StudyWatch(std::filesystem::path file, bool shows_levels, bool shows_text)
    : file_(std::move(file)),
      shows_levels_(shows_levels),
      shows_text_(shows_text),
      stamp_(stamp()) {
  read();
}

std::optional<StudyWatch::Stamp> StudyWatch::stamp() const {
  struct stat found {};
  if (::stat(file_.c_str(), &found) != 0 || found.st_size == 0) return std::nullopt;
  constexpr std::int64_t kNsPerS = 1'000'000'000;
  return Stamp{.changed_ns = found.st_mtim.tv_sec * kNsPerS + found.st_mtim.tv_nsec,
               .size = static_cast<std::uint64_t>(found.st_size),
               .inode = found.st_ino};
}

bool StudyWatch::look(double now_s) {
  constexpr double kEvery_s = 0.5;
  constexpr double kPatience_s = 2.0;
  if (looked_s_ && now_s - *looked_s_ < kEvery_s) return false;
  looked_s_ = now_s;
  const std::optional<Stamp> found = stamp();
  if (found) {
    missing_since_s_.reset();
  } else {
    if (!missing_since_s_) missing_since_s_ = now_s;
    if (now_s - *missing_since_s_ < kPatience_s) return false;
  }
  if (found == stamp_) return false;
  stamp_ = found;
  read();
  ++num_reloads_;
  return true;
}

void StudyWatch::read() {
  study_.reset();
  outline_ = {};
  try {
    study_ = experiments::read_study(file_);
    outline_ = outline_of(*study_, shows_levels_);
    if (!outline_.hides_levels) outline_.doubts = experiments::study_doubts(file_);
  } catch (const experiments::ProtocolError& error) {
    outline_.problems = error.problems();
  } catch (const core::Error& error) {
    outline_.problems = {{.file = file_.string(), .message = error.what()}};
  }
  outline_.file = file_;
  const std::vector<std::string> lines =
      shows_text_ ? lines_of_file(file_) : std::vector<std::string>{};
  for (const auto* told : {&outline_.problems, &outline_.doubts}) {
    for (const experiments::StudyProblem& problem : *told) {
      outline_.excerpts.push_back(excerpt_at(lines, problem.line, problem.column));
    }
  }
}

}  // namespace jnd::app
