// equilibria: several operating points, each once.
#pragma once

#include <string>
#include <vector>

#include "saltus/analysis/trim.hpp"

namespace saltus {

struct EquilibriaOptions {
  /// A box: free values with finite bounds, within which the points are looked for.
  std::vector<FreeValue> box = {};
  /// Or starts, each with a value for the same names; then `box` is empty.
  std::vector<std::vector<NamedValue>> starts = {};
  int count = 32;     ///< the number of starts in a box
  double seed = 0.0;  ///< of their draw: any finite number
  /// As in TrimOptions.
  std::vector<LinearInput> hold = {};
  std::vector<WantedRate> derivatives = {};
  std::vector<WantedOutput> outputs = {};
  double tolerance = 1e-9;
  std::optional<int> max_nfev = {};
  std::shared_ptr<Refinement> refinement = {};
};

/// Distinct operating points, by the first free value, then by the second, and so on.
struct Equilibria {
  std::vector<OperatingPoint> points;
  int starts = 0;                     ///< how many there were
  std::vector<std::string> failures;  ///< the messages of the starts that led to no point
};

/// Operating points from several starts, each point once, with its poles and its stability. Each
/// start is a search by `trim`. Starts in a box are drawn by a Latin hypercube (M. McKay,
/// R. Beckman, W. Conover, Technometrics 21 (1979) 239). There is no proof that all points are
/// found; more starts find more.
///
/// Throws ModelError as `trim` does, but a start that fails is counted in `failures`; and for a value
/// without finite bounds, and for starts with different names.
Equilibria equilibria(const System& system, const Context& context,
                      const EquilibriaOptions& options);

}  // namespace saltus
