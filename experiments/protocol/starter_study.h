#pragma once

#include <string>

namespace jnd::experiments {

/// Returns a small valid study to begin from, with a comment at everything that an author will
/// want to change. `name` must be [a-z0-9_]+.
[[nodiscard]] std::string starter_study(const std::string& name);

/// Returns the text of a valid study with another `name` and no other change. Throws
/// `ProtocolError` if the text is no valid study; `file_name` is for its messages.
[[nodiscard]] std::string renamed_study(const std::string& text, const std::string& file_name,
                                        const std::string& name);

}  // namespace jnd::experiments
