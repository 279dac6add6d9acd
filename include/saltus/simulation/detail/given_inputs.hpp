// GivenInputs: a system whose open inputs have values, without a change of the system.
#pragma once

#include <string>
#include <vector>

#include "saltus/model/system.hpp"

namespace saltus {

/// The same leaves, wires and ports. The values count instead of those to which the system's own
/// inputs were fixed.
class GivenInputs final : public System {
 public:
  explicit GivenInputs(const System& system) : System(system.name()), system_(&system) {}

  std::string kind() const override { return system_->kind(); }
  const System& itself() const override { return system_->itself(); }
  std::vector<std::string> input_names() const override { return system_->input_names(); }
  std::vector<std::string> output_names() const override { return system_->output_names(); }
  void collect(Structure& out, const std::string& path) const override {
    system_->collect(out, path);
    collect_fixed(out);
  }
  bool fixes_input(int index) const override {
    return System::fixes_input(index) || system_->fixes_input(index);
  }
  LeafPort output_source(int index) const override { return system_->output_source(index); }
  LeafPort input_target(int index) const override { return system_->input_target(index); }

 private:
  const System* system_;
};

}  // namespace saltus
