#pragma once

#include <set>
#include <string>
#include <vector>

#include "core/storage/study_store.h"

namespace jnd::app {

/// A pseudonym is a participant's name in a study; it appears in tables, file names and
/// messages.
///
/// This says in words what a pseudonym is: "at most 64 letters, digits, _, - and .".
[[nodiscard]] std::string pseudonym_words();
/// Whether the text is a pseudonym; "" is none.
[[nodiscard]] bool is_pseudonym(const std::string& text);

/// The first pseudonym in `taken` that may mean the same person after a typing mistake: it
/// differs only in capital letters, in signs, or in zeros before a number, as P01, p01, P-1 and
/// P001 do. "" if there is none. An identical pseudonym does not count.
[[nodiscard]] std::string lookalike(const std::string& participant,
                                    const std::vector<std::string>& taken);

/// The next free pseudonyms of a study: "P01", "P02", ...
[[nodiscard]] std::vector<std::string> next_participants(const core::StudyStore& store,
                                                         int count);
/// The next free pseudonyms if these are taken.
[[nodiscard]] std::vector<std::string> next_participants(const std::set<std::string>& taken,
                                                         int count);

}  // namespace jnd::app
