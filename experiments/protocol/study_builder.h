#pragma once

#include <string>

#include "experiments/protocol/located_json.h"
#include "experiments/study/study.h"

namespace jnd::experiments {

/// Returns the `Study` of a file in which no problem was found. Absent optional keys get the
/// default of their parameter table. Throws nlohmann's exceptions if the file was not checked.
/// Not real time.
[[nodiscard]] Study build_study(const LocatedJson& file, std::string text);

}  // namespace jnd::experiments
