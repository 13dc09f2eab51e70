#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace jnd::analysis {

/// Prints an HTML file as a PDF with chromium or wkhtmltopdf, and sets its dates to this time.
/// Returns why there is none, or "". Throws `Error` if something cannot be written.
/// Not real time.
[[nodiscard]] std::string print_as_pdf(const std::filesystem::path& browser,
                                       const std::filesystem::path& html,
                                       const std::filesystem::path& pdf, std::int64_t time_ns);

}  // namespace jnd::analysis
