#include "llvm_loops.hpp"

#include <algorithm>
#include <iterator>

#include "saltus/base/error.hpp"

namespace saltus::tape::detail {

namespace {

/// The registers from the first to the last of a place.
struct Span {
  Index first, last;
};
Span span_of(const Place& place, std::size_t count) {
  const auto begin = static_cast<Index>(place.offset);
  const Index end = begin + place.stride * static_cast<Index>(count - 1);
  return {std::min(begin, end), std::max(begin, end)};
}

bool same(const Place& a, const Place& b) { return a.offset == b.offset && a.stride == b.stride; }

/// Whether both are registers of which some are the same.
bool overlap(const Place& a, std::size_t count_a, const Place& b, std::size_t count_b) {
  if (a.kind != Kind::reg || b.kind != Kind::reg) return false;
  const Span of_a = span_of(a, count_a), of_b = span_of(b, count_b);
  return of_a.first <= of_b.last && of_b.first <= of_a.last;
}

bool is_still(const Place& place) { return place.stride == 0; }

}  // namespace

/// A line shares the loop if number i of it reads only number i of earlier lines, and if number i
/// of earlier lines reads only number i of the registers that it writes.
bool LlvmLoops::shares(std::size_t first, const Line& line, std::size_t end) const {
  const std::size_t count = line.count;
  const auto apart = [&](const Place& a, const Place& b) {
    return !overlap(a, count, b, count) || (same(a, b) && !is_still(a));
  };
  for (std::size_t k = first; k < end; ++k) {
    const Line& earlier = program_.lines[k];
    if (!apart(line.to, earlier.to)) return false;
    for (std::size_t o = 0; o < line.operands(); ++o)
      if (!apart(line.from[o], earlier.to)) return false;
    for (std::size_t o = 0; o < earlier.operands(); ++o)
      if (!apart(earlier.from[o], line.to)) return false;
  }
  return true;
}

std::size_t LlvmLoops::end_of_loop(std::size_t first) const {
  std::size_t end = first + 1;
  while (end < program_.lines.size() && program_.lines[end].count == program_.lines[first].count &&
         shares(first, program_.lines[end], end)) {
    ++end;
  }
  return end;
}

/// Whether a line from `end` on may read what this line writes.
bool LlvmLoops::read_later(const Line& line, std::size_t end) const {
  if (line.to.kind == Kind::out) return true;
  for (std::size_t k = end; k < program_.lines.size(); ++k) {
    const Line& later = program_.lines[k];
    for (std::size_t o = 0; o < later.operands(); ++o)
      if (overlap(line.to, line.count, later.from[o], later.count)) return true;
  }
  return false;
}

std::string LlvmLoops::read(std::size_t k, std::size_t first, const Place& place,
                            const std::string& i) {
  for (std::size_t earlier = k; earlier-- > first;) {
    const Place& to = program_.lines[earlier].to;
    if (place.kind == Kind::reg && to.kind == Kind::reg && same(place, to))
      return values_[earlier - first];
  }
  return places_.read_in_loop(place, i, widest_vector);
}

void LlvmLoops::write_line(std::size_t k, std::size_t first, std::size_t end,
                           const std::string& i) {
  const Line& line = program_.lines[k];
  std::vector<std::string> operands;
  for (std::size_t o = 0; o < line.operands(); ++o) {
    operands.push_back(is_still(line.from[o]) ? still_[k - first][o]
                                              : read(k, first, line.from[o], i));
  }
  const bool copy = line.op == Op::constant;
  values_.push_back(copy ? operands[0] : text_.apply(line.op, operands, widest_vector));
  if (read_later(line, end)) places_.write_in_loop(line.to, i, widest_vector, values_.back());
}

std::pair<std::size_t, std::size_t> LlvmLoops::write(std::size_t first) {
  const std::size_t end = end_of_loop(first);
  const std::size_t count = program_.lines[first].count;
  const std::size_t done = count - count % static_cast<std::size_t>(widest_vector);
  still_.assign(end - first, {});
  for (std::size_t k = first; k < end; ++k) {
    const Line& line = program_.lines[k];
    for (std::size_t o = 0; o < line.operands(); ++o)
      if (is_still(line.from[o]))
        still_[k - first][o] = places_.read(line.from[o], 0, widest_vector);
  }
  const int number = text_.number();
  const std::string i = text("%i", number), loop = text("loop", number),
                    after = text("after", number);
  text_.add(text("  br label %", loop, "\n", loop, ":"));
  text_.add(text("  ", i, " = phi i64 [ 0, %", block_, " ], [ %n", number, ", %", loop, " ]"));
  values_.clear();
  for (std::size_t k = first; k < end; ++k) write_line(k, first, end, i);
  text_.add(text("  %n", number, " = add nuw nsw i64 ", i, ", ", widest_vector));
  text_.add(text("  %c", number, " = icmp ult i64 %n", number, ", ", done));
  text_.add(text("  br i1 %c", number, ", label %", loop, ", label %", after, "\n", after, ":"));
  block_ = after;
  return {end, done};
}

}  // namespace saltus::tape::detail
