#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "app/command_line/command.h"
#include "app/command_line/json_text.h"
#include "app/session/shipped_files.h"
#include "core/error.h"
#include "core/hand.h"
#include "core/media/fluid_force.h"
#include "core/media/medium.h"
#include "core/media/water_drag.h"
#include "experiments/protocol/force_map_file.h"

namespace jnd::app {
namespace {

// Of the drag equation: water, and the hand that moves through it.
constexpr double kDensityKgPerM3 = core::WaterDrag::Parameters{}.density_kg_per_m3;
constexpr double kHandAreaM2 = core::WaterDrag::Parameters{}.projected_area_m2;
constexpr double kWaterViscosityPaS = 0.001;
constexpr double kHandLengthM = 0.1;

struct ForceOptions {
  std::string law;
  double viscosity_pa_s = 1.0;
  double scale = 1.0;
  std::string velocity_m_per_s = "1,0,0";
  double angle_of_attack_rad = std::numbers::pi / 2.0;
  /// "" for the fit of the thesis, or for lift the shipped flat plate.
  std::string force_map;
  bool json = false;
};

using Vector = std::array<double, 3>;

struct LawForce {
  double total_n = 0.0;
  std::vector<Vector> points_n;
  std::optional<double> drag_coefficient;
  std::optional<double> reynolds_number;
};

bool is_like_water(const std::string& law) {
  return law == "water" || law == "map" || law == "lift";
}

bool is_viscous(const std::string& law) {
  return law.starts_with("viscous") || law == "ellipsoid";
}

Vector velocity_from(const std::string& text) {
  Vector velocity{};
  const char* at = text.data();
  const char* const end = text.data() + text.size();
  for (std::size_t axis = 0; axis < velocity.size(); ++axis) {
    const auto [next, error] = std::from_chars(at, end, velocity[axis]);
    const bool more = axis + 1 < velocity.size();
    const bool separated = more ? next != end && *next == ',' : next == end;
    if (error != std::errc() || !separated || !std::isfinite(velocity[axis])) {
      throw UsageError("--velocity-m-per-s: expected three numbers x,y,z, found " + text);
    }
    at = next + (more ? 1 : 0);
  }
  return velocity;
}

core::MediumAmounts medium_of(const ForceOptions& options) {
  using core::ViscousDrag;
  if (options.law == "free") return core::free_space();
  if (options.law == "water") return core::water({.scale = options.scale});
  if (is_like_water(options.law)) {
    core::MediumAmounts medium = core::mapped_water({.scale = options.scale});
    (options.law == "map" ? medium.lift_kg_per_m : medium.mapped_drag_kg_per_m) = 0.0;
    return medium;
  }
  const double viscosity_pa_s = options.viscosity_pa_s;
  if (options.law == "ellipsoid") return core::ellipsoid({.viscosity_pa_s = viscosity_pa_s});
  if (options.law == "viscous-schiller-naumann") {
    return core::viscous_inertial({.viscosity_pa_s = viscosity_pa_s});
  }
  const auto shape =
      options.law == "viscous" ? ViscousDrag::Shape::kFlatPlate : ViscousDrag::Shape::kSphere;
  return core::viscous({.viscosity_pa_s = viscosity_pa_s, .shape = shape});
}

std::optional<core::ForceMap> map_of(const ForceOptions& options) {
  if (!options.force_map.empty()) {
    return experiments::read_force_map(user_or_shipped(options.force_map, "data/force_maps"));
  }
  if (options.law != "lift") return std::nullopt;
  return experiments::read_force_map(user_or_shipped("flat_plate.csv", "data/force_maps"));
}

/// A stiff hand, deep in the medium and turned about its fingers; edge on, it moves across
/// them.
core::HapticState hand_turned(const Eigen::Vector3d& velocity_m_per_s, double angle_rad) {
  core::HapticState state;
  state.tip_velocity_m_per_s.fill(velocity_m_per_s);
  const Eigen::Vector3d ahead = velocity_m_per_s.norm() > 0.0
                                    ? velocity_m_per_s.stableNormalized()
                                    : Eigen::Vector3d::UnitX();
  const Eigen::Vector3d about =
      std::abs(ahead.y()) < 0.9 ? Eigen::Vector3d::UnitY() : Eigen::Vector3d::UnitZ();
  const Eigen::Vector3d fingers = (about - about.dot(ahead) * ahead).normalized();
  const Eigen::Vector3d normal =
      std::sin(angle_rad) * ahead + std::cos(angle_rad) * fingers.cross(ahead);
  state.tip_position_m.fill({0.0, 0.0, -1.0});
  state.tip_position_m[static_cast<int>(core::ContactPoint::kPalmOuter)] +=
      0.06 * normal.cross(fingers);
  state.tip_position_m[static_cast<int>(core::ContactPoint::kIndex)] += 0.12 * fingers;
  return state;
}

LawForce force_of(const ForceOptions& options, const Vector& velocity) {
  const double speed = std::hypot(velocity[0], velocity[1], velocity[2]);
  const double sine = std::abs(std::sin(options.angle_of_attack_rad));
  const Eigen::Vector3d velocity_m_per_s(velocity[0], velocity[1], velocity[2]);
  const core::HandMotion motion = {.velocity_m_per_s = velocity_m_per_s,
                                   .speed_m_per_s = speed,
                                   .sin_angle_of_attack = std::min(sine, 1.0)};
  const std::optional<core::ForceMap> map = map_of(options);
  const core::ForceMap* const map_used = map ? &*map : nullptr;
  const core::MediumAmounts medium = medium_of(options);
  core::PointVectors points = core::zero_vectors();
  // No share fades at low speed, because the law itself is asked for.
  core::add_up_fluid_force(medium, map_used, motion, core::kAreaShareRatio,
                           hand_turned(velocity_m_per_s, options.angle_of_attack_rad), 0b11111,
                           0.0, 1e-150, points);
  LawForce force;
  Eigen::Vector3d total = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& point : points) {
    total += point;
    // Adding zero turns -0 into 0.
    force.points_n.push_back({point.x() + 0.0, point.y() + 0.0, point.z() + 0.0});
  }
  force.total_n = total.norm();
  if (!std::isfinite(force.total_n) || !std::isfinite(sine)) {
    throw UsageError(
        "force: expected arguments that give a finite force, found one that is not");
  }
  if (speed == 0.0 || options.law == "free") return force;
  const double viscosity_pa_s =
      is_like_water(options.law) ? kWaterViscosityPaS : options.viscosity_pa_s;
  const double reynolds = kDensityKgPerM3 * speed * kHandLengthM / viscosity_pa_s;
  // Any drag can be written as a coefficient; for the flat plate in creeping flow it is 24 /
  // Re.
  const double coefficient =
      options.law == "water" || options.law == "map"
          ? core::mapped_drag_coefficient(motion, map_used)
          : -total.dot(velocity_m_per_s) /
                (0.5 * kDensityKgPerM3 * kHandAreaM2 * speed * speed * speed);
  // A fluid without viscosity has neither number, and lift has no drag.
  if (std::isfinite(reynolds) && std::isfinite(coefficient)) {
    force.reynolds_number = reynolds;
    if (options.law != "lift") force.drag_coefficient = coefficient;
  }
  return force;
}

/// Warns if the Reynolds number is so high that the law is no better than a guess. The force is
/// printed nevertheless.
void warn_of_reynolds(const ForceOptions& options, const LawForce& force) {
  if (options.law != "viscous-schiller-naumann" || !force.reynolds_number) return;
  if (*force.reynolds_number <= core::InertialDrag::kMaxReynolds) return;
  fmt::print(stderr,
             "force: expected a Reynolds number of at most {:.0f} for this law, found {:.4g}; "
             "use a slower motion or a thicker fluid\n",
             core::InertialDrag::kMaxReynolds, *force.reynolds_number);
}

nlohmann::json number_or_null(const std::optional<double>& value) {
  return value ? nlohmann::json(*value) : nlohmann::json(nullptr);
}

void print_json(const LawForce& force) {
  nlohmann::ordered_json out;
  out["total_n"] = force.total_n;
  out["points"] = nlohmann::ordered_json::array();
  for (std::size_t i = 0; i < force.points_n.size(); ++i) {
    out["points"].push_back({{"name", core::kContactPointNames[i]},
                             {"share_ratio", core::kAreaShareRatio[i]},
                             {"force_n", force.points_n[i]}});
  }
  out["drag_coefficient"] = number_or_null(force.drag_coefficient);
  out["reynolds_number"] = number_or_null(force.reynolds_number);
  fmt::print("{}\n", json_text(out));
}

void print_for_people(const ForceOptions& options, const LawForce& force) {
  const char* const where = options.law == "lift"        ? "across the motion"
                            : options.law == "ellipsoid" ? "on the hand"
                                                         : "against the motion";
  fmt::print("{}: {:.4g} N {}, before any limit\n", options.law, force.total_n, where);
  if (force.drag_coefficient) fmt::print("  C_D  {:.4g}\n", *force.drag_coefficient);
  if (force.reynolds_number) fmt::print("  Re   {:.4g}\n", *force.reynolds_number);
  fmt::print("\n  {:<12} {:>6} {:>10} {:>10} {:>10}\n", "point", "share", "x / N", "y / N",
             "z / N");
  for (std::size_t i = 0; i < force.points_n.size(); ++i) {
    const Vector& point = force.points_n[i];
    fmt::print("  {:<12} {:>6.2f} {:>10.4f} {:>10.4f} {:>10.4f}\n", core::kContactPointNames[i],
               core::kAreaShareRatio[i], point[0], point[1], point[2]);
  }
}

int run_force(const ForceOptions& options) {
  const Vector velocity = velocity_from(options.velocity_m_per_s);
  LawForce force;
  try {
    force = force_of(options, velocity);
  } catch (const core::Error& error) {
    throw UsageError(error.what());
  }
  warn_of_reynolds(options, force);
  if (options.json) {
    print_json(force);
  } else {
    print_for_people(options, force);
  }
  return kDone;
}

}  // namespace

HelpPlace place_of_force() { return {HelpGroup::kApparatus, 10}; }

void add_force(CLI::App& program, Invocation& invocation) {
  auto options = std::make_shared<ForceOptions>();
  CLI::App* command =
      program.add_subcommand("force", "The force of a law on a moving hand, before any limit");
  invocation.examples[command] = {{"jnd force water --velocity-m-per-s 1,0,0",
                                   "the force of water on a hand at 1 m/s, point by point"}};
  command
      ->add_option("law", options->law,
                   "free, water, map or lift (of a force map), viscous, viscous-stokes, "
                   "viscous-schiller-naumann or ellipsoid")
      ->required()
      ->check(CLI::IsMember({"free", "water", "map", "lift", "viscous", "viscous-stokes",
                             "viscous-schiller-naumann", "ellipsoid"}));
  CLI::Option* viscosity = command->add_option("--viscosity-pa-s", options->viscosity_pa_s,
                                               "Viscosity of a viscous fluid (default 1)");
  CLI::Option* scale = command->add_option("--scale", options->scale,
                                           "Factor on the force of water (default 1)");
  command->add_option("--velocity-m-per-s", options->velocity_m_per_s,
                      "Of the hand, moving as one: x,y,z (default 1,0,0)");
  command->add_option("--angle-of-attack-rad", options->angle_of_attack_rad,
                      "Between hand plane and motion (default pi/2, head on)");
  CLI::Option* map = command->add_option(
      "--force-map", options->force_map,
      "CSV of C_D and C_L (default: the thesis's fit; for lift the theory of a flat plate)");
  command->add_flag("--json", options->json, "Print one JSON document");
  command->callback([options, &invocation, viscosity, scale, map] {
    const std::string& law = options->law;
    if (scale->count() > 0 && !is_like_water(law)) {
      throw UsageError("--scale: expected only with water, map or lift, found with " + law);
    }
    if (viscosity->count() > 0 && !is_viscous(law)) {
      throw UsageError("--viscosity-pa-s: expected only with a viscous law, found with " + law);
    }
    if (map->count() > 0 && law != "map" && law != "lift") {
      throw UsageError("--force-map: expected only with map or lift, found with " + law);
    }
    invocation.run = [options] { return run_force(*options); };
  });
}

}  // namespace jnd::app
