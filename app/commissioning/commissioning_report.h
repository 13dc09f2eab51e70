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
  std::string words;  ///< One or two sentences.
  /// What is missing or speaks against it, in sentences.
  std::vector<std::string> lacks;
};

/// `profile` is the one that was written from the record; none if nobody wrote one or it was
/// not found. `on_day` is such as "2026-11-25".
[[nodiscard]] CommissioningVerdict verdict_of(const CommissioningRecord& record,
                                              const std::optional<KnownProfile>& profile,
                                              const std::string& on_day);

struct CommissioningReportRequest {
  std::filesystem::path record;
  std::optional<KnownProfile> profile;  ///< See `verdict_of`.
  std::string operator_name;            ///< "" leaves it to the record.
  std::string program_version;          ///< The version of the program that writes the report.
  std::string written_on;               ///< Such as "2026-11-25".
  std::filesystem::path out;            ///< A new or empty folder.
  analysis::ReportOptions tools;
};

/// Writes a report of a commissioning for a laboratory's files. It needs only the record and
/// the profile, not the device. Throws as `read_commissioning_record` and
/// `analysis::write_document` do. Not real time.
[[nodiscard]] analysis::ReportOutcome write_commissioning_report(
    const CommissioningReportRequest& request);

/// The profile of this record. If `file` is given, it is that one, which has to belong to the
/// record's device. Otherwise it is the newest profile of the device beside the record or where
/// sessions look for profiles; none if there is none. Throws as `read_known_profile` does, and
/// `core::Error` for a profile of another device.
[[nodiscard]] std::optional<KnownProfile> profile_of_record(const std::filesystem::path& record,
                                                            const std::string& file,
                                                            const std::string& on_day);

/// The files of a complete commissioning. `write_commissioning_files` writes the profile into
/// this folder, and the report beside it. It throws as `profile_of`,
/// `experiments::write_device_profile` and `write_commissioning_report` do.
struct CommissioningFiles {
  std::filesystem::path profile;
  analysis::ReportOutcome report;
};
[[nodiscard]] CommissioningFiles write_commissioning_files(
    const Commissioning& commissioning, const device::DeviceIdentity& identity,
    const std::filesystem::path& folder, const std::string& program_version,
    const std::string& today);

/// A folder for the report beside this profile that does not exist yet: NAME.report for
/// NAME.device.json, or else NAME with a number.
[[nodiscard]] std::filesystem::path report_folder_beside(const std::filesystem::path& profile);

}  // namespace jnd::app
