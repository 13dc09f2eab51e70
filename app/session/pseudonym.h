#pragma once

#include <set>
#include <string>
#include <vector>

#include "core/storage/study_store.h"

namespace jnd::app {

/// A participant's name in a study; it stands in tables, file names and messages.
///
/// What one is, in words: "at most 64 letters, digits, _, - and .".
[[nodiscard]] std::string pseudonym_words();
/// Whether this is one; "" is none.
[[nodiscard]] bool is_pseudonym(const std::string& text);

/// The first of those taken that a slip of the finger may have made of the same person: it
/// differs in case, in signs or in zeros before a number alone, as P01, p01, P-1 and P001 do;
/// "" if none does. The very same name is not among them.
[[nodiscard]] std::string lookalike(const std::string& participant,
                                    const std::vector<std::string>& taken);

/// "P01", "P02", ...: the next free pseudonyms of a study.
[[nodiscard]] std::vector<std::string> next_participants(const core::StudyStore& store,
                                                         int count);
/// The same where these pseudonyms are taken.
[[nodiscard]] std::vector<std::string> next_participants(const std::set<std::string>& taken,
                                                         int count);

}  // namespace jnd::app
