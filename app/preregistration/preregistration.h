#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "core/storage/study_store.h"
#include "experiments/study/study.h"

namespace jnd::app {

/// What is planned in addition to the study file.
struct PlannedConduct {
  int num_participants = 0;  ///< The number of complete sessions, >= 1.
  std::string rationale;     ///< Why so many; may be empty.
  /// Which data will be left out; empty for none.
  std::string exclusions;
  /// When the study ends; if empty, it ends with the last participant.
  std::string stopping;
  std::string device;  ///< The device on which it runs; empty if nobody said it.
};

/// A document that says what was planned, so that others can compare the study with it.
///
/// Keys: format, study, study_file, study_sha256, program_version, registered_on,
/// registered_time_ns, title, authors, description, num_participants, sample_rationale,
/// exclusions, stopping, device, factors, contrasts, sequential (if looks are planned),
/// counterbalances, blocks, stages, power.
using Preregistration = nlohmann::ordered_json;

/// The preregistration of a study as its file defines it. `power` is the document of `jnd
/// power`, or null.
[[nodiscard]] Preregistration preregistration_of(const experiments::Study& study,
                                                 const std::string& study_file,
                                                 const PlannedConduct& conduct,
                                                 const nlohmann::ordered_json& power,
                                                 std::int64_t time_ns);

/// What the study varies, compares and asks, block by block. A preregistration and a study that
/// was run are compared by this.
[[nodiscard]] nlohmann::ordered_json planned_design(const experiments::Study& study);

/// The plan as Markdown, with the fields of the template of the Open Science Framework.
[[nodiscard]] std::string preregistration_markdown(const Preregistration& plan);
/// The plan as an HTML page.
[[nodiscard]] std::string preregistration_html(const Preregistration& plan);

/// The name of the stored preregistration among a study folder's study files.
inline constexpr char kPreregistrationFile[] = "preregistration.json";

/// Stores the preregistration in a study folder. Throws `Error` if one is stored already, or if
/// sessions have begun: what is registered afterwards is no plan.
void keep_preregistration(core::StudyStore& store, const std::string& text);

/// The text that a study folder stores; none if nothing was registered.
[[nodiscard]] std::optional<std::string> kept_preregistration(const core::StudyStore& store);

}  // namespace jnd::app
