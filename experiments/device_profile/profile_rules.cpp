#include "experiments/device_profile/profile_rules.h"

#include <Eigen/Core>
#include <Eigen/LU>
#include <cmath>
#include <string>

#include "experiments/device_profile/device_profile_table.h"
#include "experiments/device_profile/profile_signature.h"
#include "experiments/protocol/study_check.h"
#include "experiments/study/parameter_table.h"

namespace jnd::experiments {
namespace {

using nlohmann::json;

/// Tolerance for the rounding of a rotation and a height.
constexpr double kRounding = 1e-6;

class ProfileRules : StudyCheck {
 public:
  ProfileRules(const LocatedJson& file, std::vector<StudyProblem>& problems)
      : StudyCheck(file, problems), root_(file.root()) {}

  void run() {
    check_rotation();
    check_surface();
    check_dates();
    check_limits();
    // Problems that a rule has found are not reported a second time.
    if (problems_.empty()) check_signature();
  }

 private:
  void check_rotation() {
    Eigen::Matrix3d rotation;
    for (int i = 0; i < 9; ++i) {
      rotation(i / 3, i % 3) =
          root_["frame"]["rotation"][static_cast<std::size_t>(i)].get<double>();
    }
    const double off =
        (rotation * rotation.transpose() - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
    if (!(off <= kRounding)) {
      report("/frame/rotation",
             "expected rows of length 1 at right angles to one another, within " +
                 plain_number(kRounding) + ", found them off by " + plain_number(off));
    } else if (!(std::abs(rotation.determinant() - 1.0) <= kRounding)) {
      report("/frame/rotation",
             "expected a rotation, of determinant 1, found a mirror, of determinant -1; is an "
             "axis of the wrong sign?");
    }
  }

  void check_surface() {
    const json& frame = root_["frame"];
    const auto found = frame.find("surface_above_origin_m");
    if (found == frame.end()) return;
    const double expected_m = 0.0 - frame["offset_m"][2].get<double>();
    if (std::abs(found->get<double>() - expected_m) <= kRounding) return;
    report("/frame/surface_above_origin_m",
           "expected the negative of the third number of `offset_m` (" +
               plain_number(expected_m) + "), for the surface is the height 0, found " +
               plain_number(found->get<double>()));
  }

  void check_dates() {
    auto before = root_["measured_on"].get<std::string>();
    std::string name = "`measured_on`";
    if (const auto until = root_["valid_until"].get<std::string>(); until < before) {
      report_date("/valid_until", name, before, until);
    }
    if (!root_.contains("checks")) return;
    const json& checks = root_["checks"];
    for (std::size_t i = 0; i < checks.size(); ++i) {
      const auto date = checks[i]["checked_on"].get<std::string>();
      if (date < before) {
        return report_date("/checks/" + std::to_string(i) + "/checked_on", name, before, date);
      }
      before = date;
      name = "that of the check before it";
    }
  }

  void report_date(const std::string& pointer, const std::string& name,
                   const std::string& before, const std::string& found) {
    report(pointer, "expected a date not before " + name + " (" + before + "), found " + found);
  }

  void check_limits() {
    for (const auto& [key, value] : root_["limits"].items()) {
      if (key == "comment") continue;
      const json& most = root_["measured_limits"][key];
      if (!value.is_array()) {
        check_limit("/limits/" + key, value.get<double>(), most.get<double>());
        continue;
      }
      for (std::size_t i = 0; i < value.size(); ++i) {
        check_limit("/limits/" + key + '/' + std::to_string(i), value[i].get<double>(),
                    most[i].get<double>());
      }
    }
  }

  void check_limit(const std::string& pointer, double found, double most) {
    if (found <= most) return;
    report(pointer, "expected at most what was found of the device (" + plain_number(most) +
                        ", see `measured_limits`), found " + plain_number(found));
  }

  /// A wrong origin is reported once, and not for all the parts whose signature it enters.
  void check_signature() {
    const json& signature = root_["signature"];
    for (const std::string& part : signed_parts()) {
      const auto found = signature.find(part);
      const std::string expected = signature_of(root_, part);
      const std::string said = found == signature.end() ? "" : found->get<std::string>();
      if (said == expected) continue;
      const bool is_origin = part == signed_parts().front();
      if (expected.empty()) {
        report("/signature/" + part, "expected `" + part +
                                         "` as it was measured, found that it was taken out; "
                                         "put it back, or measure the device again");
      } else if (said.empty()) {
        report('/' + part, "expected nothing that was not measured, found `" + part +
                               "` without a signature; take it out, or measure the device "
                               "again");
      } else {
        report(is_origin ? "/signature/origin" : '/' + part,
               "expected " +
                   (is_origin ? std::string("`device`, `measured_on`, `program_version` and "
                                            "`simulated`")
                              : '`' + part + '`') +
                   " as measured, found a change since then; take it back, or measure the "
                   "device again");
      }
      if (is_origin) return;
    }
  }

  const json& root_;
};

}  // namespace

void check_profile_rules(const LocatedJson& file, std::vector<StudyProblem>& problems) {
  ProfileRules(file, problems).run();
}

}  // namespace jnd::experiments
