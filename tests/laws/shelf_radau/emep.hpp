// EMEP in binary128. The lists of reactions and constants are those of the scene, read as decimals;
// the published end shows whether they are right. Time counts from 4 h of the first day.
#pragma once

#include <charconv>

#include "../../../include/saltus/models/emep_rates.hpp"
#include "../../../include/saltus/models/emep_reactions.hpp"
#include "problem.hpp"

/// The decimal that a constant of a table was written as.
inline Quad decimal(double x) {
  char digits[64];
  *std::to_chars(digits, digits + sizeof digits, x).ptr = '\0';
  return number(digits);
}

struct EmepNow {
  Vector k = Vector(237), light = Vector(17);
};

/// Up to and including its end, each part of a day has its own branch.
inline EmepNow emep_now(Quad t) {
  using namespace saltus::models::detail;
  EmepNow now;
  const Quad days = 86400, whole = ceilq(t / days) - 1, tod = t - days * whole, kelvin = 298,
             zero = number("273.16"), pi = M_PIq;
  const bool day = tod > 4 * 3600 && tod <= 20 * 3600;
  for (const auto& c : emep_constants)
    now.k[c.rate] = decimal(c.factor) * expq(decimal(c.kelvin) / kelvin);
  const Quad air = number("2.55e19"), ratio = kelvin / 300;
  now.k[1] = number("5.7e-34") * powq(ratio, -number("2.8")) * air * number("5.2e18");
  now.k[5] = number("9.6e-32") * powq(ratio, -number("1.6")) * air;
  now.k[7] = number("2e-11") * expq(100 / kelvin) * air;
  const Quad xz = (number("597.3") - number("0.57") * (kelvin - zero)) * 18 / number("1.986") *
                  (1 / kelvin - 1 / zero),
             humidity = 23 * sinq(number("2.43") - number("7.93e-5") * tod) + number("66.5"),
             h2o = number("6.1078") * expq(-xz) * 10 / (number("1.38e-16") * kelvin) * humidity;
  now.k[8] *= h2o;
  now.k[36] =
      (number("2.3e-13") * expq(600 / kelvin) + air * number("1.7e-33") * expq(1000 / kelvin)) *
      (1 + number("1.4e-21") * h2o * expq(2200 / kelvin));
  for (std::size_t i = 0; i < emep_deposition.size(); ++i)
    now.k[47 + i] = decimal(emep_deposition[i]) / (day ? 1 : 4) / 120000;
  const Quad latitude = 50 * pi / 180, declination = number("23.5") * pi / 180,
             cosine = cosq((1 + tod / 43200) * pi) * cosq(latitude) * cosq(declination) +
                      sinq(latitude) * sinq(declination);
  for (std::size_t n = 1; n <= 16; ++n)
    now.light[n] = day ? decimal(emep_light[n - 1].a) * expq(-decimal(emep_light[n - 1].b) / cosine)
                       : number("1e-40");
  return now;
}

inline Vector emep_emission() {
  using namespace saltus::models::detail;
  Vector out(66);
  Quad moles = 0;
  for (const auto& s : emep_hydrocarbons) moles += decimal(s.fraction) / decimal(s.weight);
  const Quad unit = number("2.5e11") / 120000;
  for (const auto& s : emep_hydrocarbons)
    out[s.substance - 1] = unit * decimal(s.fraction) / decimal(s.weight) / moles;
  for (const auto& m : emep_multiples) out[m.substance - 1] = unit * decimal(m.multiple);
  return out;
}

inline Equation emep() {
  struct Term {
    int rate, a, b;
    std::vector<std::pair<int, Quad>> changes;
  };
  std::vector<Term> terms;
  for (const auto& r : saltus::models::detail::emep_reactions()) {
    terms.push_back({r.rate, r.first, r.second, {}});
    for (const auto& c : r.changes)
      terms.back().changes.push_back({c.substance, decimal(c.amount)});
  }
  return [terms, emission = emep_emission(), last = Quad(-1), now = EmepNow()](
             Quad t, const Vector& y, Vector& f) mutable {
    if (t != last) now = emep_now(t + 14400), last = t;
    f = emission;
    for (const Term& r : terms) {
      const Quad rate = (r.rate < 0 ? now.light[-r.rate] : now.k[r.rate]) * y[r.a - 1] *
                        (r.b > 0 ? y[r.b - 1] : Quad(1));
      for (const auto& [substance, amount] : r.changes) f[substance - 1] += amount * rate;
    }
  };
}

inline Vector emep_start() {
  Vector y(66, 100);
  for (int i = 0; i < 13; ++i) y[i] = 10000000;
  y[0] = number("1e9"), y[1] = y[2] = number("5e9"), y[3] = number("3.8e12");
  y[4] = number("3.5e13"), y[13] = number("5e11"), y[37] = number("1e-3");
  return y;
}

/// Every jump of the rates, in hours after 4 h, and the end.
inline std::vector<Quad> emep_times() {
  std::vector<Quad> times;
  for (int day = 0; day < 5; ++day) {
    if (day > 0) times.push_back(3600 * Quad(24 * day - 4)), times.push_back(3600 * Quad(24 * day));
    times.push_back(3600 * Quad(24 * day + 16));
  }
  return times;
}
