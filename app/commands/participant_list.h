#pragma once

#include <string>
#include <vector>

namespace jnd::app {

/// Numbers of participants as people write them: "6,8,13"; "5..9" is 5, 6, 7, 8, 9; and
/// "6,8..40" goes on from 8 as from 6 to 8, up to 40. Ascending, each 1 to 10000, at most 1000
/// of them. Throws `UsageError` "PLACE: expected ..., found ..." for anything else.
[[nodiscard]] std::vector<int> participant_list(const std::string& text,
                                                const std::string& place);

}  // namespace jnd::app
