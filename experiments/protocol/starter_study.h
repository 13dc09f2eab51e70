#pragma once

#include <string>

namespace jnd::experiments {

/// A small sound study to begin from, with a comment at everything an author will want to
/// change. `name` must be [a-z0-9_]+.
[[nodiscard]] std::string starter_study(const std::string& name);

/// The text of a sound study with another `name` and nothing else changed. Throws
/// `ProtocolError` if the text is not a sound study; `file_name` is for its messages.
[[nodiscard]] std::string renamed_study(const std::string& text, const std::string& file_name,
                                        const std::string& name);

}  // namespace jnd::experiments
