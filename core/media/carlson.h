#pragma once

namespace jnd::core {

/// Carlson's symmetric elliptic integrals (Carlson 1979), computed by his duplication theorem
/// to full precision:
///
///   R_F(x, y, z) = 1/2 int_0^inf dt / sqrt((t + x)(t + y)(t + z))
///   R_D(x, y, z) = 3/2 int_0^inf dt / (sqrt((t + x)(t + y)(t + z)) (t + z))
///
/// Both are symmetric in x and y. The caller must pass finite arguments > 0; others give NaN.
/// Not real time.
[[nodiscard]] double carlson_rf(double x, double y, double z) noexcept;
[[nodiscard]] double carlson_rd(double x, double y, double z) noexcept;

}  // namespace jnd::core
