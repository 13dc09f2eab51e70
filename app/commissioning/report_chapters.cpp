#include "app/commissioning/report_chapters.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "analysis/report/literature.h"
#include "app/commissioning/measured_quantities.h"

namespace jnd::app {
namespace {

using analysis::HtmlTable;
using analysis::HtmlText;
using Step = CommissioningStep;

const std::optional<MeasuringConditions>& conditions_of(const CommissioningResults& results,
                                                        Step step) {
  return results.conditions[static_cast<std::size_t>(step)];
}

/// The conditions of the step with the loads, or else of any step that counts.
std::optional<MeasuringConditions> main_conditions(const CommissioningResults& results) {
  if (results.has(Step::kForce) && conditions_of(results, Step::kForce)) {
    return conditions_of(results, Step::kForce);
  }
  for (const Step step : kCommissioningSteps) {
    if (results.has(step) && conditions_of(results, step)) return conditions_of(results, step);
  }
  return std::nullopt;
}

std::string range_in_mm(const std::vector<analysis::TouchedMark>& marks, int axis) {
  double low_m = marks.front().workspace_m[axis], high_m = low_m;
  for (const analysis::TouchedMark& mark : marks) {
    low_m = std::min(low_m, mark.workspace_m[axis]);
    high_m = std::max(high_m, mark.workspace_m[axis]);
  }
  return fmt::format("{:.0f} to {:.0f}", 1e3 * low_m, 1e3 * high_m);
}

std::string loads_words(const MeasuringConditions& conditions) {
  std::string loads;
  for (const double load_kg : conditions.loads_kg) {
    loads += fmt::format("{}{:g}", loads.empty() ? "" : ", ", 1e3 * load_kg);
  }
  return fmt::format(
      "{} g, hung from the tool; standard uncertainty {:g} % of each, common to all", loads,
      100.0 * conditions.load_uncertainty_ratio);
}

std::string limits_words(double per_point_n, double total_n, double slew_n_per_s,
                         double speed_m_per_s) {
  return fmt::format(
      "at most {:g} N at a point and {:g} N in all, at most {:g} N more in a second, none "
      "above "
      "{:g} m/s",
      per_point_n, total_n, slew_n_per_s, speed_m_per_s);
}

std::string fate_words(const RecordedEntry& entry) {
  switch (entry.fate) {
    case RecordedFate::kCounts:
      return step_named(entry.step) ? "counts" : "not known to this program";
    case RecordedFate::kSuperseded:
      return "measured anew later";
    case RecordedFate::kUndone:
      return "taken back later";
    case RecordedFate::kRestsOnOld:
      return "rests on a step that was measured anew or taken back later";
    case RecordedFate::kFailed:
      return "failed";
    case RecordedFate::kTakesBack:
      return "takes back what was measured before";
  }
  return "";
}

std::string found_words(const RecordedEntry& entry) {
  if (entry.fate == RecordedFate::kFailed) return entry.why;
  if (entry.fate == RecordedFate::kCounts && step_named(entry.step)) return "as above";
  std::string words;
  for (const FoundLine& line : entry.found) {
    words += (words.empty() ? "" : "; ") + line.what + " " + line.value + " " + line.unit;
  }
  return words.empty() ? "–" : words;
}

std::string value_words(const std::optional<experiments::MeasuredValue>& measured,
                        const char* unit) {
  if (!measured) return "–";
  return fmt::format("{:.3f} ({:.3f} to {:.3f}) {}", measured->value, measured->ci95[0],
                     measured->ci95[1], unit);
}

void write_checks(HtmlText& html, const experiments::DeviceProfile& profile) {
  if (profile.checks.empty()) {
    html.paragraph_about("Daily checks", "The profile has none so far.");
    return;
  }
  HtmlTable table{.caption = "Daily checks that the profile keeps",
                  .columns = {{"Day"}, {"Outcome"}, {"Gain"}, {"Weight"}}};
  for (const experiments::DailyCheck& check : profile.checks) {
    table.rows.push_back({check.checked_on, check.passed ? "passed" : "FAILED",
                          value_words(check.gain, "N/N"), value_words(check.weight_n, "N")});
  }
  html.table(table);
}

}  // namespace

std::string moment_words(const std::string& at) {
  constexpr std::size_t kDate = 10, kMinutes = 16;
  if (at.size() < kMinutes || at[kDate] != 'T') return at;
  return at.substr(0, kDate) + " " + at.substr(kDate + 1, kMinutes - kDate - 1);
}

void write_quantities(HtmlText& html, const CommissioningResults& results) {
  HtmlTable table{
      .caption = "Every quantity that was measured, with its 95 % confidence interval",
      .columns = {{"Quantity"}, {"Estimate", true}, {"95 % interval", true}, {"Unit"}}};
  std::string dates;
  for (const Step step : kCommissioningSteps) {
    if (!results.has(step)) continue;
    for (const MeasuredQuantity& one : quantities_in(step, results)) {
      table.rows.push_back({one.what, one.estimate, one.interval, one.unit});
    }
    dates +=
        fmt::format("{}{} {}", dates.empty() ? "Measured (UTC): " : "; ", words_of(step).name,
                    moment_words(results.measured_at[static_cast<std::size_t>(step)]));
  }
  if (table.rows.empty()) {
    html.paragraph("Nothing counts as measured.");
    return;
  }
  table.notes = {dates + ".",
                 "Intervals of all that is in newtons hold what the loads leave open."};
  html.table(table);
}

void write_commissioning_methods(HtmlText& html, const CommissioningResults& results) {
  if (results.has(Step::kHoming)) {
    html.paragraph_about(
        "Homing and brakes",
        "The device is homed three times and its tool rests on the same firm place after each. "
        "Then somebody takes the support away and lets go of the tool for a moment, the device "
        "without force.");
  }
  if (results.has(Step::kNoise)) {
    html.paragraph_about(
        "Noise",
        "For two seconds the device reads its position while its tool rests on something firm. "
        "The standard deviation is over all three axes together, with its interval by chi "
        "square.");
  }
  if (results.has(Step::kFrame)) {
    html.paragraph_about(
        "Frame",
        "Somebody brings the first contact point to each mark. The rotation R and the offset t "
        "are those with the least sum of squared distances between marks and places (Kabsch "
        "1976; Arun et al. 1987):");
    html.paragraph("workspace = R · device + t", "equation");
    html.paragraph(
        "Intervals are by linearising about them and follow from how far the marks are "
        "missed.");
  }
  if (results.has(Step::kForce)) {
    html.paragraph_about(
        "Force, weight, damping and friction",
        "The device goes to and fro along three axes at four speeds, and up and down with each "
        "load at three heights. On each way, along the unit vector e, the balance of energy is "
        "divided by the length of the way:");
    html.paragraph("g u = L (n · e + a / 9.80665 m/s²) + m a + b v + F p − c · e", "equation");
    html.paragraph(
        "Here u is the work of the commanded force a metre, L the load, n the unit vector "
        "upwards, m the mass, v and a the means of speed and acceleration over the way, p all "
        "that it went over how far it came. Each way is smooth and counts from rest to rest. "
        "Estimated by least squares are the gain g, the own damping b, the dry friction F and "
        "the constant force c, whose part downwards is the weight that is not carried. The "
        "known loads, lifted and lowered at one slow speed, tell the gain and the weight; the "
        "ways without loads tell damping and friction, along x alone where the axes differ "
        "(F test, 0.1 %); the gain turns everything into newtons. Where the "
        "ways begin is drawn, so that cogging adds to the scatter and not to a value. "
        "Intervals "
        "are by Student's t and the delta method, with the uncertainty of the loads added.");
  }
  if (results.has(Step::kDelay)) {
    html.paragraph_about(
        "Delay and mass",
        "The device is pushed to and fro 33 times a second along the first axis of its own "
        "while "
        "it moves on, so that dry friction keeps its sign. At that frequency ω position over "
        "force is compared with that of a mass with damping behind a delay T and a force that "
        "stands for a tick (Jury 1964), in newtons commanded:");
    html.paragraph("x / u = H(ω) exp(−i ω T),  H that of g / (m s² + b s) behind the hold",
                   "equation");
    html.paragraph(
        "Intervals are by leaving out one way after the other, the jackknife (Efron and Stein "
        "1981).");
  }
  if (results.has(Step::kStability)) {
    html.paragraph_about(
        "Stability in fluids",
        "While the device moves on, a sine that rises through all frequencies up to half the "
        "rate of the loop acts at one contact point along one axis, then at the next. From the "
        "mean over whole sweeps follows the response G(ω) of each point's velocity to each "
        "point's force. With a fluid of damping c, and the points' shares S of it, the loop "
        "begins to swing at the smallest c for which");
    html.paragraph("an eigenvalue of G(ω) S is the real number −1 / c", "equation");
    html.paragraph(
        "(the generalised Nyquist criterion, MacFarlane and Postlethwaite 1977), so nothing "
        "has "
        "to become unstable to find it out. It was done about three places; one that is worse "
        "than all together by more than its noise counts. The limit is the lower end of the "
        "95 % interval (jackknife), less 3 %. Then the device was drawn and knocked in that "
        "fluid, with the guards of a session, and in thinner ones until no guard ended the "
        "force, for noise of velocities is noise of the force.");
    html.paragraph_about(
        "Stability on solids",
        results.stability->is_single_mass
            ? "Mass, damping and delay at the unfavourable ends of their intervals tell the "
              "stiffness at which the swings of a spring grow (about damping / (delay + half a "
              "tick), Gil et al. 2004); less 3 %. Dry friction and passivity control count for "
              "nothing. On a solid of that stiffness the device was let fall and shaken, and "
              "the force did not swing ever further."
            : "The device is no single mass. It was let fall by 5 N onto solids of rising "
              "stiffness and was shaken there; the limit is the hardest on which the force did "
              "not swing ever further, less 10 %.");
  }
}

void write_conditions(HtmlText& html, const CommissioningResults& results,
                      const std::optional<KnownProfile>& profile) {
  HtmlTable table{.caption = "Under what it was measured, and what sessions may ask for",
                  .columns = {{"What"}, {"How"}}};
  const std::optional<MeasuringConditions> conditions = main_conditions(results);
  if (conditions) {
    if (results.has(Step::kForce)) table.rows.push_back({"Loads", loads_words(*conditions)});
    table.rows.push_back(
        {"Force while it was measured",
         limits_words(conditions->max_force_per_point_n, conditions->max_total_force_n,
                      conditions->max_slew_n_per_s, conditions->max_speed_m_per_s) +
             "; nobody's hand in it"});
    table.rows.push_back({"Haptic loop", fmt::format("{:g} ticks a second; seed {} of where "
                                                     "ways begin; jnd {}",
                                                     conditions->rate_hz, conditions->seed,
                                                     conditions->program_version)});
  }
  if (results.has(Step::kFrame) && !results.frame->marks.empty()) {
    const auto& marks = results.frame->marks;
    table.rows.push_back({"Marks", fmt::format("{}: x {}, y {}, z {} mm of the workspace",
                                               marks.size(), range_in_mm(marks, 0),
                                               range_in_mm(marks, 1), range_in_mm(marks, 2))});
  }
  if (profile) {
    const experiments::ProfileLimits& limits = profile->profile.limits;
    table.rows.push_back({"Force in sessions, by the profile",
                          limits_words(limits.max_force_per_point_n, limits.max_total_force_n,
                                       limits.max_slew_n_per_s, limits.max_speed_m_per_s)});
    table.rows.push_back(
        {"Space of sessions, by the profile",
         fmt::format("{:.0f}, {:.0f} and {:.0f} mm to either side of the origin along x, y, z",
                     1e3 * limits.workspace_half_width_m[0],
                     1e3 * limits.workspace_half_width_m[1],
                     1e3 * limits.workspace_half_width_m[2])});
  }
  if (!conditions) {
    html.paragraph(
        "The program that made this record did not keep loads and limits of the force in it.");
  }
  html.table(table);
}

void write_history(HtmlText& html, const CommissioningRecord& record,
                   const std::optional<KnownProfile>& profile) {
  HtmlTable table{
      .caption =
          "Every line of the record, the oldest first; nothing is ever "
          "removed from it",
      .columns = {{"When (UTC)"}, {"Step"}, {"What became of it"}, {"What was found"}, {"By"}}};
  for (const RecordedEntry& entry : record.entries) {
    table.rows.push_back({moment_words(entry.at), entry.step, fate_words(entry),
                          found_words(entry),
                          entry.operator_name.empty() ? "–" : entry.operator_name});
  }
  if (table.rows.empty()) html.paragraph("The record has no measurement so far.");
  html.table(table);
  if (profile) write_checks(html, profile->profile);
}

void write_commissioning_references(HtmlText& html, const CommissioningResults& results) {
  std::set<std::string> citations;
  if (results.has(Step::kFrame)) citations.insert({"Kabsch 1976", "Arun et al. 1987"});
  if (results.has(Step::kDelay)) citations.insert({"Jury 1964", "Efron and Stein 1981"});
  if (results.has(Step::kStability)) {
    citations.insert({"MacFarlane and Postlethwaite 1977", "Gil et al. 2004"});
  }
  if (citations.empty()) return;
  html.heading(2, "References");
  html.list(analysis::literature_of(citations));
}

}  // namespace jnd::app
