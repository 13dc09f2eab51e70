#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "analysis/report/report_document.h"
#include "app/commissioning/commissioning.h"
#include "app/commissioning/commissioning_record.h"
#include "app/profile/known_profile.h"

namespace jnd::app {

/// Whether sessions may rest on what was measured.
struct CommissioningVerdict {
  bool is_fit = false;
  std::string words;               ///< A sentence or two.
  std::vector<std::string> lacks;  ///< What is missing or stands against it, sentences.
};

/// `profile`: that was written of the record; none: nobody wrote one, or it was not found.
/// `on_day`: "2026-11-25".
[[nodiscard]] CommissioningVerdict verdict_of(const CommissioningRecord& record,
                                              const std::optional<KnownProfile>& profile,
                                              const std::string& on_day);

struct CommissioningReportRequest {
  std::filesystem::path record;
  std::optional<KnownProfile> profile;  ///< See `verdict_of`.
  std::string operator_name;            ///< "": as the record says.
  std::string program_version;          ///< Of who writes it.
  std::string written_on;               ///< "2026-11-25".
  std::filesystem::path out;            ///< New or empty.
  analysis::ReportOptions tools;
};

/// A report of a commissioning, for the files of a laboratory: from the record and the profile
/// alone, without the device. Throws as `read_commissioning_record` and
/// `analysis::write_document`. Not real time.
[[nodiscard]] analysis::ReportOutcome write_commissioning_report(
    const CommissioningReportRequest& request);

/// The profile of this record: `file` where one is given, which has to be of its device, else
/// the newest of its device beside it or where sessions look for profiles; none: there is none.
/// Throws as `read_known_profile`, and `core::Error` for one of another device.
[[nodiscard]] std::optional<KnownProfile> profile_of_record(const std::filesystem::path& record,
                                                            const std::string& file,
                                                            const std::string& on_day);

/// What a complete commissioning leaves: the profile in this folder, the report beside it.
/// Throws as `profile_of`, `experiments::write_device_profile` and
/// `write_commissioning_report`.
struct CommissioningFiles {
  std::filesystem::path profile;
  analysis::ReportOutcome report;
};
[[nodiscard]] CommissioningFiles write_commissioning_files(
    const Commissioning& commissioning, const device::DeviceIdentity& identity,
    const std::filesystem::path& folder, const std::string& program_version,
    const std::string& today);

/// A folder for the report beside this profile that is not there yet: NAME.report for
/// NAME.device.json, else with a number.
[[nodiscard]] std::filesystem::path report_folder_beside(const std::filesystem::path& profile);

}  // namespace jnd::app
