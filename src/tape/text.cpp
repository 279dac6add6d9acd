// A tape as people read it.
#include "program.hpp"
#include "saltus/base/error.hpp"
#include "saltus/tape/tape.hpp"

namespace saltus::tape {

namespace detail {

namespace {

std::string show(const Program& program, Address address) {
  switch (address.base) {
    case registers:
      return text("r", address.offset);
    case out:
      return text("out[", address.offset, "]");
    case constants:
      return text(program.constants[address.offset]);
    case x:
      return text("x[", address.offset, "]");
    case z:
      return text("z[", address.offset, "]");
    case p:
      return text("p[", address.offset, "]");
    case scalars:
      return address.offset == time ? "time" : address.offset == mode ? "mode" : "entry";
    default:
      return text("u[", program.inputs[address.base - inputs], "][", address.offset, "]");
  }
}

std::string show(const Program& program, const Instruction& i) {
  std::string line = text(show(program, i.to), " = ");
  const int count = operand_count(i.op);
  if (count == 0) return line + show(program, i.from[0]);
  line += text(name(i.op), "(", show(program, i.from[0]));
  for (std::size_t k = 1; k < static_cast<std::size_t>(count); ++k) {
    line += text(", ", show(program, i.from[k]));
  }
  return line + ")";
}

}  // namespace

}  // namespace detail

std::string Tape::to_string() const {
  std::string lines;
  for (const detail::Instruction& i : program_->instructions) {
    lines += detail::show(*program_, i) + "\n";
  }
  return lines;
}

}  // namespace saltus::tape
