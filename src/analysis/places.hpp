// Place: where a name is, in a context or among the open inputs of a system.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "saltus/model/context_entry.hpp"
#include "saltus/model/system.hpp"

namespace saltus {

/// A number that a system reads.
struct AnalysisPlace {
  std::string name;  ///< as the user spells it
  /// Of a state or a parameter; empty for an open input.
  std::optional<ContextEntry> entry = {};
  int port = -1;                        ///< of an open input
  std::optional<Index> of_vector = {};  ///< the entry of an open input that is a vector

  bool is_input() const { return !entry; }
  bool is_state() const { return entry && entry->kind == ContextEntry::Kind::continuous_state; }
  bool is_parameter() const { return entry && entry->kind == ContextEntry::Kind::parameter; }
  /// Whether two names mean one number: "x[0]" and "height".
  bool same(const AnalysisPlace& other) const;
};

/// The number of an open input with this name, or -1.
int open_port(const System& system, std::string_view name);

/// The place of a name. Throws ModelError for an unknown one, and for one of several numbers; it
/// names the nearest.
AnalysisPlace place_of(const std::string& where, const System& system, const Context& context,
                       const std::string& name);
/// The values of the context with a name. Throws ModelError for an unknown one, with the nearest.
ContextEntry entry_in(const std::string& where, const Context& context, const std::string& name);
/// The same of a number of the context: a parameter, or a continuous or discrete start value. A mode
/// is refused.
ContextEntry number_in(const std::string& where, const Context& context, const std::string& name);
/// The value of an entry in a context.
double value_in(const Context& context, const ContextEntry& entry);
/// The context with this number there.
Context with_number(const Context& context, const ContextEntry& entry, double value,
                    const std::string& name);

/// The names of all continuous states, in the order of the context: "x[0]", "plant.angle".
std::vector<std::string> continuous_names(const Context& context);
/// Of all discrete states: "hold.z[0]".
std::vector<std::string> discrete_names(const Context& context);

}  // namespace saltus
