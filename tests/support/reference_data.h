#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace jnd::test_support {

/// Returns what other programs (R, SciPy, NumPy) computed: the document `file` of
/// data/reference, for example "thresholds/thresholds.json". The script that made it lies
/// beside it. The document is read at the first call and kept, so references to it and into it
/// stay valid. Throws `std::runtime_error` with the name of the file if it is missing or is not
/// JSON. Only one thread may call this.
[[nodiscard]] const nlohmann::json& reference_data(const std::string& file);

}  // namespace jnd::test_support
