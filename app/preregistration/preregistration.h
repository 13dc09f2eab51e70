#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "core/storage/study_store.h"
#include "experiments/study/study.h"

namespace jnd::app {

/// What is planned beside what the study file says.
struct PlannedConduct {
  int num_participants = 0;  ///< Complete sessions, >= 1.
  std::string rationale;     ///< Why so many; may be empty.
  std::string exclusions;    ///< What data will be left out; may be empty: none.
  std::string stopping;      ///< When the study ends; may be empty: with the last of them.
  std::string device;        ///< On which it runs; may be empty: not said.
};

/// A document that says what was planned, for others to hold the study against.
///
/// Keys: format, study, study_file, study_sha256, program_version, registered_on,
/// registered_time_ns, title, authors, description, num_participants, sample_rationale,
/// exclusions, stopping, device, factors, contrasts, sequential (where looks are planned),
/// counterbalances, blocks, stages, power.
using Preregistration = nlohmann::ordered_json;

/// Of a study as its file has it. `power`: the document of `jnd power`, or null.
[[nodiscard]] Preregistration preregistration_of(const experiments::Study& study,
                                                 const std::string& study_file,
                                                 const PlannedConduct& conduct,
                                                 const nlohmann::ordered_json& power,
                                                 std::int64_t time_ns);

/// What the study varies, compares and asks, block by block: what a preregistration and a
/// study that was run are compared in.
[[nodiscard]] nlohmann::ordered_json planned_design(const experiments::Study& study);

/// As Markdown, with the fields of the template of the Open Science Framework.
[[nodiscard]] std::string preregistration_markdown(const Preregistration& plan);
/// As a page of its own.
[[nodiscard]] std::string preregistration_html(const Preregistration& plan);

/// Name under which a study folder keeps it, among its study files.
inline constexpr char kPreregistrationFile[] = "preregistration.json";

/// Keeps it in a study folder. Throws `Error` where one is kept already, or where sessions were
/// begun: what is registered afterwards is no plan.
void keep_preregistration(core::StudyStore& store, const std::string& text);

/// The text that a study folder keeps; none where nothing was registered.
[[nodiscard]] std::optional<std::string> kept_preregistration(const core::StudyStore& store);

}  // namespace jnd::app
