#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/operator/file_excerpt.h"
#include "app/operator/study_words.h"
#include "experiments/study/study.h"
#include "experiments/study/study_problem.h"

namespace jnd::app {

/// A stage as its author reads it.
struct OutlineStage {
  std::string title;
  std::string kind;     ///< "Checklist", "Discrimination", "Order" ...
  bool is_arm = false;  ///< No stage, but an arm of a counterbalance, whose stages follow.
  int depth = 0;        ///< Within a counterbalance: 1, in an arm of it: 2, and so on.
  std::string what;     ///< "7 items", "8 stimuli 5 times: 40 trials".
  std::vector<std::string> details;  ///< Stimuli with units, a line each.
  std::string only_for;              ///< "only where priming is primed"; "" for everyone.
  double duration_s = 0.0;           ///< Expected; of a counterbalance, for one participant.
  int line = 0;                      ///< In the file, from 1.
};

/// A study file for the person who writes it. Of a double-blind one levels are left out.
struct StudyOutline {
  std::filesystem::path file;
  std::string name, title, description;
  std::string authors, languages, blinding, device, sound;  ///< In words.
  std::string citation;  ///< Of the study it follows; may be empty.
  bool hides_levels = false;
  std::vector<OutlineStage> stages;
  int num_trials = 0;                        ///< Trials of the participant with the most.
  double shortest_s = 0.0, longest_s = 0.0;  ///< Expected, over all cells.
  /// Every problem, as the file has them; the rest is empty if there is one.
  std::vector<experiments::StudyProblem> problems;
  /// What a sound study may not mean, as `jnd validate` warns of it; none where levels are
  /// hidden.
  std::vector<experiments::StudyProblem> doubts;
  /// The text around each of these: the problems' first, then the doubts'. Empty ones where the
  /// file cannot be read, or where its text is hidden.
  std::vector<FileExcerpt> excerpts;
};

/// `shows_levels`: somebody unblinded the folder it is read for.
[[nodiscard]] StudyOutline outline_of(const experiments::Study& study,
                                      bool shows_levels = false);
/// The outline of a study file. Throws nothing for what is wrong with it: that is `problems`.
[[nodiscard]] StudyOutline read_outline(const std::filesystem::path& file);

/// How long the longest session of the study is expected to take, whatever the cell.
[[nodiscard]] double longest_session_s(const experiments::Study& study);

/// What one of the next participants will get.
struct PlannedOrder {
  std::string participant;
  std::string cells;                ///< "first low, then high"; "" for one cell.
  std::vector<std::string> blocks;  ///< "Group D: 2.1, 1.2, 3.3 ... Pa s", a line each.
  double duration_s = 0.0;
};

struct OrdersRequest {
  std::filesystem::path folder;  ///< Whose completed sessions count; "" for none.
  int num_participants = 10;
  std::uint64_t seed = 1;
};

/// As the sessions will draw them with this seed. None where levels are hidden: double-blind,
/// and nobody has unblinded the folder. Throws `core::Error` for a folder that cannot be read.
[[nodiscard]] std::vector<PlannedOrder> planned_orders(const experiments::Study& study,
                                                       const OrdersRequest& request);

/// A study file that is edited elsewhere, read again whenever it was saved. Editors replace
/// files, so one that is missing or empty for a moment is no change yet.
class StudyWatch {
 public:
  /// Reads it at once. Never throws for what is wrong with the file. `shows_levels` as in
  /// `outline_of`; `shows_text`: whoever looks may read the file.
  explicit StudyWatch(std::filesystem::path file, bool shows_levels = false,
                      bool shows_text = true);

  /// Looks whether the file changed, twice a second at most. True if there is a new outline.
  /// `now_s`: seconds on any clock that goes forward.
  bool look(double now_s);
  [[nodiscard]] const StudyOutline& outline() const noexcept { return outline_; }
  /// The study as it is in the file; nothing while it has problems.
  [[nodiscard]] const std::optional<experiments::Study>& study() const noexcept {
    return study_;
  }
  /// How often it was read again.
  [[nodiscard]] int num_reloads() const noexcept { return num_reloads_; }

 private:
  /// What tells one saved file from the next.
  struct Stamp {
    std::int64_t changed_ns = 0;
    std::uint64_t size = 0, inode = 0;
    bool operator==(const Stamp&) const = default;
  };
  [[nodiscard]] std::optional<Stamp> stamp() const;
  void read();

  std::filesystem::path file_;
  bool shows_levels_;
  bool shows_text_;
  std::optional<Stamp> stamp_;
  std::optional<double> looked_s_, missing_since_s_;
  StudyOutline outline_;
  std::optional<experiments::Study> study_;
  int num_reloads_ = 0;
};

}  // namespace jnd::app
