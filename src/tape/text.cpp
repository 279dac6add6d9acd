// A tape as text for people.
#include "program.hpp"
#include "saltus/base/error.hpp"
#include "saltus/tape/tape.hpp"

namespace saltus::tape {

namespace detail {

namespace {

/// "x[3]", or "x[3:23]" for several entries, "x[3:43:2]" with their distance.
std::string entries(const std::string& array, const Place& place, std::size_t count) {
  if (count == 1 || place.stride == 0) return text(array, "[", place.offset, "]");
  const auto end = static_cast<Index>(place.offset) + static_cast<Index>(count) * place.stride;
  const std::string step = place.stride == 1 ? "" : text(":", place.stride);
  return text(array, "[", place.offset, ":", end, step, "]");
}

std::string show(const Place& place, std::size_t count, const std::string& before) {
  switch (place.kind) {
    case Kind::before:
      return before;
    case Kind::reg:
      return entries("r", place, count);
    case Kind::constant:
      return text(place.value);
    case Kind::x:
      return entries("x", place, count);
    case Kind::p:
      return entries("p", place, count);
    case Kind::z:
      return entries("z", place, count);
    case Kind::input:
      return entries(text("u[", place.port, "]"), place, count);
    case Kind::time:
      return "time";
    case Kind::mode:
      return "mode";
    case Kind::entry:
      return "entry";
    case Kind::out:
      return entries("out", place, count);
  }
  return "";
}

/// `before` is the place that the previous line has written.
std::string show(const Line& line, std::string& before) {
  std::string shown = show(line.from[0], line.count, before);
  for (std::size_t k = 1; k < line.operands(); ++k) {
    shown += ", " + show(line.from[k], line.count, before);
  }
  if (line.op != Op::constant) shown = text(name(line.op), "(", shown, ")");
  const bool forwards = line.from[0].kind == Kind::before && line.op == Op::constant;
  const std::string to = show(line.to, line.count, before);
  if (!forwards) before = to;
  return text(to, " = ", shown);
}

}  // namespace

}  // namespace detail

std::string Tape::to_string() const {
  std::string lines;
  std::string before;
  for (const detail::Line& line : program_->lines) lines += detail::show(line, before) + "\n";
  return lines;
}

}  // namespace saltus::tape
