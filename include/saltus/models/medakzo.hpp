// Medical Akzo Nobel: antibodies, labelled by radioactivity, enter a tissue that a tumour grows in
// and bind to it. A front runs into the tissue as long as they are supplied.
//   du/dt = d2u/dx2 - k u v,  dv/dt = -k u v  for x > 0, with z = x / (x + c) in place of x:
//   du_j/dt = a_j (u_{j+1} - u_{j-1}) / (2 dz) + b_j (u_{j-1} - 2 u_j + u_{j+1}) / dz^2 - k u_j v_j
//   dv_j/dt = -k u_j v_j,  a_j = 2 (z_j - 1)^3 / c^2,  b_j = (z_j - 1)^4 / c^2,  z_j = j dz = j / N
//   u_0 = phi: 2 until t = 5, then 0;  u_{N+1} = u_N;  u(0) = 0, v(0) = 1;  k = 100, c = 4
// State: u_1, v_1, u_2, v_2, ...: a band of two entries beside the diagonal. Without units. N in
// the block. The data have a jump at t = 5, a time event ("supply_ends") that changes the mode.
// Test Set for IVP Solvers, Medical Akzo Nobel.
#pragma once

#include "saltus/models/medakzo_reference.hpp"

namespace saltus::models {

class MedicalAkzo final : public LeafSystem {
 public:
  enum Mode { cut_off, supplied };

  explicit MedicalAkzo(Index n = 200) : LeafSystem("tissue"), n_(n) {
    if (n < 2) throw ModelError(text("MedicalAkzo: expected N >= 2 nodes, found ", n));
    declare_continuous_state(
        {.initial = Eigen::Vector2d(0.0, 1.0).replicate(n, 1), .ode = &MedicalAkzo::ode});
    declare_jacobian_sparsity(band_entries(2 * n, 2, 2));
    declare_continuous_state_output("y");
    declare_default_mode(supplied);
    declare_one_shot(5.0, [](const At&, Next& next) { next.set_mode(cut_off); }, "supply_ends");
  }

 private:
  void ode(const At& at, VectorRef xdot) const {
    const double n = static_cast<double>(n_), c = 4.0, k = 100.0;
    for (Index j = 0; j < n_; ++j) {
      const double z = static_cast<double>(j + 1) / n - 1.0, b = z * z * z * z / (c * c),
                   a = 2.0 * z * z * z / (c * c), u = at.x[2 * j],
                   before = j > 0 ? at.x[2 * j - 2] : (at.mode == supplied ? 2.0 : 0.0),
                   after = j < n_ - 1 ? at.x[2 * j + 2] : u, bound = k * u * at.x[2 * j + 1];
      xdot[2 * j] = a * (after - before) * n / 2.0 + b * (before - 2.0 * u + after) * n * n - bound;
      xdot[2 * j + 1] = -bound;
    }
  }

  Index n_;
};

struct MedicalAkzoParameters {
  Index n = 200;  ///< nodes
  double t_end = 20.0;
};

/// Records "y" at the start and at t = 20. The growth is measured: a change of 1e-5 (1 + |y|) in
/// every entry makes errors up to 15.8 times as large at the end, where u and v err with opposite
/// signs from the start on; other signs and times of the change make smaller ones.
inline Scene medical_akzo(const MedicalAkzoParameters& with = {}) {
  const auto tissue = std::make_shared<const MedicalAkzo>(with.n);
  Exact known =
      with.n == 200 ? detail::medakzo_reference() : Exact{.provenance = "none: not N = 200"};
  if (with.t_end >= 5.0) known.events = {detail::firings("tissue.supply_ends", {5.0})};
  return detail::with_rows_at_samples(
      {.name = "Medical Akzo Nobel",
       .system = tissue,
       .context = tissue->create_context(),
       .span = {0.0, with.t_end},
       .options = {.rtol = 1e-6, .atol = 1e-6, .recorded_signals = {{"y", tissue->output(0)}}},
       .exact = detail::until(with.t_end, with.t_end, std::move(known)),
       .methods = {Method::bdf, Method::radau, Method::automatic},
       .growth = 16.0});
}

}  // namespace saltus::models
