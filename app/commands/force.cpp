#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <array>
#include <charconv>
#include <cmath>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "app/commands/commands.h"
#include "app/json_text.h"
#include "core/error.h"
#include "core/hand.h"
#include "core/media/medium.h"

namespace jnd::app {
namespace {

// Of the thesis's drag equation: water, and the hand that moves through it.
constexpr double kDensityKgPerM3 = 1000.0;
constexpr double kWaterViscosityPaS = 0.001;
constexpr double kHandLengthM = 0.1;
constexpr double kHandAreaM2 = 0.0148;

struct Options {
  std::string law;
  double viscosity_pa_s = 1.0;
  double scale = 1.0;
  std::string velocity_m_per_s = "1,0,0";
  double angle_of_attack_rad = std::numbers::pi / 2.0;
  bool json = false;
};

struct LawForce {
  double total_n = 0.0;
  std::optional<double> drag_coefficient;
  std::optional<double> reynolds_number;
};

using Vector = std::array<double, 3>;

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

core::MediumAmounts medium_of(const Options& options) {
  using core::ViscousDrag;
  if (options.law == "free") return core::free_space();
  if (options.law == "water") return core::water({.scale = options.scale});
  const auto shape =
      options.law == "viscous" ? ViscousDrag::Shape::kFlatPlate : ViscousDrag::Shape::kSphere;
  return core::viscous({.viscosity_pa_s = options.viscosity_pa_s, .shape = shape});
}

LawForce force_of(const Options& options, double speed_m_per_s) {
  const double sine = std::abs(std::sin(options.angle_of_attack_rad));
  LawForce force;
  force.total_n =
      medium_of(options).drag_n({.speed_m_per_s = speed_m_per_s, .sin_angle_of_attack = sine});
  if (!std::isfinite(force.total_n) || !std::isfinite(sine)) {
    throw UsageError(
        "force: expected arguments that give a finite force, found one that is not");
  }
  if (speed_m_per_s == 0.0 || options.law == "free") return force;
  const double viscosity_pa_s =
      options.law == "water" ? kWaterViscosityPaS : options.viscosity_pa_s;
  const double reynolds = kDensityKgPerM3 * speed_m_per_s * kHandLengthM / viscosity_pa_s;
  // Creeping flow written as a coefficient: 24 / Re for the flat plate.
  const double coefficient = options.law == "water"
                                 ? core::WaterDrag::drag_coefficient(sine)
                                 : force.total_n / (0.5 * kDensityKgPerM3 * kHandAreaM2 *
                                                    speed_m_per_s * speed_m_per_s);
  // A fluid without viscosity has neither.
  if (std::isfinite(reynolds) && std::isfinite(coefficient)) {
    force.reynolds_number = reynolds;
    force.drag_coefficient = coefficient;
  }
  return force;
}

nlohmann::json number_or_null(const std::optional<double>& value) {
  return value ? nlohmann::json(*value) : nlohmann::json(nullptr);
}

void print_json(const LawForce& force, const std::vector<Vector>& points) {
  nlohmann::ordered_json out;
  out["total_n"] = force.total_n;
  out["points"] = nlohmann::ordered_json::array();
  for (std::size_t i = 0; i < points.size(); ++i) {
    out["points"].push_back({{"name", core::kContactPointNames[i]},
                             {"share_ratio", core::kAreaShareRatio[i]},
                             {"force_n", points[i]}});
  }
  out["drag_coefficient"] = number_or_null(force.drag_coefficient);
  out["reynolds_number"] = number_or_null(force.reynolds_number);
  fmt::print("{}\n", json_text(out));
}

void print_for_people(const Options& options, const LawForce& force,
                      const std::vector<Vector>& points) {
  fmt::print("{}: {:.4g} N against the motion, before any limit\n", options.law, force.total_n);
  if (force.drag_coefficient) fmt::print("  C_D  {:.4g}\n", *force.drag_coefficient);
  if (force.reynolds_number) fmt::print("  Re   {:.4g}\n", *force.reynolds_number);
  fmt::print("\n  {:<12} {:>6} {:>10} {:>10} {:>10}\n", "point", "share", "x / N", "y / N",
             "z / N");
  for (std::size_t i = 0; i < points.size(); ++i) {
    fmt::print("  {:<12} {:>6.2f} {:>10.4f} {:>10.4f} {:>10.4f}\n", core::kContactPointNames[i],
               core::kAreaShareRatio[i], points[i][0], points[i][1], points[i][2]);
  }
}

int run(const Options& options) {
  const Vector velocity = velocity_from(options.velocity_m_per_s);
  const double speed = std::hypot(velocity[0], velocity[1], velocity[2]);
  LawForce force;
  try {
    force = force_of(options, speed);
  } catch (const core::Error& error) {
    throw UsageError(error.what());
  }
  std::vector<Vector> points;
  for (const double share : core::kAreaShareRatio) {
    Vector point{};
    for (std::size_t axis = 0; axis < point.size(); ++axis) {
      // The sum with zero turns -0 into 0.
      if (speed > 0.0) point[axis] = -share * force.total_n * (velocity[axis] / speed) + 0.0;
    }
    points.push_back(point);
  }
  if (options.json) {
    print_json(force, points);
  } else {
    print_for_people(options, force, points);
  }
  return kDone;
}

}  // namespace

void add_force(CLI::App& program, Invocation& invocation) {
  auto options = std::make_shared<Options>();
  CLI::App* command =
      program.add_subcommand("force", "The force of a law on a moving hand, before any limit");
  command->add_option("law", options->law, "free, water, viscous or viscous-stokes")
      ->required()
      ->check(CLI::IsMember({"free", "water", "viscous", "viscous-stokes"}));
  CLI::Option* viscosity = command->add_option("--viscosity-pa-s", options->viscosity_pa_s,
                                               "Viscosity of a viscous fluid (default 1)");
  CLI::Option* scale = command->add_option("--scale", options->scale,
                                           "Factor on the force of water (default 1)");
  command->add_option("--velocity-m-per-s", options->velocity_m_per_s,
                      "Of the hand, moving as one: x,y,z (default 1,0,0)");
  command->add_option("--angle-of-attack-rad", options->angle_of_attack_rad,
                      "Between hand plane and motion (default pi/2, head on)");
  command->add_flag("--json", options->json, "Print one JSON document");
  command->callback([options, &invocation, viscosity, scale] {
    const bool is_water = options->law == "water";
    const bool is_viscous = options->law.starts_with("viscous");
    if (scale->count() > 0 && !is_water) {
      throw UsageError("--scale: expected only with water, found with " + options->law);
    }
    if (viscosity->count() > 0 && !is_viscous) {
      throw UsageError("--viscosity-pa-s: expected only with a viscous law, found with " +
                       options->law);
    }
    invocation.run = [options] { return run(*options); };
  });
}

}  // namespace jnd::app
