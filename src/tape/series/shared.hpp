// SharedRecurrences: functions of LLVM that alike instructions of a long series share.
#pragma once

#include <map>
#include <string>
#include <tuple>

#include "wide.hpp"
#include "written.hpp"

namespace saltus::tape::series {

/// Writes a call in place of a recurrence, with a table of the places of its rows. So the text
/// grows with the number of instructions, not with the number of their products.
class SharedRecurrences {
 public:
  SharedRecurrences(const Program& program, std::string name)
      : program_(program), name_(std::move(name)) {}

  /// Whether the recurrence is long enough to be worth a function.
  static bool takes(const Instruction& i);
  /// Writes the call of `handler`, which is the handler `earlier` or the handler of an order.
  void call(SeriesWriter& writer, const Instruction& i, Index own, WriteHandler handler, Index k);
  /// The functions and the tables.
  const std::string& functions() const { return text_; }

 private:
  std::string function(int width, const Instruction& i, WriteHandler handler, Index k);
  std::string table(int width, const Instruction& i, Index own);

  const Program& program_;
  std::string name_, text_;
  std::map<std::tuple<WriteHandler, Index, double>, std::string> functions_;
  std::map<const Instruction*, std::string> tables_;
};

}  // namespace saltus::tape::series
