// StepPolynomial: the dense output of one step.
#pragma once

#include "saltus/solver/detail/tableau.hpp"

namespace saltus {

namespace detail {

/// d/ds, at s, of the factor of each c_j in s nested(c): s^(j/2 + 1) r^((j + 1)/2), r = 1 - s.
template <std::size_t Count>
constexpr std::array<double, Count> slopes(double s) {
  const auto power = [](double base, std::size_t n) {
    double value = 1.0;
    for (std::size_t i = 0; i < n; ++i) value *= base;
    return value;
  };
  std::array<double, Count> out{};
  for (std::size_t j = 0; j < Count; ++j) {
    const std::size_t a = j / 2 + 1, b = (j + 1) / 2;
    out[j] = static_cast<double>(a) * power(s, a - 1) * power(1.0 - s, b);
    if (b > 0) out[j] -= static_cast<double>(b) * power(s, a) * power(1.0 - s, b - 1);
  }
  return out;
}

}  // namespace detail

/// x0 + s (c_0 + r (c_1 + s (c_2 + r (c_3 + ...)))), with s the part of the step and r = 1 - s. The
/// first three terms meet x and f at both ends, the others come from the method (Hairer, Norsett,
/// Wanner I, II.6 and II.10).
template <Tableau Method, int N>
class StepPolynomial {
  static constexpr int W = detail::called_width<N>;
  using Lane = detail::Lane<W>;

 public:
  static constexpr std::size_t terms = 3 + Method::d.size();

  explicit StepPolynomial(Index n) : n_(n), c_(n) {}

  /// Sets the polynomial of the step of length h from x0 to x1, with all stages in k.
  void set(double h, const double* x0, const double* x1, const double* k) {
    const Index n = size();
    in_pairs([&]<int P>(Index i) {
      using detail::load, detail::store;
      double* c = c_.data() + i;
      const detail::Lane<P> rise = load<P>(x1 + i) - load<P>(x0 + i),
                            bend = h * load<P>(k + i) - rise,
                            end = load<P>(k + i + static_cast<Index>(Method::stages - 1) * n);
      store<P>(c, rise);
      store<P>(c + n, bend);
      store<P>(c + 2 * n, rise - h * end - bend);
      set_others<P>(h, k + i, c + 3 * n, std::make_index_sequence<Method::d.size()>{});
    });
  }

  void read(const double* x0, double s, double* x) const {
    const double *c = c_.data(), r = 1.0 - s;
    in_pairs([&]<int P>(Index i) {
      detail::store<P>(
          x + i, detail::load<P>(x0 + i) + s * detail::nested<0, terms, P>(c + i, size(), s, r));
    });
  }

  /// The derivative by s of lane i, at a constant s.
  template <double S>
  Lane slope(Index i) const {
    return detail::dot<[] { return detail::slopes<terms>(S); }, terms, W>(c_.data() + i, size());
  }
  Lane last_term(Index i) const {
    return detail::load<W>(c_.data() + static_cast<Index>(terms - 1) * size() + i);
  }
  bool finite() const {
    return VectorView(c_.data(), static_cast<Index>(terms) * size()).allFinite();
  }

 private:
  Index size() const { return detail::count<N>(n_); }
  /// Calls body<2>(i) for pairs of states, and body<0>(i) for a last single one. The bits are those of
  /// single states. No call of a user's function is between two of these, so pairs pay for each
  /// number of states.
  template <class Body>
  [[gnu::always_inline]] void in_pairs(Body body) const {
    Index i = 0;
    for (const Index n = size(); i + 1 < n; i += 2) body.template operator()<2>(i);
    if (i < size()) body.template operator()<0>(i);
  }
  template <int P, std::size_t... M>
  void set_others(double h, const double* k, double* c, std::index_sequence<M...>) const {
    (detail::store<P>(
         c + static_cast<Index>(M) * size(),
         h * detail::dot_of_differences<[] { return Method::d[M]; }, Method::rows, P>(k, size())),
     ...);
  }

  Index n_;
  detail::Columns<N, terms> c_;
};

}  // namespace saltus
