#include "shared.hpp"

#include "kernels.hpp"
#include "saltus/base/error.hpp"

namespace saltus::tape::series {

namespace {

/// The rows in the order of a table, after the numbers of the instruction itself.
constexpr std::array rows_in_table{&Instruction::to, &Instruction::to_second, &Instruction::a,
                                   &Instruction::b,  &Instruction::da,        &Instruction::db};

/// An instruction each of whose rows is an entry of a table.
WideInstruction by_table(const Instruction& i) {
  WideInstruction made;
  made.kernel = i.kernel, made.factor = i.factor;
  Index entry = 1;
  for (Index Instruction::*const row : rows_in_table) made.*row = SeriesWriter::in_table * entry++;
  for (Index& lane : made.a_of_lane) lane = SeriesWriter::in_table * entry++;
  return made;
}

}  // namespace

bool SharedRecurrences::takes(const Instruction& i) {
  return !i.kernel->reads.linear && i.kernel != &choice;
}

std::string SharedRecurrences::table(int width, const Instruction& i, Index own) {
  const auto [known, is_new] = tables_.try_emplace(&i);
  if (!is_new) return known->second;
  std::string entries = text("i64 ", own);
  for (Index Instruction::*const row : rows_in_table) entries += text(", i64 ", i.*row);
  int count = 1 + static_cast<int>(rows_in_table.size());
  if (width > 1) {
    for (const Index lane : static_cast<const WideInstruction&>(i).a_of_lane)
      entries += text(", i64 ", lane), ++count;
  }
  known->second = text("@", name_, "_table_", tables_.size());
  text_ +=
      text(known->second, " = private unnamed_addr constant [", count, " x i64] [", entries, "]\n");
  return known->second;
}

std::string SharedRecurrences::function(int width, const Instruction& i, WriteHandler handler,
                                        Index k) {
  const auto [known, is_new] = functions_.try_emplace({handler, k, i.factor});
  if (!is_new) return known->second;
  known->second = text("@", name_, "_order_", functions_.size());
  SeriesWriter body(program_);
  body.width = width, body.by_table = true;
  handler(body, by_table(i), 0, k);
  text_ += text("define private void ", known->second,
                "(ptr %rows, ptr noalias %own, ptr noalias readonly %table) nounwind noinline "
                "optnone {\nbegin:\n",
                body.text().body(), "  ret void\n}\n");
  return known->second;
}

void SharedRecurrences::call(SeriesWriter& writer, const Instruction& i, Index own,
                             WriteHandler handler, Index k) {
  if (handler == nullptr) return;
  writer.text().add(text("  call void ", function(writer.width, i, handler, k),
                         "(ptr %rows, ptr %own, ptr ", table(writer.width, i, own), ")"));
}

}  // namespace saltus::tape::series
