// Transition: the step from x- to x+. Everything that reset maps and updates write is committed
// together.
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "saltus/base/list.hpp"
#include "saltus/model/number_of.hpp"
#include "saltus/model/pending.hpp"
#include "saltus/plan/detail/machine.hpp"
#include "saltus/simulation/detail/state_writes.hpp"

namespace saltus {

class Tangents;

/// Holds the values before the instant and the values to come. The reset maps of one pass write the
/// values to come; `commit` makes them the present ones. This class counts which blocks were reset,
/// and decides nothing.
class Transition {
 public:
  explicit Transition(Machine& machine);
  /// Who differentiates each transition; null: nobody.
  void follow(Tangents* tangents) noexcept { tangents_ = tangents; }
  Tangents* tangents() const noexcept { return tangents_; }

  /// The instant begins: the present values are x-, z-, y-.
  void open();
  /// The present values become x-, z-, y- again, and the modes those before the instant.
  void undo();
  /// A pass begins: the values to come are the present ones.
  void begin_pass();

  /// One call of a reset map or an update.
  struct Call {
    const ResetMap* map;
    int leaf;
    Index entry;              ///< which guard of a vector of guards
    double t;                 ///< [s]
    std::string_view source;  ///< "block.event", for errors
    bool before = false;      ///< it reads its inputs as they were before the instant
  };
  /// What a function of a leaf sees in this pass: its states and its mode are those to come.
  struct Seen {
    int leaf;
    Index entry;
    const double *x, *z;  ///< of the leaf
    int mode;
  };
  Seen seen_by(int leaf, Index entry) const {
    const PlanLeaf& of = machine_->plan().leaf(leaf);
    return {leaf, entry, x_next_.data() + of.x, z_next_.data() + of.z, modes_next_[leaf]};
  }
  /// Whether the functions that ran in this pass have changed the discrete state or the mode of a leaf.
  bool changed_in_pass(int leaf) const;
  /// Runs a reset map or an update of a leaf. It sees the values that the earlier ones of this pass
  /// wrote to the states and the mode of its leaf (3.2, 3.3). Returns whether it had an effect: it
  /// wrote a state, or changed the mode.
  bool run(const Call& call);
  /// A delivery of an event wire.
  struct Arrival {
    int leaf, input;
    Index entry;
    double weight;
    double t;  ///< [s]
  };
  /// Runs the reset map of an event input, as `run` does.
  void deliver(const Arrival& arrival);
  /// The number that a function gives for the values that a reset map would see now.
  double number(const NumberOf& number, int leaf, Index entry, double t);
  /// What a reset map would write now; nothing is written.
  FrozenValues values(const Call& call);
  /// Writes what a reset map computed earlier.
  void write(int leaf, const FrozenValues& values);
  void enter_mode(int leaf, int mode) { modes_next_[leaf] = mode, wrote_mode_ = true; }

  /// The values to come become the present ones. Returns whether a mode changed.
  bool commit();

  /// Whether the value at that place differs from its value before the instant.
  bool changed(const Place& place) const;
  bool held_outputs_changed() const;
  /// Whether the solver's f or x differs from before the instant.
  bool restarts() const;

  bool pass_wrote() const noexcept { return pass_wrote_; }  ///< the last pass wrote states
  /// The reset maps of this instant that wrote continuous states.
  const StateWrites& writes() const noexcept { return writes_; }

  const Eigen::VectorXd& before() const noexcept { return x_minus_; }
  Eigen::VectorXd& next() noexcept { return x_next_; }
  const Eigen::VectorXd& next() const noexcept { return x_next_; }
  /// Some groups of guards at the values to come. Signals of other blocks are the present ones.
  void guards_after(std::span<const int> groups, double t, double* values);
  /// Exchanges the present modes with those before the last commit that changed any, and the present
  /// signals with those before the instant.
  void swap_with_before();

 private:
  struct Wrote {
    bool x, z;
  };
  At seen(int leaf, Index entry, double t);
  Inputs inputs_before(int leaf);
  Wrote apply(const Call& call, VectorRef x, VectorRef z, int& mode);
  Wrote receive(const Arrival& arrival, VectorRef x, VectorRef z, int& mode);
  void count(int leaf, Wrote wrote);

  Machine* machine_;
  Tangents* tangents_ = nullptr;
  Eigen::VectorXd x_minus_, z_minus_, y_minus_, x_next_, z_next_;
  Bases minus_ = {};  // the values before the instant
  Bases now_ = {};    // the present values, for deliveries
  List<int> modes_next_, modes_before_;
  List<int> modes_minus_;    // before the instant, once a commit has changed a mode
  bool wrote_mode_ = false;  // in the last pass: modes_next_ may differ from the modes
  bool pass_wrote_ = false, entered_ = false, restarts_ = false;
  StateWrites writes_;
};

/// Whether some derivative reads the discrete state or the mode of a leaf.
bool derivatives_read(const Plan& plan, Reads kind, int leaf);

}  // namespace saltus
