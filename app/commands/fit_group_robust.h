#pragma once

#include <optional>
#include <string>

#include "analysis/hierarchical/hierarchical_fit.h"

namespace CLI {
class App;
}

namespace jnd::app {

/// The options of `jnd fit hierarchical` for answers that scatter, for people who lapse, and
/// for other priors.
struct RobustGroupOptions {
  std::string overdispersion = "none", lapses_by = "common";
  std::optional<std::string> lapse_prior;  ///< Such as "A,B".
};

void add_robust_options(CLI::App& command, RobustGroupOptions& options);

/// `lapse` is the value of --lapse. Throws `UsageError` for an invalid prior, and if an option
/// needs a free lapse rate but the rate is not free.
void apply(const RobustGroupOptions& options, const std::string& lapse,
           analysis::HierarchicalOptions& how);

/// These print for people their own lapse rates, if they have any, and whatever else was asked
/// for.
void print_own_lapses(const analysis::HierarchicalFit& fit);
void print_robust(const analysis::HierarchicalFit& fit);

}  // namespace jnd::app
