#include "saltus/models/brusselator.hpp"
#include "saltus/models/e5.hpp"
#include "saltus/models/heat_rod.hpp"
#include "saltus/models/hires.hpp"
#include "saltus/models/kepler.hpp"
#include "saltus/models/lorenz.hpp"
#include "saltus/models/orego.hpp"
#include "saltus/models/pleiades.hpp"
#include "saltus/models/pollu.hpp"
#include "saltus/models/ring_modulator.hpp"
#include "saltus/models/robertson.hpp"
#include "saltus/models/van_der_pol.hpp"
#include "saltus/models/vdpol.hpp"
#include "shelf.hpp"

namespace saltus::models::detail {

std::vector<ShelfEntry> smooth_scenes() {
  return {
      {"robertson", "three rates nine decades apart", [] { return robertson(); }},
      {"hires", "eight substances, the fast reaction late", [] { return hires(); }},
      {"orego", "a chemical clock that creeps and jumps", [] { return orego(); }},
      {"van-der-pol", "a relaxation oscillator, mu = 1000", [] { return van_der_pol(); }},
      {"vdpol", "the same in units of mu", [] { return vdpol(); }},
      {"vdpol-1e6", "the same with mu = 1e6", [] { return vdpol({.epsilon = 1e-12}); }},
      {"e5", "concentrations of 1e-3 to 1e-22, time to 1e13", [] { return e5(); }},
      {"pollu", "air chemistry, radicals of 1e-18", [] { return pollu(); }},
      {"ring-modulator", "a circuit, stiff and fast oscillating", [] { return ring_modulator(); },
       false},
      {"brusselator", "reaction and diffusion on 63 nodes", [] { return brusselator(); }},
      {"heat-rod", "the heat equation under a thermostat", [] { return heat_rod(); }},
      {"kepler", "an ellipse of eccentricity 0.6", [] { return kepler(); }},
      {"pleiades", "seven bodies with close encounters", [] { return pleiades(); }},
      {"lorenz", "a strange attractor, for ten units", [] { return lorenz(); }},
  };
}

}  // namespace saltus::models::detail
