// The variables and constants of a tape, and the entries of each array that it needs.
#include "variables.hpp"

#include <algorithm>

namespace saltus::tape::detail {

namespace {

Place input(Program& program, const Expression& e) {
  program.reads = program.reads | Reads::inputs;
  const auto found = std::ranges::find(program.inputs, e.port);
  const auto which = static_cast<std::size_t>(found - program.inputs.begin());
  if (found == program.inputs.end()) {
    program.inputs.push_back(e.port);
    program.widths.push_back(0);
  }
  program.widths[which] = std::max(program.widths[which], e.index + 1);
  return {.kind = Kind::input, .offset = static_cast<std::uint32_t>(e.index), .port = e.port};
}

}  // namespace

Place place_of_variable(Program& program, const Expression& e) {
  const auto entry_of = [&](Kind kind, Index& size, Reads reads) -> Place {
    size = std::max(size, e.index + 1);
    program.reads = program.reads | reads;
    return {kind, static_cast<std::uint32_t>(e.index)};
  };
  Index none = 0;
  switch (e.op) {
    case Op::constant:
      return {.kind = Kind::constant, .value = e.value};
    case Op::time:
      return entry_of(Kind::time, none, Reads::time);
    case Op::mode:
      return entry_of(Kind::mode, none, Reads::mode);
    case Op::entry:
      program.reads_entry = true;
      return {Kind::entry};
    case Op::continuous_state:
      return entry_of(Kind::x, program.x, Reads::continuous_state);
    case Op::discrete_state:
      return entry_of(Kind::z, program.z, Reads::discrete_state);
    case Op::parameter:
      return entry_of(Kind::p, program.p, Reads::parameters);
    case Op::input:
      return input(program, e);
    default:
      return {};
  }
}

}  // namespace saltus::tape::detail
