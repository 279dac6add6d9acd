// Pleiades: seven bodies of mass 1 to 7 in a plane. Close encounters, the closest of bodies 1 and 7
// at t = 1.23 and 1.68, need small steps and enlarge earlier errors.
//   d^2 r_i / dt^2 = sum over j != i of m_j (r_j - r_i) / |r_j - r_i|^3,  m_j = j
// State: x_1 to x_7, y_1 to y_7, dx/dt, dy/dt; without units, as is time. Energy, momentum and
// angular momentum are conserved. E. Hairer, S. P. Norsett, G. Wanner, Solving Ordinary
// Differential Equations I, p. 245; Test Set for IVP Solvers, PLEI.
#pragma once

#include <cmath>

#include "saltus/base/list.hpp"
#include "saltus/models/reference.hpp"

namespace saltus::models {

class Pleiades final : public LeafSystem {
 public:
  static constexpr Index bodies = 7;

  Pleiades() : LeafSystem("bodies") {
    declare_continuous_state(
        {.initial = detail::column({3, 3, -1, -3, 2, -2,   2,    3, -3, 2, 0,     0, -4, 4,
                                    0, 0, 0,  0,  0, 1.75, -1.5, 0, 0,  0, -1.25, 1, 0,  0}),
         .ode = equations<4 * bodies>([](const auto& at, auto& xdot) { flow(at, xdot); })});
    declare_continuous_state_output("r");
  }

 private:
  /// x = (positions x, positions y, their derivatives).
  static void flow(const auto& at, auto& xdot) {
    using std::sqrt;
    constexpr int ax = 2 * bodies, ay = 3 * bodies;
    for (int i = 0; i < ax; ++i) entry(xdot, i) = at.x(i + ax), entry(xdot, i + ax) = 0.0;
    for (int i = 0; i < bodies; ++i) {
      for (int j = 0; j < i; ++j) {
        const auto dx = at.x(j) - at.x(i), dy = at.x(j + bodies) - at.x(i + bodies),
                   d2 = dx * dx + dy * dy, w = 1.0 / (d2 * sqrt(d2));
        const double mi = i + 1.0, mj = j + 1.0;
        entry(xdot, ax + i) += mj * w * dx, entry(xdot, ay + i) += mj * w * dy;
        entry(xdot, ax + j) -= mi * w * dx, entry(xdot, ay + j) -= mi * w * dy;
      }
    }
  }
  static auto& entry(auto& xdot, int i) { return nth(xdot, i); }
};

struct PleiadesParameters {
  double t_end = 3.0;
};

namespace detail {

inline const Eigen::Vector<double, 7> pleiades_masses{{1, 2, 3, 4, 5, 6, 7}};

inline double pleiades_energy(const Eigen::VectorXd& s) {
  const auto& m = pleiades_masses;
  double energy =
      0.5 * m.dot((s.segment<7>(14).array().square() + s.tail<7>().array().square()).matrix());
  for (Index i = 0; i < 7; ++i)
    for (Index j = 0; j < i; ++j)
      energy -= m[i] * m[j] / std::hypot(s[j] - s[i], s[7 + j] - s[7 + i]);
  return energy;
}
inline std::vector<Invariant> pleiades_invariants() {
  const auto& m = pleiades_masses;
  return {
      {"energy", [](double, const Eigen::VectorXd& s) { return pleiades_energy(s); }},
      {"momentum x", [&m](double, const Eigen::VectorXd& s) { return m.dot(s.segment<7>(14)); }},
      {"momentum y", [&m](double, const Eigen::VectorXd& s) { return m.dot(s.tail<7>()); }},
      {"angular momentum", [&m](double, const Eigen::VectorXd& s) {
         return m.dot((s.head<7>().array() * s.tail<7>().array() -
                       s.segment<7>(7).array() * s.segment<7>(14).array())
                          .matrix());
       }}};
}

inline Exact pleiades_reference() {
  return {.provenance =
              "Radau IIA of order 13 in 34 digits, agrees with order 9 to 17 digits; the "
              "end with Test Set for IVP Solvers, PLEI, to 14",
          .samples = {
              {1, column({1.4870785157342021,   2.7039177142659843,  -0.60797604900311009,
                          -2.6224797730008671,  1.7375571608154041,  -0.18030218239287416,
                          0.54470865500383603,  3.3963540545071655,  -2.7026408145154366,
                          1.8786895377778814,   -1.2360283955156757, 1.2252086953576529,
                          -3.7069995626022716,  3.4904180631540189,  -3.5963207421338668,
                          -0.65288319325782063, 0.99734849696292438, 0.77259820301676152,
                          -0.64238883371197497, 1.8640148037476876,  -1.3074994040332231,
                          0.46178309196512884,  0.54529595910012196, -0.059671338465126317,
                          -1.2076883070364257,  1.5371964735409338,  0.61820965828412966,
                          -1.1339782977191053})},
              {2, column({-0.79292071204602732, 1.3626391512380911,   -0.36851833505657156,
                          -1.3969179557090432,  0.33909936792592471,  1.7005368501841180,
                          -0.16254981473694269, 0.47940251854774751,  -2.7405948760765968,
                          3.7992415787651801,   -2.3272553453568636,  2.3160219045508348,
                          -2.4689769857382537,  1.8781194672018158,   -0.23581395385924811,
                          1.4083472785667714,   -3.2276261417063061,  1.7155195669841492,
                          -2.8429612343342927,  0.65100527378902051,  1.5069562975493382,
                          -4.5776668323726222,  -3.3768999134865538,  2.3630090816276890,
                          -0.88238817408128722, -0.32706147435745336, 2.7727306129478295,
                          -1.0327263135874141})},
              {3, column({0.37061391439705127,  3.2372840920572332,   -3.2225590324183235,
                          0.65970914557753080,  0.34255817071565797,  1.5621721014006311,
                          -0.70030929222124949, -3.9434375855173922,  -3.2713809739725499,
                          5.2250818434565440,   -2.5906124349774693,  1.1982136933922747,
                          -0.24296823449358235, 1.0914492404289797,   3.4170038063143147,
                          1.3545845016255011,   -2.5900655978107756,  2.0250537347142412,
                          -1.1558151001604491,  -0.80729881702230222, 0.59523963542087188,
                          -3.7412449612340084,  0.37734596857506292,  0.93868588695510791,
                          0.36679222272005696,  -0.34740463538084942, 2.3449154481809371,
                          -1.9470204342632920})},
          }};
}

}  // namespace detail

/// Records "r", the state, at the times of the reference. The growth at these rows: see hires.hpp.
inline Scene pleiades(const PleiadesParameters& with = {}) {
  const auto bodies = std::make_shared<const Pleiades>();
  return detail::with_rows_at_samples(
      {.name = "Pleiades",
       .system = bodies,
       .context = bodies->create_context(),
       .span = {0.0, with.t_end},
       .options = {.rtol = 1e-6, .atol = 1e-6, .recorded_signals = {{"r", bodies->output(0)}}},
       .exact = detail::until(with.t_end, with.t_end, detail::pleiades_reference()),
       .invariants = detail::pleiades_invariants(),
       .methods = {Method::dopri5, Method::dop853, Method::adams, Method::taylor,
                   Method::automatic},
       .growth = 9200.0});
}

}  // namespace saltus::models
