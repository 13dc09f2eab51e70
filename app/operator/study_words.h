#pragma once

#include <string>
#include <vector>

#include "experiments/order/counterbalance.h"
#include "experiments/study/study.h"

namespace jnd::app {

/// A name in words: "method_order" becomes "method order", or as a title "Method order".
[[nodiscard]] std::string name_words(std::string name, bool as_title = false);
/// The text in this language; "" if it has none.
[[nodiscard]] const std::string& in_language(const experiments::Text& text,
                                             const std::string& language);

/// The one of a study's languages that the window speaks. The study's first language if the
/// window speaks none of them, or speaks English, which nobody may have chosen.
[[nodiscard]] const std::string& shown_language(const std::vector<std::string>& languages);

/// The stage's title in this language, or else in another one; without a title, its name in
/// words.
[[nodiscard]] std::string title_of(const experiments::Stage& stage,
                                   const std::string& language);
/// The same for a group of blocks.
[[nodiscard]] std::string title_of(const experiments::Interleaving& group,
                                   const std::string& language);
/// The titles of a session's stages. Interleaved blocks have the title of their group, so that
/// nobody reads whose turn it is. Where levels are hidden, blocks and groups are called "Block
/// 1", "Block 2" by their place in the list, because their names could tell the level.
[[nodiscard]] std::vector<std::string> shown_titles(
    const std::vector<const experiments::Stage*>& stages, const std::string& language,
    bool hides_levels);

/// The study's title in the shown language; its name if it has none.
[[nodiscard]] std::string title_of(const experiments::Study& study);
/// The title up to its colon: "Group D" for "Group D: low viscosities".
[[nodiscard]] std::string short_title(const std::string& title);
/// The title of the block with this name, wherever it is in the study, in the study's first
/// language, as charts show it; the name itself if there is no such block.
[[nodiscard]] std::string block_title(const experiments::Study& study,
                                      const std::string& block);

/// The words for a study file's medium ("free_space") or procedure ("magnitude_estimation") in
/// the window's language: "free space", and as a title "Magnitude estimation".
[[nodiscard]] std::string medium_words(const std::string& medium);
[[nodiscard]] std::string procedure_words(const std::string& procedure);
/// Such as "water, scale 2", "free space" or "viscous, 8 Pa s".
[[nodiscard]] std::string words_of(const experiments::MediumSetting& setting);
/// Such as "1 h 5 min", "25 min" or "40 s".
[[nodiscard]] std::string duration_words(double duration_s);

/// A cell in words, such as "estimation, then production; primed"; "" for one that assigns
/// nothing.
[[nodiscard]] std::string cell_words(const experiments::Cell& cell);
/// A cell in words that use titles of blocks, if every arm of a counterbalance contains one
/// block with a title: "Group E, then Group D".
[[nodiscard]] std::string cell_words(const experiments::Study& study,
                                     const experiments::Cell& cell);

}  // namespace jnd::app
