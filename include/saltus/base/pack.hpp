// Pack: several numbers in one value, with the operations of a number.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include <Eigen/Core>

namespace saltus {

/// Applies each operation to every number of the pack, with the same bits as one by one; the
/// processor does several at once if it can. A comparison gives 0 or 1 for each number.
/// tape::Symbol has the same operations. An Eigen::Array does not take its place: only its roots
/// are faster (bench/packs), its exp, log, sin and cos have other bits, and an `auto` in a user's
/// formula would be an expression that refers to temporaries.
class Pack {
 public:
  static constexpr int size = 8;

  Pack(double value) { values_.fill(value); }  // NOLINT(google-explicit-constructor): a number
  /// The `size` numbers from `first` on.
  explicit Pack(const double* first) { std::copy_n(first, size, values_.begin()); }
  void store(double* first) const { std::ranges::copy(values_, first); }

  template <class F>
  static Pack each(F f, const Pack& a) {
    return filled([&](std::size_t i) { return f(a.values_[i]); });
  }
  template <class F>
  static Pack each(F f, const Pack& a, const Pack& b) {
    return filled([&](std::size_t i) { return f(a.values_[i], b.values_[i]); });
  }
  static Pack choose(const Pack& truth, const Pack& a, const Pack& b) {
    return filled(
        [&](std::size_t i) { return truth.values_[i] != 0.0 ? a.values_[i] : b.values_[i]; });
  }

  friend Pack operator+(const Pack& a, const Pack& b) { return each(std::plus<>(), a, b); }
  friend Pack operator-(const Pack& a, const Pack& b) { return each(std::minus<>(), a, b); }
  friend Pack operator*(const Pack& a, const Pack& b) { return each(std::multiplies<>(), a, b); }
  friend Pack operator/(const Pack& a, const Pack& b) { return each(std::divides<>(), a, b); }
  friend Pack operator-(const Pack& a) { return each(std::negate<>(), a); }
  Pack& operator+=(const Pack& b) { return *this = *this + b; }
  Pack& operator-=(const Pack& b) { return *this = *this - b; }
  Pack& operator*=(const Pack& b) { return *this = *this * b; }
  Pack& operator/=(const Pack& b) { return *this = *this / b; }

  friend Pack operator<(const Pack& a, const Pack& b) { return each(std::less<>(), a, b); }
  friend Pack operator<=(const Pack& a, const Pack& b) { return each(std::less_equal<>(), a, b); }
  friend Pack operator>(const Pack& a, const Pack& b) { return each(std::greater<>(), a, b); }
  friend Pack operator>=(const Pack& a, const Pack& b) {
    return each(std::greater_equal<>(), a, b);
  }
  friend Pack operator==(const Pack& a, const Pack& b) { return each(std::equal_to<>(), a, b); }
  friend Pack operator!=(const Pack& a, const Pack& b) { return each(std::not_equal_to<>(), a, b); }

  friend Pack abs(const Pack& a) {
    return each([](double value) { return std::fabs(value); }, a);
  }
  /// Eigen's: std::sqrt sets errno, so a compiler does not use the processor's pairs of roots.
  friend Pack sqrt(const Pack& a) {
    using Values = Eigen::Array<double, size, 1>;
    Pack result;
    Eigen::Map<Values>(result.values_.data()) = Eigen::Map<const Values>(a.values_.data()).sqrt();
    return result;
  }
  friend Pack cbrt(const Pack& a) { return each(static_cast<F1*>(std::cbrt), a); }
  friend Pack exp(const Pack& a) { return each(static_cast<F1*>(std::exp), a); }
  friend Pack expm1(const Pack& a) { return each(static_cast<F1*>(std::expm1), a); }
  friend Pack log(const Pack& a) { return each(static_cast<F1*>(std::log), a); }
  friend Pack log10(const Pack& a) { return each(static_cast<F1*>(std::log10), a); }
  friend Pack log1p(const Pack& a) { return each(static_cast<F1*>(std::log1p), a); }
  friend Pack sin(const Pack& a) { return each(static_cast<F1*>(std::sin), a); }
  friend Pack cos(const Pack& a) { return each(static_cast<F1*>(std::cos), a); }
  friend Pack tan(const Pack& a) { return each(static_cast<F1*>(std::tan), a); }
  friend Pack asin(const Pack& a) { return each(static_cast<F1*>(std::asin), a); }
  friend Pack acos(const Pack& a) { return each(static_cast<F1*>(std::acos), a); }
  friend Pack atan(const Pack& a) { return each(static_cast<F1*>(std::atan), a); }
  friend Pack sinh(const Pack& a) { return each(static_cast<F1*>(std::sinh), a); }
  friend Pack cosh(const Pack& a) { return each(static_cast<F1*>(std::cosh), a); }
  friend Pack tanh(const Pack& a) { return each(static_cast<F1*>(std::tanh), a); }
  friend Pack atan2(const Pack& a, const Pack& b) {
    return each(static_cast<F2*>(std::atan2), a, b);
  }
  friend Pack hypot(const Pack& a, const Pack& b) {
    return each(static_cast<F2*>(std::hypot), a, b);
  }

 private:
  using F1 = double(double);
  using F2 = double(double, double);

  Pack() = default;
  template <class F>
  static Pack filled(F f) {
    Pack result;
    for (std::size_t i = 0; i < size; ++i) result.values_[i] = static_cast<double>(f(i));
    return result;
  }

  std::array<double, size> values_;  // Pack() leaves the numbers unset; its caller fills them
};

}  // namespace saltus
