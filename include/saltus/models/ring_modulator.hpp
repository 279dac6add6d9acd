// Ring modulator: four diodes in a ring mix a signal of 1 kHz with a carrier of 10 kHz. The
// parasitic capacitance Cs makes it stiff and adds oscillations of 5 MHz, which are lightly damped:
// a nonlinear circuit in which a stiff method must resolve the fast oscillations.
//   C  dy1/dt = y8 - y10/2 + y11/2 + y14 - y1/R        C dy2/dt = y9 - y12/2 + y13/2 + y15 - y2/R
//   Cs dy3/dt = y10 - q1 + q4                         Cs dy4/dt = -y11 + q2 - q3
//   Cs dy5/dt = y12 + q1 - q3                         Cs dy6/dt = -y13 - q2 + q4
//   Cp dy7/dt = -y7/Rp + q1 + q2 - q3 - q4
//   Lh dy8/dt = -y1                                   Lh dy9/dt = -y2
//   Ls2 dy10/dt =  y1/2 - y3 - Rg2 y10                Ls3 dy11/dt = -y1/2 + y4 - Rg3 y11
//   Ls2 dy12/dt =  y2/2 - y5 - Rg2 y12                Ls3 dy13/dt = -y2/2 + y6 - Rg3 y13
//   Ls1 dy14/dt = -y1 + in1 - (Ri + Rg1) y14          Ls1 dy15/dt = -y2 - (Rc + Rg1) y15
//   q_i = gamma (exp(delta u_i) - 1),  in1 = sin(2e3 pi t) / 2,  in2 = 2 sin(2e4 pi t)
//   u1 = y3 - y5 - y7 - in2,  u2 = -y4 + y6 - y7 - in2,  u3 = y4 + y5 + y7 + in2,
//   u4 = -y3 - y6 + y7 + in2
// State: voltages y1 to y7 [V], currents y8 to y15 [A]; time in seconds; y(0) = 0. E. H. Horneber,
// thesis, Kaiserslautern 1976; Test Set for IVP Solvers, ringmod.
#pragma once

#include <cmath>
#include <numbers>

#include "saltus/models/reference.hpp"

namespace saltus::models {

/// The parts of the circuit, as in the Test Set.
struct RingCircuit {
  double C = 1.6e-8, Cs = 2e-12, Cp = 1e-8;                                         ///< [F]
  double Lh = 4.45, Ls1 = 2e-3, Ls2 = 5e-4, Ls3 = 5e-4;                             ///< [H]
  double R = 25e3, Rp = 50, Rg1 = 36.3, Rg2 = 17.3, Rg3 = 17.3, Ri = 50, Rc = 600;  ///< [ohm]
  double gamma = 40.67286402e-9;  ///< [A] reverse current of a diode
  double delta = 17.7493332;      ///< [1/V]
};

class RingModulator final : public LeafSystem {
 public:
  explicit RingModulator(const RingCircuit& parts = {}) : LeafSystem("circuit"), parts_(parts) {
    declare_continuous_state(15, &RingModulator::ode);
    declare_continuous_state_output("y");
  }

 private:
  double diode(double u) const { return parts_.gamma * std::expm1(parts_.delta * u); }  // [A]

  void ode(const At& at, VectorRef xdot) const {
    const RingCircuit& k = parts_;
    const auto y = [&](Index i) { return at.x[i - 1]; };  // counted from 1, as above
    const double in1 = 0.5 * std::sin(2e3 * std::numbers::pi * at.time),
                 in2 = 2.0 * std::sin(2e4 * std::numbers::pi * at.time);
    const double q1 = diode(y(3) - y(5) - y(7) - in2), q2 = diode(-y(4) + y(6) - y(7) - in2),
                 q3 = diode(y(4) + y(5) + y(7) + in2), q4 = diode(-y(3) - y(6) + y(7) + in2);
    xdot << (y(8) - 0.5 * y(10) + 0.5 * y(11) + y(14) - y(1) / k.R) / k.C,
        (y(9) - 0.5 * y(12) + 0.5 * y(13) + y(15) - y(2) / k.R) / k.C,
        (y(10) - q1 + q4) / k.Cs,                        //
        (-y(11) + q2 - q3) / k.Cs,                       //
        (y(12) + q1 - q3) / k.Cs,                        //
        (-y(13) - q2 + q4) / k.Cs,                       //
        (-y(7) / k.Rp + q1 + q2 - q3 - q4) / k.Cp,       //
        -y(1) / k.Lh,                                    //
        -y(2) / k.Lh,                                    //
        (0.5 * y(1) - y(3) - k.Rg2 * y(10)) / k.Ls2,     //
        (-0.5 * y(1) + y(4) - k.Rg3 * y(11)) / k.Ls3,    //
        (0.5 * y(2) - y(5) - k.Rg2 * y(12)) / k.Ls2,     //
        (-0.5 * y(2) + y(6) - k.Rg3 * y(13)) / k.Ls3,    //
        (-y(1) + in1 - (k.Ri + k.Rg1) * y(14)) / k.Ls1,  //
        (-y(2) - (k.Rc + k.Rg1) * y(15)) / k.Ls1;
  }

  RingCircuit parts_;
};

struct RingModulatorParameters {
  double t_end = 1e-3;  ///< [s] one period of the signal
};

namespace detail {

inline Exact ring_modulator_reference() {
  return {
      .provenance =
          "Radau IIA of order 13 in 34 digits, agrees with order 9 to 13 up to 5e-4 s; the end "
          "agrees with Test Set for IVP Solvers, "
          "ringmod, to 9",
      .samples = {
          {0.00025,
           column({0.48938659703804410, -0.34509947632369198, -0.060796062480961879,
                   0.57415328347489958, 0.12714464201860329, -0.50780470393725818,
                   -0.11186120464342537, -0.000015457672993338590, 1.5647299451413056e-6,
                   -0.00013497151721924170, -0.0014218852127808512, 0.0014224360029188731,
                   0.00013442072708121994, 0.00058521297472615167, 0.00055571754519668289})},
          {0.0005,
           column({0.020736224931860607, 0.0054937131293245215, 0.40519601159666874,
                   -0.25955610365124721, -0.26179423535404228, 0.40295787989387361,
                   0.11067561641932572, -0.000031623281302806880, -1.6179437927872275e-8,
                   0.00078925769763411933, 0.00073039450135234472, -0.00079073580115943435,
                   -0.00072891639782702981, -0.000042549267023087352, -0.000020895432412136194})},
          {0.00075,
           column({-0.49207469029081607, 0.34695080794409183, -0.58237151332138337,
                   0.052003536203430845, 0.51528994461782074, -0.11908510490699338,
                   -0.11187582342118726, -0.000016006885960093299, -1.6269347291647891e-6,
                   -0.0014257800990638550, -0.00013157990472932558, 0.00013153964944221671,
                   0.0014258203543509639, -0.00055688230778735471, -0.00055874192485754783})},
          {0.001,
           column({-0.023390573584371598, -0.0073674854860082259, 0.25829567099919187,
                   -0.40644657205880108, -0.40394556644554414, 0.26079667661244882,
                   0.11067618612732984, 2.9399043424330131e-7, -2.8400299330664039e-8,
                   0.00072671982672914567, 0.00079294871970232348, -0.00072552834957658439,
                   -0.00079414019685488475, 0.000070884954168756790, 0.000023900590752771061})},
      }};
}

}  // namespace detail

/// Records "y" at the times of the reference. The growth: see hires.hpp.
inline Scene ring_modulator(const RingModulatorParameters& with = {}) {
  const auto circuit = std::make_shared<const RingModulator>();
  return detail::with_rows_at_samples(
      {.name = "ring modulator",
       .system = circuit,
       .context = circuit->create_context(),
       .span = {0.0, with.t_end},
       .options = {.rtol = 1e-6, .atol = 1e-8, .recorded_signals = {{"y", circuit->output(0)}}},
       .exact = detail::until(with.t_end, with.t_end, detail::ring_modulator_reference()),
       .methods = {Method::bdf, Method::radau, Method::automatic},
       .growth = 3600.0});
}

}  // namespace saltus::models
