// LeafSystem: a system with its own equations. Its constructor declares them; its callbacks are
// short const methods.
#pragma once

#include <concepts>
#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

#include "saltus/base/list.hpp"
#include "saltus/base/matrix_entry.hpp"
#include "saltus/model/event.hpp"
#include "saltus/model/event_port.hpp"
#include "saltus/model/history.hpp"
#include "saltus/model/parameter_check.hpp"
#include "saltus/model/right_hand_side.hpp"
#include "saltus/model/system.hpp"

namespace saltus {

/// Continuous state: its initial value, xdot = ode(t, x, z, m, u, p), and the values that the ode
/// reads.
struct ContinuousState {
  Eigen::VectorXd initial = {};
  /// Names of all entries, or of none. Each name makes an output of the block, a view of its entry,
  /// and is the name of the entry as a value of a context: `ensemble.vary("height", ...)`.
  std::vector<std::string> names = {};
  RightHandSide ode = {};  ///< empty: xdot = 0
  /// d(xdot)/d(x), optional; a stiff method uses it. Differences replace entries that are not
  /// finite.
  MatrixFunction jacobian = {};
  Reads reads = Reads::everything;
  std::optional<std::vector<int>> inputs = {};  ///< the inputs the ode reads; all if not given
  /// The entries of d(xdot)/d(x) that may differ from zero, in every mode; all entries if not
  /// given.
  std::optional<std::vector<MatrixEntry>> sparsity = {};
  VectorFunction sparse_jacobian = {};  ///< the values of those entries, in their order; optional
  EntryRule entries = {};               ///< the entries of the inputs that each xdot[i] reads
  Formula formula = {};                 ///< in place of ode: a plan may fuse it
  /// The derivatives of xdot by all that the ode reads, optional: with them `sensitivity` and
  /// `linearize` take no differences of an ode that is called. A formula has exact ones by itself.
  DerivativesFunction derivatives = {};
};

/// All declarations of a leaf, in the order in which it made them.
struct Declarations {
  ContinuousState continuous;
  Eigen::VectorXd discrete;
  int mode = 0;
  bool has_modes = false;
  std::vector<Layout::Parameter> parameters;
  Eigen::VectorXd parameter_values;
  List<ParameterCheck> parameter_checks;
  List<StartCheck> start_checks;
  std::optional<ParameterIndex> seed;  ///< of its random numbers
  List<InputDeclaration> inputs;
  List<OutputDeclaration> outputs;
  List<Relation> relations;
  List<ZeroCrossing> zero_crossings;
  List<EdgeReset> edge_resets;
  List<TimeEvent> time_events;
  List<EventInputDeclaration> event_inputs;
  List<History> histories;
  /// Some function reads or writes values outside of the system that functions of other blocks write
  /// or read. All such blocks belong to one island.
  bool shares_outside = false;
  /// In a plan: the inputs that are control signals. While one of them is false, the leaf is not
  /// executed: see DiagramBuilder::execute.
  std::vector<int> controls;
  /// Everything that refers to these declarations or to a copy holds it: the leaf itself, plans,
  /// diagrams. While others hold it, each declare_* throws ModelError and changes nothing.
  std::shared_ptr<const void> use = {};
};

class LeafSystem : public System {
 public:
  using At = saltus::At;
  using Next = saltus::Next;
  using Delivery = saltus::Delivery;
  using VectorRef = saltus::VectorRef;
  using VectorView = saltus::VectorView;
  using MatrixRef = saltus::MatrixRef;

  explicit LeafSystem(std::string name = {});
  ~LeafSystem() override;
  LeafSystem(LeafSystem&&) noexcept;
  LeafSystem& operator=(LeafSystem&&) noexcept;

  const Declarations& declarations() const noexcept { return declared_; }

  std::vector<std::string> input_names() const override;
  std::vector<std::string> output_names() const override;
  void collect(Structure& out, const std::string& path) const override;
  LeafPort output_source(int index) const override;
  LeafPort input_target(int index) const override;

  std::vector<std::string> event_output_names() const override;
  std::vector<std::string> event_input_names() const override;
  LeafEvent event_source(int index) const override;
  LeafEvent event_target(int index) const override;

 protected:
  /// Throws ModelError while others refer to the declarations.
  void require_unused() const;

  /// Declares n continuous states that start at zero, or at the given values; xdot = ode(at).
  void declare_continuous_state(Index n, RightHandSide ode);
  void declare_continuous_state(ContinuousState state);
  /// d(xdot)/d(x), n by n, for stiff methods. Inputs count as constants.
  void declare_jacobian(MatrixFunction jacobian);
  /// The entries of d(xdot)/d(x) that may differ from zero, in every mode. A stiff method then
  /// needs neither memory nor calls for the others. Name each entry once, in any order, or use
  /// `band_entries(n, lower, upper)`. Name too many entries rather than too few: Newton's iteration
  /// judges itself by this matrix, so a missing entry costs steps and may cost digits. An entry
  /// outside the n by n matrix, or an entry named twice, is a ModelError when a stiff method
  /// starts.
  void declare_jacobian_sparsity(std::vector<MatrixEntry> entries);
  /// As above, with a function of the values of the entries: `values(at, out)` writes entry k to
  /// out[k].
  void declare_sparse_jacobian(std::vector<MatrixEntry> entries, VectorFunction values);
  void declare_discrete_state(const Eigen::VectorXd& initial);
  /// The mode in which the leaf starts.
  void declare_default_mode(int mode);
  /// A number or vector that is part of the context.
  ParameterIndex declare_dynamic_parameter(std::string name, const Eigen::VectorXd& value);
  ParameterIndex declare_dynamic_parameter(std::string name, double value);

  /// Refuses values of the parameters declared so far. The check is called at once with their
  /// default values, and with those of each context from which a run or an evaluation begins.
  void declare_parameter_check(ParameterCheck check);
  /// Refuses continuous states from which a run would begin: those of a context that does not continue a
  /// run.
  void declare_start_check(StartCheck check);
  /// Which parameter is the seed of the block's random numbers: Plan::describe() names the blocks that
  /// have the same one.
  void declare_seed(ParameterIndex seed);
  /// Some function of the block reads or writes values outside of the system, such as a variable that
  /// functions of several blocks refer to. All blocks that say so belong to one island. A reset map or an
  /// update that writes such a value calls Next::note_write_outside, and an output that reads one has
  /// Reads::outside among its `reads`.
  void declare_shared_outside();

  int declare_input_port(InputDeclaration input = {});
  int declare_output_port(OutputDeclaration output);
  /// The whole continuous state, the whole discrete state, the mode: outputs that are views, not
  /// copies.
  int declare_continuous_state_output(std::string name = {});
  int declare_discrete_state_output(std::string name = {});
  int declare_mode_output(std::string name = {});

  /// Returns the position of the zero crossing among those of this leaf.
  int declare_zero_crossing(ZeroCrossing crossing);
  RelationIndex declare_relation(Relation relation);
  void declare_edge_reset(EdgeReset reset);
  /// Calls `update` at offset + k period, k = 0, 1, ...; period and offset in seconds, period > 0.
  /// With `inherited_period` and no offset: at each trigger of a TriggeredSubsystem, outside of
  /// which `compile` refuses it.
  void declare_periodic_update(ResetMap update, double period, double offset = 0.0,
                               std::string name = {});
  /// Calls an update at the times of the event: in a period, at a list of times, or once; with an
  /// end or a count. Throws ModelError for times that do not increase, a period that is not
  /// positive, a count below 1, or both times and a period.
  void declare_time_event(TimeEvent event);
  /// Calls `update` once, at `time` [s]. Without update: an exact stop at which held outputs are
  /// evaluated again.
  void declare_one_shot(double time, ResetMap update = {}, std::string name = {});
  /// Declares an input for events of other leaves, see DiagramBuilder::connect_event. Returns its
  /// position. Throws ModelError for a name declared twice, a missing reset map or a size below 1.
  int declare_event_input(EventInputDeclaration input);
  /// Keeps a record of an input in the discrete state, which is declared before. Throws ModelError
  /// for an input that does not exist, no function, or a longest step that is not positive.
  void declare_history(History history);

 private:
  void require_state_names(const ContinuousState& state) const;
  void collect_samplers(Structure& out) const;
  Declarations declared_;
};

}  // namespace saltus
