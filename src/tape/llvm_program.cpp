#include "llvm_program.hpp"

#include <array>

#include "llvm_loops.hpp"
#include "llvm_places.hpp"
#include "saltus/base/error.hpp"

namespace saltus::tape::detail {

namespace {

/// Writes one line out, a few lanes at a time.
void write_out(LlvmText& text, LlvmPlaces& places, const Line& line, std::size_t first) {
  for (std::size_t i = first; i < line.count;) {
    int width = widest_vector;
    while (static_cast<std::size_t>(width) > line.count - i) width /= 2;
    std::vector<std::string> operands;
    for (std::size_t k = 0; k < line.operands(); ++k)
      operands.push_back(places.read(line.from[k], i, width));
    const bool copy = line.op == Op::constant;
    places.write(line.to, i, width, copy ? operands[0] : text.apply(line.op, operands, width));
    i += static_cast<std::size_t>(width);
  }
}

}  // namespace

std::string llvm_function(const Program& program, const std::string& name,
                          std::set<std::string>& declarations) {
  LlvmText body;
  body.add(
      text("define void @", name,
           "(ptr readonly %x, ptr readonly %p, ptr readonly %z, ptr readonly %u, double %time, "
           "double %mode, double %entry, ptr noalias %memory, ptr noalias %out) nounwind {"));
  body.add("begin:");
  for (std::size_t k = 0; k < program.inputs.size(); ++k) {
    body.add(text("  %a", k, " = getelementptr inbounds ptr, ptr %u, i64 ", k));
    body.add(text("  %u", k, " = load ptr, ptr %a", k, ", align 8"));
  }
  LlvmPlaces places(body, program);
  LlvmLoops loops(body, places, program);
  for (std::size_t k = 0; k < program.lines.size();) {
    if (program.lines[k].count > longest_written_out) {
      const auto [next, rest] = loops.write(k);
      for (; k < next; ++k) write_out(body, places, program.lines[k], rest);
    } else {
      write_out(body, places, program.lines[k++], 0);
    }
  }
  body.add("  ret void");
  body.add("}");
  declarations.insert(body.declarations().begin(), body.declarations().end());
  return body.body();
}

}  // namespace saltus::tape::detail
