// DiagramBuilder: add, connect, export_input, export_output, build.
#pragma once

#include <concepts>
#include <map>
#include <memory>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "saltus/model/diagram.hpp"

namespace saltus {

/// Collects blocks and wires; `build` uses it up. Throws ModelError for a name used twice, a port
/// of a block that was not added, an input with two sources, and, in `build`, for an input without
/// a source.
class DiagramBuilder {
 public:
  DiagramBuilder();
  ~DiagramBuilder();
  DiagramBuilder(DiagramBuilder&&) noexcept;
  DiagramBuilder& operator=(DiagramBuilder&&) noexcept;

  /// Makes a block in place. The returned reference remains valid in the diagram.
  template <std::derived_from<System> Block, class... Arguments>
  Block& add(Arguments&&... arguments) {
    auto block = std::make_shared<Block>(std::forward<Arguments>(arguments)...);
    Block& reference = *block;
    add(std::move(block));
    return reference;
  }

  /// Adds a block that exists already, for example a diagram:
  /// `add(std::make_shared<Diagram>(inner.build("inner")))`.
  void add(std::shared_ptr<const System> block);

  void connect(OutputPort from, InputPort to);

  /// Makes an input of a block an input of the diagram; returns its position there.
  int export_input(InputPort port, std::string name = {});

  /// Makes an output of a block an output of the diagram; returns its position there.
  int export_output(OutputPort port, std::string name = {});

  Diagram build(std::string name = "root");

 private:
  void require_unspent() const;
  void require_mine(const System* system) const;
  void require_free(InputPort to) const;
  [[noreturn]] void throw_two_sources(InputPort to) const;

  /// The source of an input, in words; empty if it has none.
  std::string source_of(InputPort to) const;
  std::string name_of(const System* system) const;
  static std::string port_name(InputPort port);

  Diagram diagram_{""};
  bool spent_ = false;
  // Look-up tables: with ten thousand blocks a search of the lists would be slow.
  std::unordered_map<const System*, std::size_t> mine_;           // place in children_
  std::unordered_set<std::string> names_;                         // of children_
  std::map<std::pair<const System*, int>, std::size_t> sources_;  // inputs: place in wires_
};

}  // namespace saltus
