// ControlledLeaf: the declarations of a leaf with a control signal.
#pragma once

#include <string>
#include <vector>

#include "saltus/plan/plan.hpp"

namespace saltus::detail {

/// Changes a copy of the declarations of a leaf. Its last input becomes the control signal.
class ControlledLeaf {
 public:
  /// `gated`: nodes that are control signals of enabled parts and nothing else, see gate_controls.
  ControlledLeaf(const PlanLeaf& leaf, const std::vector<int>& gated);

  /// The leaf is executed while the control signal is true.
  Declarations enabled(bool resets);
  /// The updates of the leaf run at the edges of the control signal.
  Declarations triggered(Edge edge);

 private:
  using Named = std::optional<std::vector<int>>;

  /// Everything that reads all inputs reads the leaf's own inputs only.
  void keep_to_own_inputs();
  void keep_to_own_widths(OutputDeclaration& output) const;
  void gate_controls();
  void rest_while_false();
  void write_while_true();
  void reset_when_enabled();
  EdgeReset reset_behind(const EdgeReset& inner) const;
  void require_interruptible() const;
  void require_updates_only() const;
  Named own_or(const Named& named) const { return named ? named : own_; }
  Named with_control(const Named& named) const;
  bool is_gated(int node) const;
  ResetMap while_true(const ResetMap& map) const;
  [[noreturn]] void refuse(const std::string& what) const;

  const PlanLeaf& leaf_;
  const std::vector<int>& gated_;
  const LeafSystem& system_;
  std::string path_;
  Declarations declared_;
  std::vector<int> own_;  // the inputs of the leaf itself
  int control_;           // the input that reads the control signal
};

}  // namespace saltus::detail
