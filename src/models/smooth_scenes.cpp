#include "saltus/models/b5.hpp"
#include "saltus/models/beam.hpp"
#include "saltus/models/brusselator.hpp"
#include "saltus/models/brusselator_2d.hpp"
#include "saltus/models/cusp.hpp"
#include "saltus/models/e5.hpp"
#include "saltus/models/emep.hpp"
#include "saltus/models/heat_rod.hpp"
#include "saltus/models/hires.hpp"
#include "saltus/models/kepler.hpp"
#include "saltus/models/lorenz.hpp"
#include "saltus/models/medakzo.hpp"
#include "saltus/models/orego.hpp"
#include "saltus/models/plate.hpp"
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
      entry<RobertsonParameters>("robertson", "three rates nine decades apart", &robertson,
                                 {{"k1", &RobertsonParameters::k1},
                                  {"k2", &RobertsonParameters::k2},
                                  {"k3", &RobertsonParameters::k3},
                                  {"t_end", &RobertsonParameters::t_end, positive}}),
      entry<HiresParameters>("hires", "eight substances, the fast reaction late", &hires,
                             {{"t_end", &HiresParameters::t_end, positive}}),
      entry<OregoParameters>("orego", "a chemical clock that creeps and jumps", &orego,
                             {{"s", &OregoParameters::s},
                              {"q", &OregoParameters::q},
                              {"w", &OregoParameters::w},
                              {"t_end", &OregoParameters::t_end, positive}}),
      entry<VanDerPolParameters>("van-der-pol", "a relaxation oscillator, mu = 1000", &van_der_pol,
                                 {{"mu", &VanDerPolParameters::mu},
                                  {"x0", &VanDerPolParameters::x0},
                                  {"v0", &VanDerPolParameters::v0},
                                  {"t_end", &VanDerPolParameters::t_end, positive}}),
      entry<VdpolParameters>("vdpol", "the same in units of mu", &vdpol,
                             {{"epsilon", &VdpolParameters::epsilon, positive},
                              {"t_end", &VdpolParameters::t_end, positive}}),
      entry<VdpolParameters>("vdpol-1e6", "the same with mu = 1e6", &vdpol,
                             {{"epsilon", &VdpolParameters::epsilon, positive},
                              {"t_end", &VdpolParameters::t_end, positive}},
                             VdpolParameters{.epsilon = 1e-12}),
      entry<E5Parameters>("e5", "concentrations of 1e-3 to 1e-22, time to 1e13", &e5,
                          {{"t_end", &E5Parameters::t_end, positive}}),
      entry<PolluParameters>("pollu", "air chemistry, radicals of 1e-18", &pollu,
                             {{"t_end", &PolluParameters::t_end, positive}}),
      entry<RingModulatorParameters>(
          "ring-modulator", "a circuit, stiff and fast oscillating", &ring_modulator,
          {{"t_end", &RingModulatorParameters::t_end, positive}}, RingModulatorParameters{}, false),
      entry<BrusselatorParameters>("brusselator", "reaction and diffusion on 63 nodes",
                                   &brusselator,
                                   {{"n", &BrusselatorParameters::n, 1, 1e+06},
                                    {"alpha", &BrusselatorParameters::alpha},
                                    {"t_end", &BrusselatorParameters::t_end, positive}}),
      entry<B5Parameters>(
          "b5", "eigenvalues beside the imaginary axis", &b5,
          {{"alpha", &B5Parameters::alpha}, {"t_end", &B5Parameters::t_end, positive}}),
      entry<BeamParameters>(
          "beam", "an elastic beam: stiff, oscillating, without damping", &beam,
          {{"n", &BeamParameters::n, 2, 1000}, {"t_end", &BeamParameters::t_end, positive}},
          BeamParameters{}, false),
      entry<CuspParameters>("cusp", "nerve cells on a ring that jump over a threshold", &cusp,
                            {{"n", &CuspParameters::n, 3, 1e+05},
                             {"epsilon", &CuspParameters::epsilon, positive},
                             {"t_end", &CuspParameters::t_end, positive}}),
      entry<PlateParameters>("plate", "a plate under a vehicle: friction and elasticity", &plate,
                             {{"omega", &PlateParameters::omega},
                              {"sigma", &PlateParameters::sigma},
                              {"t_end", &PlateParameters::t_end, positive}}),
      entry<MedicalAkzoParameters>("medakzo", "a front into tissue; the supply ends at t = 5",
                                   &medical_akzo,
                                   {{"n", &MedicalAkzoParameters::n, 2, 1e+05},
                                    {"t_end", &MedicalAkzoParameters::t_end, positive}}),
      entry<Brusselator2dParameters>(
          "brusselator-2d", "reaction and diffusion on a square with a source", &brusselator_2d,
          {{"n", &Brusselator2dParameters::n, 3, 1000},
           {"alpha", &Brusselator2dParameters::alpha},
           {"t_end", &Brusselator2dParameters::t_end, positive}},
          Brusselator2dParameters{}, false),
      entry<EmepParameters>("emep", "ozone over Europe: 66 substances, light by day only", &emep,
                            {{"t_end", &EmepParameters::t_end, Emep::sunrise}}),
      entry<HeatRodProblem>("heat-rod", "the heat equation under a thermostat", &heat_rod,
                            {{"n", &HeatRodProblem::n, 3, 255},
                             {"kappa", &HeatRodProblem::kappa, positive},
                             {"power", &HeatRodProblem::power, positive},
                             {"low", &HeatRodProblem::low, positive},
                             {"high", &HeatRodProblem::high, positive},
                             {"t_end", &HeatRodProblem::t_end, positive}}),
      entry<KeplerParameters>("kepler", "an ellipse of eccentricity 0.6", &kepler,
                              {{"e", &KeplerParameters::e, 0, below_one},
                               {"t_end", &KeplerParameters::t_end, positive}}),
      entry<PleiadesParameters>("pleiades", "seven bodies with close encounters", &pleiades,
                                {{"t_end", &PleiadesParameters::t_end, positive}}),
      entry<LorenzParameters>("lorenz", "a strange attractor, for ten units", &lorenz,
                              {{"sigma", &LorenzParameters::sigma},
                               {"rho", &LorenzParameters::rho},
                               {"beta", &LorenzParameters::beta},
                               {"t_end", &LorenzParameters::t_end, positive}}),
  };
}

}  // namespace saltus::models::detail
