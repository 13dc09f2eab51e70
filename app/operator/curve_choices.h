#pragma once

#include <functional>
#include <string>
#include <vector>

#include "app/curves/curve_request.h"

namespace jnd::app {

/// One of the values that a word of a request may have.
struct CurveChoice {
  std::string label;  ///< "right answers among 2"
  std::string note;   ///< What more is to be known of it; "" for nothing.
  std::function<bool(const CurveRequest&)> is_chosen;
  std::function<CurveRequest(CurveRequest)> choose;
};

/// With the formula of each, as the axis of the request has it.
[[nodiscard]] std::vector<CurveChoice> family_choices(const CurveRequest& request);
[[nodiscard]] std::vector<CurveChoice> task_choices();
[[nodiscard]] std::vector<CurveChoice> lapse_choices();
/// Which 95 % intervals are told: the profile's, a bootstrap's or the posterior's.
[[nodiscard]] std::vector<CurveChoice> interval_choices();
/// By how many redraws the goodness of fit is tested.
[[nodiscard]] std::vector<CurveChoice> goodness_choices();
/// The label of the choice that the request has made; "" where it has made none of them.
[[nodiscard]] std::string chosen_label(const std::vector<CurveChoice>& choices,
                                       const CurveRequest& request);

/// "yes-no" or "mafc:M", without a guess rate beside it.
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
/// "0.5, 0.75": numbers between 0 and 1, with commas, semicolons or blanks between them.
[[nodiscard]] TypedRequest with_typed_levels(const CurveRequest& request,
                                             const std::string& typed);

}  // namespace jnd::app
