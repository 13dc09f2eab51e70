#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace jnd::test_support {

/// What other programs (R, SciPy, NumPy) computed: the document `file` of data/reference, such
/// as "thresholds/thresholds.json". The script that made it lies beside it. The document is
/// read when it is first asked for and kept, so that a reference to it or into it holds to the
/// end. Throws a `std::runtime_error` that names the file if it is not there or is not JSON.
/// For one thread.
[[nodiscard]] const nlohmann::json& reference_data(const std::string& file);

}  // namespace jnd::test_support
