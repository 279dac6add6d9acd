// System: what a leaf and a diagram share. Structure only: it never changes after construction.
#pragma once

#include <atomic>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "saltus/model/context.hpp"
#include "saltus/model/port.hpp"

namespace saltus {

/// A port of a leaf, after all nesting is resolved.
struct LeafPort {
  const LeafSystem* leaf = nullptr;
  int index = 0;
};

/// A system with its nesting resolved: leaves with their paths, and wires from leaf to leaf.
struct Structure {
  struct Leaf {
    const LeafSystem* system;
    std::string path;
  };
  struct Wire {
    LeafPort from, to;
  };
  std::vector<Leaf> leaves;
  std::vector<Wire> wires;
  std::vector<Layout::Range> systems;
};

class System {
 public:
  explicit System(std::string name) : name_(std::move(name)), id_{next_id()} {}
  virtual ~System() = default;
  System(const System&) = delete;
  System& operator=(const System&) = delete;
  System(System&&) = default;
  System& operator=(System&&) = default;

  const std::string& name() const noexcept { return name_; }
  SystemId system_id() const noexcept { return id_; }

  /// What sort of block it is, for people: the name of its class.
  virtual std::string kind() const;
  /// The system that this one stands for: itself, unless it is a handle on another.
  virtual const System& itself() const { return *this; }

  virtual std::vector<std::string> input_names() const = 0;
  virtual std::vector<std::string> output_names() const = 0;

  /// Ports by position or by name; a ModelError lists the names there are.
  InputPort input(int index = 0) const { return {this, checked(index, input_names(), "input")}; }
  InputPort input(std::string_view port) const {
    return {this, find(port, input_names(), "input")};
  }
  OutputPort output(int index = 0) const {
    return {this, checked(index, output_names(), "output")};
  }
  OutputPort output(std::string_view port) const {
    return {this, find(port, output_names(), "output")};
  }

  /// The default values of every block, at time t [s].
  Context create_context(double t = 0.0) const;

  /// Appends this system's leaves and wires; `path` is the name under which it is known.
  virtual void collect(Structure& out, const std::string& path) const = 0;
  /// The leaf output behind an output port.
  virtual LeafPort output_source(int index) const = 0;
  /// The leaf input behind an input port.
  virtual LeafPort input_target(int index) const = 0;

 private:
  static int next_id() {
    static std::atomic<int> counter{0};
    return ++counter;
  }
  int checked(int index, const std::vector<std::string>& names, std::string_view kind) const {
    if (index >= 0 && index < static_cast<int>(names.size())) return index;
    throw ModelError(text("block '", name_, "' has no ", kind, " ", index, ": it has ",
                          names.size(),
                          names.empty() ? std::string() : text(" (", quoted_list(names), ")")));
  }
  int find(std::string_view port, const std::vector<std::string>& names,
           std::string_view kind) const {
    const auto found = std::ranges::find(names, port);
    if (found != names.end()) return static_cast<int>(found - names.begin());
    throw ModelError(
        text("block '", name_, "' has no ", kind, " '", port, "'", known_names(port, names)));
  }

  std::string name_;
  SystemId id_;
};

/// All of a system, nesting resolved. The root's own name is not part of the paths of its blocks.
inline Structure structure_of(const System& root) {
  Structure structure;
  root.collect(structure, "");
  return structure;
}

}  // namespace saltus
