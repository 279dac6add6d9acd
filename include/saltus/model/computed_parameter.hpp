// ComputedParameter: a parameter of a block as a function of the parameters of a diagram.
#pragma once

#include <memory>
#include <string>

#include <Eigen/Core>

#include "saltus/base/list.hpp"
#include "saltus/base/view.hpp"
#include "saltus/tape/tape.hpp"

namespace saltus {

struct Structure;

/// p[to .. to + size) = values(p[from .. from + count)), in the vector of all parameters.
struct ComputedParameter {
  std::string name;  ///< "gain.gain"
  Index to = 0, size = 1;
  Index from = 0, count = 0;
  tape::Tape values;  ///< reads parameters only
};

/// In the order in which they are computed: a diagram comes before the diagrams in it, whose
/// parameters may be computed too.
struct ComputedParameters {
  List<ComputedParameter> all;

  /// Computes them from the other parameters. Throws ModelError for a value that is not finite.
  void compute(Eigen::VectorXd& p) const;
};

/// What the functions of a diagram see: its parameters.
inline At at_parameters(const double* p, Index count) {
  const VectorView none(nullptr, 0);
  return {0.0, none, none, VectorView(p, count), 0, Inputs(nullptr, 0, nullptr), nullptr};
}

/// Those of a system; null if there is none.
std::shared_ptr<const ComputedParameters> computed_parameters(const Structure& structure);

}  // namespace saltus
