#pragma once

#include <optional>
#include <string>

#include "analysis/hierarchical/hierarchical_fit.h"

namespace CLI {
class App;
}

namespace jnd::app {

/// What `jnd fit hierarchical` has for answers that scatter, people who lapse, and other
/// priors.
struct RobustGroupOptions {
  std::string overdispersion = "none", lapses_by = "common";
  std::optional<std::string> lapse_prior;  ///< "A,B"
};

void add_robust_options(CLI::App& command, RobustGroupOptions& options);

/// `lapse`: as told by --lapse. Throws `UsageError` for a prior that is none, and for what
/// needs a lapse rate that is free beside one that is not.
void apply(const RobustGroupOptions& options, const std::string& lapse,
           analysis::HierarchicalOptions& how);

/// For people: own lapse rates where people have them, and what else was asked for.
void print_own_lapses(const analysis::HierarchicalFit& fit);
void print_robust(const analysis::HierarchicalFit& fit);

}  // namespace jnd::app
