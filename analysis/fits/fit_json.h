#pragma once

#include <nlohmann/json_fwd.hpp>

#include "analysis/fits/power_fit.h"
#include "analysis/fits/psychometric_fit.h"
#include "analysis/fits/shifted_power_fit.h"
#include "analysis/statistics/comparison.h"
#include "analysis/statistics/equivalence_test.h"
#include "analysis/statistics/omnibus_test.h"
#include "analysis/statistics/pairwise_tests.h"

namespace jnd::analysis {

/// Results as JSON objects with the keys that the command line promises. Every number is
/// finite. Absent values and open ends of intervals are null.
[[nodiscard]] nlohmann::ordered_json to_json(const PsychometricFit& fit);
[[nodiscard]] nlohmann::ordered_json to_json(const PowerFit& fit);
[[nodiscard]] nlohmann::ordered_json to_json(const ShiftedPowerFit& fit);
[[nodiscard]] nlohmann::ordered_json to_json(const Comparison& comparison);
[[nodiscard]] nlohmann::ordered_json to_json(const EquivalenceTest& test);
[[nodiscard]] nlohmann::ordered_json to_json(const OmnibusTest& test);
[[nodiscard]] nlohmann::ordered_json to_json(const std::vector<PairwiseTest>& tests);

}  // namespace jnd::analysis
