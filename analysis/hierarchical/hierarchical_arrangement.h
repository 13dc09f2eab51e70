#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "analysis/hierarchical/hierarchical_fit.h"
#include "analysis/hierarchical/hierarchical_model.h"

namespace jnd::analysis {

/// The answers in the form that the model needs.
struct HierarchicalArrangement {
  /// The conditions, in the order of their first answers.
  std::vector<std::string> conditions;
  std::vector<double> reference;  ///< The reference intensity of each condition.
  std::vector<std::string> participants;
  std::vector<HierarchicalPerson> people;
  std::vector<std::vector<AnswerCount>> pooled;  ///< The rows of each condition.
  std::vector<int> num_in_condition;
  bool yes_at_zero = false;
  /// For each condition, whether its rows differ in the order of the intervals.
  std::vector<bool> has_orders_in;
};

/// Throws `core::Error` if a condition has several references, or if a participant has two
/// entries in a condition.
[[nodiscard]] HierarchicalArrangement arranged(const std::vector<ParticipantAnswers>& answers);

/// The structure that the options ask for: which numbers a person has, and what moves them.
[[nodiscard]] HierarchicalStructure structure_of(const HierarchicalArrangement& all,
                                                 const HierarchicalOptions& options);

/// The start of the search: the pooled curves, with people who differ by a fifth and a lapse
/// rate of one in a hundred. It is absent, with a reason, if the pooled answers of a condition
/// have no curve.
[[nodiscard]] std::optional<Eigen::VectorXd> start_of(const HierarchicalArrangement& all,
                                                      const HierarchicalStructure& structure,
                                                      std::string& reason);

}  // namespace jnd::analysis
