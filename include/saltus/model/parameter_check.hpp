// What a leaf says about the values of its own parameters.
#pragma once

#include <functional>
#include <string>

#include "saltus/base/view.hpp"

namespace saltus {

/// The values of all parameters of one leaf.
class ParameterValues {
 public:
  explicit ParameterValues(VectorView all) : all_(all) {}
  double operator[](ParameterIndex k) const { return all_[k.offset]; }
  VectorView vector(ParameterIndex k) const { return {all_.data() + k.offset, k.size}; }

 private:
  VectorView all_;
};

/// Throws ModelError, better BlockParameterError, for values that a block cannot have, alone or
/// together. `block` is its name, or its path in the diagram that is run.
using ParameterCheck = std::function<void(const std::string& block, const ParameterValues& values)>;

/// Throws BlockParameterError for a continuous state from which a run of a block cannot begin at t [s].
using StartCheck = std::function<void(const std::string& block, double t, const VectorView& state,
                                      const ParameterValues& values)>;

}  // namespace saltus
