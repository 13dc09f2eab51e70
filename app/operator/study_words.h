#pragma once

#include <string>
#include <vector>

#include "experiments/order/counterbalance.h"
#include "experiments/study/study.h"

namespace jnd::app {

/// "method_order" as it is read: "method order", or "Method order" as a title.
[[nodiscard]] std::string name_words(std::string name, bool as_title = false);
/// "" if the text is not in this language.
[[nodiscard]] const std::string& in_language(const experiments::Text& text,
                                             const std::string& language);

/// Of these languages of a study, the one that the window speaks; the first where it speaks
/// none of them, or English, which nobody may have chosen.
[[nodiscard]] const std::string& shown_language(const std::vector<std::string>& languages);

/// As the study has it, in this language or another; in words of its name where it has none.
[[nodiscard]] std::string title_of(const experiments::Stage& stage,
                                   const std::string& language);
/// The same of a group of blocks.
[[nodiscard]] std::string title_of(const experiments::Interleaving& group,
                                   const std::string& language);
/// The titles of a session's stages. Blocks that are interleaved have that of their group, so
/// that nobody reads whose turn it is. Where levels are hidden, a block or a group is "Block
/// 1", "Block 2" by its place in the list, since its name could tell the level.
[[nodiscard]] std::vector<std::string> shown_titles(
    const std::vector<const experiments::Stage*>& stages, const std::string& language,
    bool hides_levels);

/// In the language that is shown; its name where it has none.
[[nodiscard]] std::string title_of(const experiments::Study& study);
/// Up to its colon: "Group D" of "Group D: low viscosities".
[[nodiscard]] std::string short_title(const std::string& title);
/// Of the block of this name, wherever it stands in the study, in its first language, as charts
/// have it; the name itself if nowhere.
[[nodiscard]] std::string block_title(const experiments::Study& study,
                                      const std::string& block);

/// What a study file calls a medium ("free_space") or a procedure ("magnitude_estimation"), in
/// the window's language: "free space", and "Magnitude estimation" as a title.
[[nodiscard]] std::string medium_words(const std::string& medium);
[[nodiscard]] std::string procedure_words(const std::string& procedure);
/// "water, scale 2", "free space", "viscous, 8 Pa s".
[[nodiscard]] std::string words_of(const experiments::MediumSetting& setting);
/// "1 h 5 min", "25 min", "40 s".
[[nodiscard]] std::string duration_words(double duration_s);

/// "estimation, then production; primed" of a cell; "" for one that assigns nothing.
[[nodiscard]] std::string cell_words(const experiments::Cell& cell);
/// The same by the titles of blocks, where every arm of a counterbalance holds one block that
/// has a title: "Group E, then Group D".
[[nodiscard]] std::string cell_words(const experiments::Study& study,
                                     const experiments::Cell& cell);

}  // namespace jnd::app
