#include "analysis/hierarchical/hierarchical_words.h"

#include <algorithm>
#include <cstdio>

namespace jnd::analysis {
namespace {

/// The name of what differs between people beside the slope.
std::string own_place(const std::vector<bool>& has_orders_in, const std::string& pse) {
  const auto num_with_orders = std::count(has_orders_in.begin(), has_orders_in.end(), true);
  if (num_with_orders == 0) return pse;
  const auto num_conditions = static_cast<std::ptrdiff_t>(has_orders_in.size());
  return num_with_orders == num_conditions || pse.empty() ? "bias for an interval"
                                                          : pse + " or bias for an interval";
}

std::string guess_words(const HierarchicalOptions& options) {
  if (options.guess_rate == 0.0) return "";
  char text[48];
  std::snprintf(text, sizeof text, ", guess rate %.3g", options.guess_rate);
  return text;
}

std::string lapse_words(const HierarchicalOptions& options) {
  if (options.lapses == HierarchicalLapses::kCommon) return ", one lapse rate for everybody";
  if (options.lapses == HierarchicalLapses::kPersonal) {
    return ", a lapse rate of each person's own";
  }
  if (options.lapses == HierarchicalLapses::kNone || options.lapse_rate == 0.0) return "";
  char text[48];
  std::snprintf(text, sizeof text, ", lapse rate %.3g", options.lapse_rate);
  return text;
}

std::string pse_words(HierarchicalPse pse, const std::vector<bool>& has_orders_in) {
  const bool has_orders = !own_place(has_orders_in, "").empty();
  switch (pse) {
    case HierarchicalPse::kReference:
      return has_orders ? "pse = reference, personal " + own_place(has_orders_in, "") +
                              " in each condition"
                        : "pse = reference";
    case HierarchicalPse::kCommon:
      return has_orders ? "pse and order of the intervals free, common" : "pse free, common";
    case HierarchicalPse::kShared:
      return "pse free, one " + own_place(has_orders_in, "shift") + " a person";
    case HierarchicalPse::kPersonal:
      break;
  }
  return has_orders
             ? "pse free, personal " + own_place(has_orders_in, "pse") + " in each condition"
             : "pse free, personal in each condition";
}

}  // namespace

std::string method_words(const HierarchicalOptions& options,
                         const std::vector<bool>& has_orders_in, int num_nodes) {
  return std::string(options.link == HierarchicalLink::kLogSlope
                         ? "probit, ln slope normal between people, "
                         : "probit, slope normal between people, ") +
         pse_words(options.pse, has_orders_in) + guess_words(options) + lapse_words(options) +
         (options.beta_binomial ? ", beta-binomial answers" : "") +
         (num_nodes == 1 ? ", Laplace"
                         : ", adaptive Gauss-Hermite, " + std::to_string(num_nodes) +
                               " nodes a dimension");
}

}  // namespace jnd::analysis
