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
  std::string kind;  ///< Such as "Checklist", "Discrimination" or "Order".
  /// Not a stage but an arm of a counterbalance; its stages follow.
  bool is_arm = false;
  /// 1 in a counterbalance, 2 in one of its arms, and so on.
  int depth = 0;
  /// Such as "7 items" or "8 stimuli 5 times: 40 trials".
  std::string what;
  std::vector<std::string> details;  ///< Stimuli with units, one line each.
  /// Such as "only where priming is primed"; "" for everyone.
  std::string only_for;
  /// Expected; for a counterbalance, the time of one participant.
  double duration_s = 0.0;
  int line = 0;  ///< The line in the file, from 1.
};

/// A study file, for the person who writes it. Levels of a double-blind study are left out.
struct StudyOutline {
  std::filesystem::path file;
  std::string name, title, description;
  std::string authors, languages, blinding, device, sound;  ///< Each is in words.
  std::string citation;  ///< The publication that the study follows; may be empty.
  bool hides_levels = false;
  std::vector<OutlineStage> stages;
  int num_trials = 0;  ///< The trials of the participant who has the most.
  /// The shortest and the longest expected time over all cells.
  double shortest_s = 0.0, longest_s = 0.0;
  /// Every problem, in the order of the file. If there is one, the rest is empty.
  std::vector<experiments::StudyProblem> problems;
  /// What a valid study may not mean, as `jnd validate` warns of it; none where levels are
  /// hidden.
  std::vector<experiments::StudyProblem> doubts;
  /// The text around each problem and then around each doubt. They are empty if the file cannot
  /// be read or its text is hidden.
  std::vector<FileExcerpt> excerpts;
};

/// `shows_levels` tells that somebody has unblinded the folder to which the study belongs.
[[nodiscard]] StudyOutline outline_of(const experiments::Study& study,
                                      bool shows_levels = false);
/// The outline of a study file. It throws nothing for a wrong file, because `problems` tells
/// what is wrong.
[[nodiscard]] StudyOutline read_outline(const std::filesystem::path& file);

/// The expected time of the study's longest session, over all cells.
[[nodiscard]] double longest_session_s(const experiments::Study& study);

/// What one of the next participants will get.
struct PlannedOrder {
  std::string participant;
  std::string cells;  ///< Such as "first low, then high"; "" for one cell.
  /// Such as "Group D: 2.1, 1.2, 3.3 ... Pa s", one line each.
  std::vector<std::string> blocks;
  double duration_s = 0.0;
};

struct OrdersRequest {
  /// The folder whose completed sessions count; "" for none.
  std::filesystem::path folder;
  int num_participants = 10;
  std::uint64_t seed = 1;
};

/// The orders as the sessions will draw them with this seed. None where levels are hidden, that
/// is, if the study is double-blind and nobody has unblinded the folder. Throws `core::Error`
/// if the folder cannot be read.
[[nodiscard]] std::vector<PlannedOrder> planned_orders(const experiments::Study& study,
                                                       const OrdersRequest& request);

/// A study file that is edited in another program; it is read again whenever it was saved.
/// Editors replace files, so a file that is missing or empty for a moment has not changed yet.
class StudyWatch {
 public:
  /// Reads the file at once, and never throws for what is wrong with it. `shows_levels` is as
  /// in `outline_of`. `shows_text` tells that the person may read the file's text.
  explicit StudyWatch(std::filesystem::path file, bool shows_levels = false,
                      bool shows_text = true);

  /// Looks, at most twice a second, whether the file has changed. Returns true if there is a
  /// new outline. `now_s` is in seconds of any clock that goes forward.
  bool look(double now_s);
  [[nodiscard]] const StudyOutline& outline() const noexcept { return outline_; }
  /// The study in the file; none while it has problems.
  [[nodiscard]] const std::optional<experiments::Study>& study() const noexcept {
    return study_;
  }
  /// How often the file was read again.
  [[nodiscard]] int num_reloads() const noexcept { return num_reloads_; }

 private:
  /// What distinguishes one saved file from the next.
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
