// What the tests of the block library share: one block between constants, looked at through plan
// and machine.
#pragma once

#include <string>
#include <vector>

#include "saltus/library/library.hpp"
#include "saltus/model/diagram_builder.hpp"
#include "saltus/plan/detail/machine.hpp"
#include "support/catch.hpp"

namespace library_test {

using saltus::Value;

/// The message of the ModelError that `make` throws.
template <class Make>
std::string model_error(Make make) {
  try {
    make();
  } catch (const saltus::ModelError& error) {
    return error.what();
  }
  return "no ModelError";
}

inline bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// A block called "block" whose inputs are Constants, in a diagram of its own. All its outputs are
/// recorded.
template <class Block>
class Bench {
 public:
  template <class... Arguments>
  explicit Bench(const std::vector<Value>& inputs, Arguments&&... arguments)
      : diagram_(build(inputs, std::forward<Arguments>(arguments)...)),
        plan_(saltus::compile(diagram_, taps(diagram_))),
        machine_(plan_) {}

  /// The values of output k at time t [s].
  std::vector<double> output(int k = 0, double t = 0.0) {
    machine_.load(diagram_.create_context(t));
    machine_.evaluate_instant(t);
    const auto values = machine_.evaluate_taps(t, machine_.x.data());
    const saltus::Place& place = node(k).place;
    const double* first = values(place);
    return {first, first + place.size};
  }
  const saltus::Node& node(int k = 0) const {
    return plan_->node(plan_->taps[static_cast<std::size_t>(k)].node);
  }
  const saltus::Plan& plan() const { return *plan_; }

 private:
  template <class... Arguments>
  static saltus::Diagram build(const std::vector<Value>& inputs, Arguments&&... arguments) {
    saltus::DiagramBuilder builder;
    auto& block = builder.add<Block>("block", std::forward<Arguments>(arguments)...);
    for (std::size_t i = 0; i < inputs.size(); ++i) {
      auto& source = builder.add<saltus::Constant>(saltus::text("u", i), inputs[i]);
      builder.connect(source.output(), block.input(static_cast<int>(i)));
    }
    return builder.build();
  }
  static saltus::RecordedSignals taps(const saltus::Diagram& diagram) {
    const saltus::System& block = diagram["block"];
    saltus::RecordedSignals signals;
    for (int k = 0; k < static_cast<int>(block.output_names().size()); ++k) {
      signals.emplace_back(saltus::text("y", k), block.output(k));
    }
    return signals;
  }

  saltus::Diagram diagram_;
  std::shared_ptr<const saltus::Plan> plan_;
  saltus::Machine machine_;
};

using Numbers = std::vector<double>;

}  // namespace library_test
