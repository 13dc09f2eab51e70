#pragma once

#include <functional>
#include <string>
#include <vector>

#include "app/curves/curve_request.h"

namespace jnd::app {

/// One of the possible values of a word in a request.
struct CurveChoice {
  std::string label;  ///< The label, such as "right answers among 2".
  std::string note;   ///< What else one should know about it; "" for nothing.
  std::function<bool(const CurveRequest&)> is_chosen;
  std::function<CurveRequest(CurveRequest)> choose;
};

/// The families of curves, each with its formula for the request's axis.
[[nodiscard]] std::vector<CurveChoice> family_choices(const CurveRequest& request);
[[nodiscard]] std::vector<CurveChoice> task_choices();
[[nodiscard]] std::vector<CurveChoice> lapse_choices();
/// The kinds of 95 % intervals: of the profile, of a bootstrap, or of the posterior.
[[nodiscard]] std::vector<CurveChoice> interval_choices();
/// The numbers of redraws by which the goodness of fit is tested.
[[nodiscard]] std::vector<CurveChoice> goodness_choices();
/// The label of the choice that the request has made; "" if it made none of them.
[[nodiscard]] std::string chosen_label(const std::vector<CurveChoice>& choices,
                                       const CurveRequest& request);

/// The request with the task "yes-no" or "mafc:M", and without a guess rate of its own.
[[nodiscard]] CurveRequest with_task(CurveRequest request, const std::string& task);

/// A request with what somebody typed, or why that cannot be.
struct TypedRequest {
  CurveRequest request;
  std::string problem;
};
[[nodiscard]] TypedRequest with_typed_guess(const CurveRequest& request,
                                            const std::string& typed);
[[nodiscard]] TypedRequest with_typed_lapse(const CurveRequest& request,
                                            const std::string& typed);
/// Takes numbers between 0 and 1, separated by commas, semicolons or blanks: "0.5, 0.75".
[[nodiscard]] TypedRequest with_typed_levels(const CurveRequest& request,
                                             const std::string& typed);

}  // namespace jnd::app
