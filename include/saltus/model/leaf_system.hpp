// LeafSystem: a system with its own equations. Its constructor declares; its callbacks are short
// const methods.
#pragma once

#include <concepts>
#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

#include "saltus/base/matrix_entry.hpp"
#include "saltus/model/event.hpp"
#include "saltus/model/system.hpp"

namespace saltus {

/// Continuous state: initial value, xdot = ode(t, x, z, m, u, p), and what the ode reads.
struct ContinuousState {
  Eigen::VectorXd initial = {};
  VectorFunction ode = {};  ///< empty: xdot = 0
  /// d(xdot)/d(x), optional; used by a stiff method. Differences stand in for entries that are not
  /// finite.
  MatrixFunction jacobian = {};
  Reads reads = Reads::everything;
  std::optional<std::vector<int>> inputs = {};  ///< the inputs the ode reads; all if not said
  /// Where d(xdot)/d(x) may differ from zero, in every mode; everywhere if not said.
  std::optional<std::vector<MatrixEntry>> sparsity = {};
  VectorFunction sparse_jacobian = {};  ///< the values of those entries, in their order; optional
  EntryRule entries = {};               ///< which entries of the inputs each xdot[i] reads
  Formula formula = {};                 ///< instead of ode: what a plan may fuse
};

/// All that a leaf has declared, in the order in which it did.
struct Declarations {
  ContinuousState continuous;
  Eigen::VectorXd discrete;
  int mode = 0;
  bool has_modes = false;
  std::vector<Layout::Parameter> parameters;
  Eigen::VectorXd parameter_values;
  std::vector<InputDeclaration> inputs;
  std::vector<OutputDeclaration> outputs;
  std::vector<Relation> relations;
  std::vector<ZeroCrossing> zero_crossings;
  std::vector<EdgeReset> edge_resets;
  std::vector<TimeEvent> time_events;
};

class LeafSystem : public System {
 public:
  using At = saltus::At;
  using Next = saltus::Next;
  using VectorRef = saltus::VectorRef;
  using VectorView = saltus::VectorView;
  using MatrixRef = saltus::MatrixRef;

  explicit LeafSystem(std::string name = {}) : System(std::move(name)) {}

  const Declarations& declarations() const noexcept { return declared_; }

  std::vector<std::string> input_names() const override;
  std::vector<std::string> output_names() const override;
  void collect(Structure& out, const std::string& path) const override;
  LeafPort output_source(int index) const override { return {this, index}; }
  LeafPort input_target(int index) const override { return {this, index}; }

 protected:
  /// n continuous states that start at zero, or at the given values; xdot = ode(at).
  void declare_continuous_state(Index n, VectorFunction ode) {
    declare_continuous_state({.initial = Eigen::VectorXd::Zero(n), .ode = std::move(ode)});
  }
  void declare_continuous_state(ContinuousState state);
  /// d(xdot)/d(x), n by n, for stiff methods; inputs count as constants.
  void declare_jacobian(MatrixFunction jacobian) {
    declared_.continuous.jacobian = std::move(jacobian);
  }
  /// The entries of d(xdot)/d(x) that may differ from zero, in every mode: a stiff method then
  /// needs neither the memory nor the calls for the others. Each entry once, in any order, or
  /// `band_entries(n, lower, upper)`. Name too many rather than too few: Newton's iteration judges
  /// itself by this matrix, so a missing entry costs steps and may cost digits. When a stiff method
  /// starts, an entry outside the n by n matrix, or one named twice, is a ModelError.
  void declare_jacobian_sparsity(std::vector<MatrixEntry> entries) {
    declared_.continuous.sparsity = std::move(entries);
  }
  /// The same with a function of their values: `values(at, out)` puts entry k into out[k].
  void declare_sparse_jacobian(std::vector<MatrixEntry> entries, VectorFunction values) {
    declare_jacobian_sparsity(std::move(entries));
    declared_.continuous.sparse_jacobian = std::move(values);
  }
  void declare_discrete_state(const Eigen::VectorXd& initial);
  /// The mode the leaf starts in.
  void declare_default_mode(int mode);
  /// A number or vector that lives in the context.
  ParameterIndex declare_dynamic_parameter(std::string name, const Eigen::VectorXd& value);
  ParameterIndex declare_dynamic_parameter(std::string name, double value) {
    return declare_dynamic_parameter(std::move(name), Eigen::VectorXd::Constant(1, value));
  }

  int declare_input_port(InputDeclaration input = {});
  int declare_output_port(OutputDeclaration output);
  /// The whole continuous state, the whole discrete state, the mode: as they are, not copied.
  int declare_continuous_state_output(std::string name = {});
  int declare_discrete_state_output(std::string name = {});
  int declare_mode_output(std::string name = {});

  /// Returns the position of the zero crossing among those of this leaf.
  int declare_zero_crossing(ZeroCrossing crossing);
  RelationIndex declare_relation(Relation relation);
  void declare_edge_reset(EdgeReset reset);
  /// `update` at offset + k period, k = 0, 1, ...; period and offset in seconds, period > 0.
  void declare_periodic_update(ResetMap update, double period, double offset = 0.0,
                               std::string name = {});
  /// `update` once, at `time` [s]. Without update: an exact stop at which held outputs are read
  /// again.
  void declare_one_shot(double time, ResetMap update = {}, std::string name = {});

 private:
  Declarations declared_;
};

}  // namespace saltus

#include "saltus/model/declare.hpp"
