#include "app/commissioning/commissioning_json.h"

#include <nlohmann/json.hpp>

#include "app/commissioning/guided_run.h"

namespace jnd::app {
namespace {

using analysis::Measured;
using nlohmann::json;
using nlohmann::ordered_json;

ordered_json measured_json(const Measured& measured) {
  return {{"value", measured.value}, {"ci95", {measured.ci95_low, measured.ci95_high}}};
}

Measured measured_in(const json& found) {
  return {.value = found.at("value").get<double>(),
          .ci95_low = found.at("ci95").at(0).get<double>(),
          .ci95_high = found.at("ci95").at(1).get<double>()};
}

ordered_json vector_json(const Eigen::Vector3d& vector) {
  return {vector.x(), vector.y(), vector.z()};
}

Eigen::Vector3d vector_in(const json& found) {
  return {found.at(0).get<double>(), found.at(1).get<double>(), found.at(2).get<double>()};
}

ordered_json json_of(const analysis::HomingFit& fit) {
  return {{"spread_m", fit.spread_m},
          {"moved_m", fit.moved_m},
          {"num_homings", fit.homed_m.size()}};
}

ordered_json json_of(const analysis::NoiseFit& fit) {
  return {{"position_sd_m", measured_json(fit.position_sd_m)},
          {"position_resolution_m", fit.position_resolution_m},
          {"velocity_sd_m_per_s", measured_json(fit.velocity_sd_m_per_s)}};
}

ordered_json json_of(const analysis::FrameFit& fit) {
  auto rotation = ordered_json::array();
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) rotation.push_back(fit.rotation(row, column));
  }
  return {{"rotation", std::move(rotation)},
          {"offset_m", vector_json(fit.offset_m)},
          {"rotation_ci95_rad", vector_json(fit.rotation_ci95_rad)},
          {"offset_ci95_m", vector_json(fit.offset_ci95_m)},
          {"residual_m", fit.residual_m},
          {"num_marks", fit.num_marks}};
}

ordered_json json_of(const analysis::DelayFit& fit) {
  return {{"delay_s", measured_json(fit.delay_s)},
          {"mass_per_gain_kg", measured_json(fit.mass_per_gain_kg)},
          {"num_ways", fit.num_ways}};
}

ordered_json json_of(const analysis::ForceFit& fit) {
  auto by_axis = ordered_json::array();
  for (const Measured& damping : fit.damping_by_axis_n_s_per_m) {
    by_axis.push_back(measured_json(damping));
  }
  return {{"gain", measured_json(fit.gain)},
          {"weight_n", measured_json(fit.weight_n)},
          {"offset_n", vector_json(fit.offset_n)},
          {"damping_n_s_per_m", measured_json(fit.damping_n_s_per_m)},
          {"damping_by_axis_n_s_per_m", std::move(by_axis)},
          {"damps_alike", fit.damps_alike},
          {"friction_n", measured_json(fit.friction_n)},
          {"hysteresis_n", measured_json(fit.hysteresis_n)},
          {"lifting_opposed_n", fit.lifting_opposed_n ? ordered_json(*fit.lifting_opposed_n)
                                                      : ordered_json(nullptr)},
          {"residual_n", fit.residual_n},
          {"pose_spread_ratio", fit.pose_spread_ratio},
          {"num_ways", fit.num_ways}};
}

ordered_json json_of(const analysis::StabilityFit& fit) {
  return {{"rate_hz", fit.rate_hz},
          {"damping_limit_n_s_per_m", measured_json(fit.damping.damping_n_s_per_m)},
          {"damping_limit_frequency_hz", fit.damping.frequency_hz},
          {"viscosity_pa_s", fit.viscosity_pa_s},
          {"viscosity_is_at_least", fit.damping.is_beyond},
          {"quiet_viscosity_pa_s", fit.quiet_viscosity_pa_s},
          {"stiffness_n_per_m", fit.stiffness_n_per_m},
          {"is_single_mass", fit.is_single_mass},
          {"num_ways", fit.damping.num_ways}};
}

analysis::StabilityFit stability_in(const json& found) {
  return {.rate_hz = found.at("rate_hz").get<double>(),
          .damping = {.damping_n_s_per_m = measured_in(found.at("damping_limit_n_s_per_m")),
                      .frequency_hz = found.at("damping_limit_frequency_hz").get<double>(),
                      .is_beyond = found.at("viscosity_is_at_least").get<bool>(),
                      .num_ways = found.at("num_ways").get<int>()},
          .viscosity_pa_s = found.at("viscosity_pa_s").get<double>(),
          .stiffness_n_per_m = found.at("stiffness_n_per_m").get<double>(),
          .is_single_mass = found.at("is_single_mass").get<bool>(),
          .quiet_viscosity_pa_s = found.at("quiet_viscosity_pa_s").get<double>()};
}

analysis::FrameFit frame_in(const json& found) {
  analysis::FrameFit fit;
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t column = 0; column < 3; ++column) {
      fit.rotation(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(column)) =
          found.at("rotation").at(3 * row + column).get<double>();
    }
  }
  fit.offset_m = vector_in(found.at("offset_m"));
  fit.rotation_ci95_rad = vector_in(found.at("rotation_ci95_rad"));
  fit.offset_ci95_m = vector_in(found.at("offset_ci95_m"));
  fit.residual_m = found.at("residual_m").get<double>();
  fit.num_marks = found.at("num_marks").get<int>();
  return fit;
}

analysis::ForceFit force_in(const json& found) {
  const auto value = [&](const char* key) { return measured_in(found.at(key)); };
  analysis::ForceFit fit;
  fit.gain = value("gain");
  fit.weight_n = value("weight_n");
  fit.offset_n = vector_in(found.at("offset_n"));
  fit.damping_n_s_per_m = value("damping_n_s_per_m");
  for (const json& damping : found.value("damping_by_axis_n_s_per_m", json::array())) {
    fit.damping_by_axis_n_s_per_m.push_back(measured_in(damping));
  }
  fit.damps_alike = found.value("damps_alike", true);
  fit.friction_n = value("friction_n");
  fit.hysteresis_n = value("hysteresis_n");
  if (const json& opposed = found.value("lifting_opposed_n", json()); opposed.is_number()) {
    fit.lifting_opposed_n = opposed.get<double>();
  }
  fit.residual_n = found.at("residual_n").get<double>();
  fit.pose_spread_ratio = found.at("pose_spread_ratio").get<double>();
  fit.num_ways = found.at("num_ways").get<int>();
  return fit;
}

ordered_json vectors_json(const std::vector<Eigen::Vector3d>& vectors) {
  auto all = ordered_json::array();
  for (const Eigen::Vector3d& vector : vectors) all.push_back(vector_json(vector));
  return all;
}

ordered_json points_of(const analysis::FrameFit& fit) {
  auto marks = ordered_json::array();
  for (const analysis::TouchedMark& mark : fit.marks) {
    marks.push_back({{"workspace_m", vector_json(mark.workspace_m)},
                     {"device_m", vector_json(mark.device_m)}});
  }
  return {{"marks", std::move(marks)}};
}

ordered_json points_of(const analysis::ForceFit& fit) {
  auto ways = ordered_json::array();
  for (const analysis::GuidedWay& way : fit.ways) {
    ways.push_back({{"direction", vector_json(way.direction)},
                    {"speed_m_per_s", way.speed_m_per_s},
                    {"acceleration_m_per_s2", way.acceleration_m_per_s2},
                    {"commanded_n", way.commanded_n},
                    {"load_n", way.load_n},
                    {"pose", way.pose},
                    {"path_ratio", way.path_ratio}});
  }
  return {{"up", vector_json(fit.up)},
          {"mass_per_gain_kg", fit.mass_per_gain_kg},
          {"ways", std::move(ways)}};
}

ordered_json points_of(const analysis::DelayFit& fit) {
  auto ways = ordered_json::array();
  for (const analysis::PushedWay& way : fit.ways) {
    ways.push_back({{"delay_s", way.delay_s}, {"mass_per_gain_kg", way.mass_per_gain_kg}});
  }
  return {{"ways", std::move(ways)}};
}

analysis::GuidedWay guided_way_in(const json& found) {
  return {.direction = vector_in(found.at("direction")),
          .speed_m_per_s = found.at("speed_m_per_s").get<double>(),
          .acceleration_m_per_s2 = found.at("acceleration_m_per_s2").get<double>(),
          .commanded_n = found.at("commanded_n").get<double>(),
          .load_n = found.at("load_n").get<double>(),
          .pose = found.at("pose").get<int>(),
          .path_ratio = found.value("path_ratio", 1.0)};
}

}  // namespace

ordered_json points_json(CommissioningStep step, const CommissioningResults& results) {
  switch (step) {
    case CommissioningStep::kHoming:
      return {{"homed_m", vectors_json(results.homing.value().homed_m)}};
    case CommissioningStep::kNoise:
      return {{"first_readings_m", vectors_json(results.noise.value().first_readings_m)}};
    case CommissioningStep::kFrame:
      return points_of(results.frame.value());
    case CommissioningStep::kForce:
      return points_of(results.force.value());
    case CommissioningStep::kDelay:
      return points_of(results.delay.value());
    case CommissioningStep::kStability:
      return ordered_json::object();
  }
  return ordered_json::object();
}

void read_points_json(CommissioningStep step, const json& points,
                      CommissioningResults& results) {
  switch (step) {
    case CommissioningStep::kHoming:
      for (const json& one : points.at("homed_m")) {
        results.homing.value().homed_m.push_back(vector_in(one));
      }
      return;
    case CommissioningStep::kNoise:
      for (const json& one : points.at("first_readings_m")) {
        results.noise.value().first_readings_m.push_back(vector_in(one));
      }
      return;
    case CommissioningStep::kFrame:
      for (const json& one : points.at("marks")) {
        results.frame.value().marks.push_back(
            {.device_m = vector_in(one.at("device_m")),
             .workspace_m = vector_in(one.at("workspace_m"))});
      }
      return;
    case CommissioningStep::kForce:
      results.force.value().up = vector_in(points.at("up"));
      results.force.value().mass_per_gain_kg = points.at("mass_per_gain_kg").get<double>();
      for (const json& one : points.at("ways")) {
        results.force.value().ways.push_back(guided_way_in(one));
      }
      return;
    case CommissioningStep::kDelay:
      for (const json& one : points.at("ways")) {
        results.delay.value().ways.push_back(
            {.delay_s = one.at("delay_s").get<double>(),
             .mass_per_gain_kg = one.at("mass_per_gain_kg").get<double>()});
      }
      return;
    case CommissioningStep::kStability:
      return;
  }
}

ordered_json conditions_json(const MeasuringPlan& plan) {
  return {{"operator_name", plan.operator_name},
          {"program_version", JND_VERSION},
          {"rate_hz", plan.rate_hz},
          {"loads_kg", plan.loads_kg},
          {"load_uncertainty_ratio", plan.load_uncertainty_ratio},
          {"seed", plan.seed},
          {"max_force_per_point_n", kCommissioningLimits.per_point_n},
          {"max_total_force_n", kCommissioningLimits.total_n},
          {"max_slew_n_per_s", kCommissioningLimits.slew_n_per_s},
          {"max_speed_m_per_s", kCommissioningLimits.max_speed_m_per_s}};
}

MeasuringConditions conditions_in(const json& conditions) {
  const auto number = [&](const char* key) { return conditions.at(key).get<double>(); };
  return {.operator_name = conditions.at("operator_name").get<std::string>(),
          .program_version = conditions.at("program_version").get<std::string>(),
          .rate_hz = number("rate_hz"),
          .loads_kg = conditions.at("loads_kg").get<std::vector<double>>(),
          .load_uncertainty_ratio = number("load_uncertainty_ratio"),
          .seed = conditions.at("seed").get<std::uint64_t>(),
          .max_force_per_point_n = number("max_force_per_point_n"),
          .max_total_force_n = number("max_total_force_n"),
          .max_slew_n_per_s = number("max_slew_n_per_s"),
          .max_speed_m_per_s = number("max_speed_m_per_s")};
}

ordered_json step_json(CommissioningStep step, const CommissioningResults& results) {
  switch (step) {
    case CommissioningStep::kHoming:
      return json_of(results.homing.value());
    case CommissioningStep::kNoise:
      return json_of(results.noise.value());
    case CommissioningStep::kFrame:
      return json_of(results.frame.value());
    case CommissioningStep::kDelay:
      return json_of(results.delay.value());
    case CommissioningStep::kForce:
      return json_of(results.force.value());
    case CommissioningStep::kStability:
      return json_of(results.stability.value());
  }
  return {};
}

void read_step_json(CommissioningStep step, const json& found, CommissioningResults& results) {
  const auto number = [&](const char* key) { return found.at(key).get<double>(); };
  const auto value = [&](const char* key) { return measured_in(found.at(key)); };
  switch (step) {
    case CommissioningStep::kHoming:
      results.homing = {.spread_m = number("spread_m"), .moved_m = number("moved_m")};
      return;
    case CommissioningStep::kNoise:
      results.noise = {.position_sd_m = value("position_sd_m"),
                       .position_resolution_m = number("position_resolution_m"),
                       .velocity_sd_m_per_s = value("velocity_sd_m_per_s")};
      return;
    case CommissioningStep::kFrame:
      results.frame = frame_in(found);
      return;
    case CommissioningStep::kDelay:
      results.delay = {.delay_s = value("delay_s"),
                       .mass_per_gain_kg = value("mass_per_gain_kg"),
                       .num_ways = found.at("num_ways").get<int>()};
      return;
    case CommissioningStep::kForce:
      results.force = force_in(found);
      return;
    case CommissioningStep::kStability:
      results.stability = stability_in(found);
      return;
  }
}

ordered_json results_json(const CommissioningResults& results) {
  auto all = ordered_json::object();
  for (const CommissioningStep step : kCommissioningSteps) {
    if (!results.has(step)) continue;
    ordered_json one = {{"measured_at", results.measured_at[static_cast<std::size_t>(step)]}};
    one.update(step_json(step, results));
    all[std::string(words_of(step).name)] = std::move(one);
  }
  return all;
}

}  // namespace jnd::app
