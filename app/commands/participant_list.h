#pragma once

#include <string>
#include <vector>

namespace jnd::app {

/// Numbers of participants as people write them, such as "6,8,13". "5..9" means 5, 6, 7, 8, 9;
/// and "6,8..40" goes on from 8 in steps like that from 6 to 8, up to 40. They are ascending,
/// each from 1 to 10000, and at most 1000. Throws `UsageError` "PLACE: expected ..., found ..."
/// for anything else.
[[nodiscard]] std::vector<int> participant_list(const std::string& text,
                                                const std::string& place);

}  // namespace jnd::app
