// DifferenceLadder: two differences agree, or the number has a kink, or rounding hides it.
#include "saltus/simulation/detail/difference_ladder.hpp"

#include <cmath>

namespace saltus {

namespace {

constexpr double eps = std::numeric_limits<double>::epsilon();

/// The two differences of sin(c u) differ by (c u)^2 / 2 of them, and after the extrapolation the
/// error is 0.13 of the square of that: 1e-9.
constexpr double agreement = 1e-4;
/// Numbers of roundings that a function may have in its value.
constexpr double roundings = 16.0;
/// Rounding above this part of a derivative is worth more calls. A value counts like a derivative of
/// its size, as if it changed by itself where its arguments change by 1.
constexpr double blurred_part = 1e-8;
/// The even part of a function, in its change by the shift, that x^2 has with a relative shift of
/// 1e-3. A larger one is a large curvature or a kink at the value.
constexpr double even_part = 2e-3;
/// A difference that falls by this factor from rung to rung goes to 0: v |v| at v = 0, or v^3.
constexpr double falling = 10.0;

}  // namespace

void DifferenceLadder::look(const MovedValues& at, const Centre& centre) {
  for (std::size_t n = 0; n < numbers_.size(); ++n) {
    Number& number = numbers_[n];
    if (number.settled && number.blur == 0.0) continue;
    const auto i = static_cast<Index>(n);
    const double size = std::max(std::abs(at.up[i]), std::abs(at.down[i]));
    const Rung rung{(at.up[i] - at.down[i]) / (2.0 * at.shift),
                    (at.far_up[i] - at.far_down[i]) / (4.0 * at.shift), size,
                    eps * size / at.shift};
    if (std::isfinite(rung.near) && std::isfinite(rung.wide))
      look(number, rung, smooth(at, i, rung, centre));
  }
  if (first_) forgive(at);
  first_ = false;
}

/// Whether the number has no kink at the value itself, where all central differences agree. The
/// mean of both sides is f + a |u| + b u^2: four times that of u less that of 2 u has no b.
bool DifferenceLadder::smooth(const MovedValues& at, Index i, const Rung& rung,
                              const Centre& centre) {
  const double mean = 0.5 * (at.up[i] + at.down[i]), far = 0.5 * (at.far_up[i] + at.far_down[i]);
  const double change = at.shift * std::abs(rung.near), even = std::abs(far - mean);
  const double blur = roundings * at.shift * rung.noise;
  if (even <= even_part * change + blur) return true;
  const Eigen::VectorXd* values = centre();
  if (values == nullptr) return false;
  const double kink = std::abs(4.0 * (mean - (*values)[i]) - (far - (*values)[i]));
  return kink <= 10.0 * agreement * std::max(change, even) + 4.0 * blur;
}

void DifferenceLadder::look(Number& number, const Rung& rung, bool smooth) {
  const double size = std::max(std::abs(rung.near), std::abs(rung.wide));
  const double apart = std::abs(rung.near - rung.wide);
  const bool falls = number.last > 0.0 && size > 0.0 && size * falling <= number.last;
  number.falls = falls ? number.falls + 1 : 0;
  number.last = size;
  if (!smooth) return;
  const double noise = roundings * rung.noise;
  if (apart <= agreement * size + noise) {
    const double error = size > 0.0 ? apart * (apart / size) : 0.0;
    const bool blurred = rung.noise > blurred_part * std::max(size, rung.most * direction_);
    settle(number, rung.value(), error + rung.noise, blurred ? rung.noise : 0.0);
  } else if (number.falls >= 2) {
    const bool square = std::abs(rung.wide) > 3.0 * std::abs(rung.near);
    settle(number, square ? rung.value() : 2.0 * rung.near - rung.wide, apart, 0.0);
  }
}

/// A later rung replaces a blurred derivative if it lies inside the blur.
void DifferenceLadder::settle(Number& number, double value, double error, double blur) {
  if (number.settled) {
    if (error >= number.error) return;
    if (std::abs(value - number.value) > 2.0 * roundings * number.blur) return;
  }
  number = {true, value, error, blur, number.last, number.falls};
}

/// Numbers that stay within the rounding of their largest neighbour do not depend on the direction:
/// their values are differences of large ones.
void DifferenceLadder::forgive(const MovedValues& at) {
  const double most = at.up.size() > 0 ? at.up.lpNorm<Eigen::Infinity>() : 0.0;
  for (std::size_t n = 0; n < numbers_.size(); ++n) {
    const auto i = static_cast<Index>(n);
    const auto [low, high] = std::minmax({at.up[i], at.down[i], at.far_up[i], at.far_down[i]});
    if (!std::isfinite(most + at.up[i] + at.down[i] + at.far_up[i] + at.far_down[i])) continue;
    if (!numbers_[n].settled && high - low <= roundings * eps * most)
      settle(numbers_[n], (at.far_up[i] - at.far_down[i]) / (4.0 * at.shift), high - low, 0.0);
  }
}

}  // namespace saltus
