// SharedSystem: a system that C++ made, such as a system of the shelf, as a Python object.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "saltus/model/detail/names.hpp"
#include "saltus/model/diagram.hpp"

namespace saltus::python {

/// A reference to a system from which Python makes a SharedSystem. Several references may mean one
/// system.
struct SystemHandle {
  std::shared_ptr<const System> system;
  bool inner = false;  ///< a block of a diagram
};

/// Keeps a system alive and represents it to the engine: the same leaves, ports and contexts. It is
/// a separate System only because a Python object must own a C++ object.
class SharedSystem final : public System {
 public:
  explicit SharedSystem(const SystemHandle& handle)
      : System(handle.system->name()), system_(handle.system), inner_(handle.inner) {}

  const System& shared() const { return *system_; }
  /// A block of a diagram by name. Throws ModelError with the known names if there is none.
  SystemHandle block(std::string_view name) const;
  /// The names of the blocks of a diagram; empty for a leaf.
  std::vector<std::string> block_names() const;

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
  /// Whether it is a block inside of a diagram, which knows the sources of its inputs.
  bool is_inner() const { return inner_; }
  LeafPort output_source(int index) const override { return system_->output_source(index); }
  LeafPort input_target(int index) const override { return system_->input_target(index); }
  std::vector<std::string> event_output_names() const override {
    return system_->event_output_names();
  }
  std::vector<std::string> event_input_names() const override {
    return system_->event_input_names();
  }
  LeafEvent event_source(int index) const override { return system_->event_source(index); }
  LeafEvent event_target(int index) const override { return system_->event_target(index); }

 private:
  std::shared_ptr<const System> system_;
  bool inner_;
};

inline SystemHandle SharedSystem::block(std::string_view name) const {
  const auto* diagram = dynamic_cast<const Diagram*>(system_.get());
  if (diagram == nullptr)
    throw ModelError(text("block '", system_->name(), "' is no diagram: it has no blocks in it"));
  return {{system_, &(*diagram)[name]}, true};  // lives as long as the diagram
}

inline std::vector<std::string> SharedSystem::block_names() const {
  const auto* diagram = dynamic_cast<const Diagram*>(system_.get());
  return diagram == nullptr ? std::vector<std::string>{} : detail::names_of(diagram->children());
}

}  // namespace saltus::python
