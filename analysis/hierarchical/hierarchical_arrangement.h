#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "analysis/hierarchical/hierarchical_fit.h"
#include "analysis/hierarchical/hierarchical_model.h"

namespace jnd::analysis {

/// The answers as the model takes them.
struct HierarchicalArrangement {
  std::vector<std::string> conditions;  ///< In the order of their first answers.
  std::vector<double> reference;        ///< Reference intensity of each condition.
  std::vector<std::string> participants;
  std::vector<HierarchicalPerson> people;
  std::vector<std::vector<AnswerCount>> pooled;  ///< Rows of each condition.
  std::vector<int> num_in_condition;
  bool yes_at_zero = false;
  std::vector<bool> has_orders_in;  ///< Of each condition: rows differ in the order.
};

/// Throws `core::Error` where a condition has several references, or a participant two entries
/// in one.
[[nodiscard]] HierarchicalArrangement arranged(const std::vector<ParticipantAnswers>& answers);

/// What the options make of it: which numbers there are, and what moves them.
[[nodiscard]] HierarchicalStructure structure_of(const HierarchicalArrangement& all,
                                                 const HierarchicalOptions& options);

/// Where the search starts: the pooled curves, people who differ by a fifth, and a lapse in a
/// hundred. Absent, with a reason, where a condition's pooled answers have no curve.
[[nodiscard]] std::optional<Eigen::VectorXd> start_of(const HierarchicalArrangement& all,
                                                      const HierarchicalStructure& structure,
                                                      std::string& reason);

}  // namespace jnd::analysis
