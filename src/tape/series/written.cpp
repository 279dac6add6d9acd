#include "written.hpp"

#include <algorithm>

#include "saltus/base/error.hpp"

namespace saltus::tape::series {

namespace {

const char* name_of(Memory memory) {
  switch (memory) {
    case Memory::values:
      return "%values";
    case Memory::rows:
      return "%rows";
    case Memory::own:
      return "%own";
    default:
      return "%x";
  }
}

SeriesWriter& writer_of(const Written& a, const Written& b) {
  return a.writer != nullptr ? *a.writer : *b.writer;
}

}  // namespace

Written operator+(const Written& a, const Written& b) {
  if (a.writer == nullptr && b.writer == nullptr) return a;
  return writer_of(a, b).binary("fadd", a, b);
}
Written operator-(const Written& a, const Written& b) {
  if (a.writer == nullptr && b.writer == nullptr) return a;
  return writer_of(a, b).binary("fsub", a, b);
}
Written operator*(const Written& a, const Written& b) {
  if (a.writer == nullptr && b.writer == nullptr) return a;
  return writer_of(a, b).binary("fmul", a, b);
}
Written operator*(double a, const Written& b) {
  if (b.writer == nullptr) return b;
  return b.writer->binary("fmul", b.writer->constant(a, b.lanes), b);
}
Written operator*(const Written& a, double b) {
  if (a.writer == nullptr) return a;
  return a.writer->binary("fmul", a, a.writer->constant(b, a.lanes));
}
Written operator/(double a, const Written& b) {
  return b.writer->binary("fdiv", b.writer->constant(a, b.lanes), b);
}

Written SeriesWriter::constant(double value, int count) {
  return {this, detail::constant_of(value, count), count};
}

std::string SeriesWriter::in_lanes(const Written& a, int count) {
  if (a.writer == nullptr) return detail::constant_of(0.0, count);
  return a.lanes == count ? a.value : text_.splat(a.value, count);
}

Written SeriesWriter::binary(const char* how, Written a, Written b) {
  const int count = std::max(a.lanes, b.lanes);
  const std::string left = in_lanes(a, count), right = in_lanes(b, count);
  const char* const type = count == 1 ? " double " : " <4 x double> ";
  return {this, text_.define(saltus::text(how, type, left, ", ", right)), count};
}

Written SeriesWriter::apply(Op op, std::span<const Written> operands) {
  std::vector<std::string> values;
  for (const Written& operand : operands) values.push_back(in_lanes(operand, 1));
  return {this, text_.apply(op, values, 1), 1};
}

std::string SeriesWriter::begin_in_table(Memory memory, Index entry) {
  const auto [known, is_new] = begins_.try_emplace(entry);
  if (!is_new) return known->second;
  const std::string place =
      text_.define(saltus::text("getelementptr inbounds i64, ptr %table, i64 ", entry));
  const std::string offset = text_.define(saltus::text("load i64, ptr ", place, ", align 8"));
  return known->second = text_.address(name_of(memory), offset);
}

std::string SeriesWriter::address(Memory memory, Index offset) {
  if (by_table) {
    const Index rest = offset % in_table;
    const std::string begin = begin_in_table(memory, offset / in_table);
    if (rest == 0) return begin;
    const auto [known, is_new] = addresses_.try_emplace(key(memory, offset));
    if (is_new) known->second = text_.address(begin, std::to_string(rest));
    return known->second;
  }
  if (offset == 0) return name_of(memory);
  const auto [known, is_new] = addresses_.try_emplace(key(memory, offset));
  if (is_new) known->second = text_.address(name_of(memory), std::to_string(offset));
  return known->second;
}

/// The number that was stored at this place, alone or as a lane of several.
const SeriesWriter::Stored* SeriesWriter::whole(Memory memory, Index offset, int count) const {
  const auto first = stored_.find(key(memory, offset));
  if (first == stored_.end()) return nullptr;
  const Stored& stored = first->second;
  if (count == 1) return &stored;
  if (stored.lanes != count) return nullptr;
  for (int l = 0; l < count; ++l) {
    const auto found = stored_.find(key(memory, offset + l));
    if (found == stored_.end() || found->second.lane != l || found->second.value != stored.value)
      return nullptr;
  }
  return &stored;
}

Written SeriesWriter::read(Memory memory, Index offset, int count) {
  if (const Stored* const stored = whole(memory, offset, count); stored != nullptr) {
    if (stored->lanes == count) return {this, stored->value, count};
    return {this, text_.lane(stored->value, stored->lanes, stored->lane), 1};
  }
  return {this, text_.load(address(memory, offset), count), count};
}

void SeriesWriter::store(Memory memory, Index offset, const Written& a) {
  const std::string value = in_lanes(a, a.lanes);
  for (int l = 0; l < a.lanes; ++l) stored_[key(memory, offset + l)] = {value, a.lanes, l};
  text_.store(value, a.lanes, address(memory, offset));
}

/// Gathers numbers by as few instructions as their places allow; they may be in order already.
Written SeriesWriter::gathered(Memory memory, const std::array<Index, lanes>& offsets) {
  bool in_order = true, same = true;
  for (std::size_t l = 1; l < offsets.size(); ++l) {
    in_order = in_order && offsets[l] == offsets[0] + static_cast<Index>(l);
    same = same && offsets[l] == offsets[0];
  }
  const bool loose = stored_.contains(key(memory, offsets[0])) &&
                     whole(memory, offsets[0], 4) == nullptr;  // a load would wait for the stores
  if (in_order && !loose) return read(memory, offsets[0], 4);
  if (same) return {this, text_.splat(read(memory, offsets[0], 1).value, 4), 4};
  std::array<Written, 4> all;
  for (std::size_t l = 0; l < 4; ++l) all[l] = read(memory, offsets[l], 1);
  return joined(all);
}

Written SeriesWriter::joined(const std::array<Written, lanes>& all) {
  std::array<std::string, 4> values;
  for (std::size_t l = 0; l < 4; ++l) values[l] = in_lanes(all[l], 1);
  return {this, text_.gather(values), 4};
}

Written SeriesWriter::value(Index number) {
  if (program_.is_constant[static_cast<std::size_t>(number)] != 0)
    return constant(program_.constants[static_cast<std::size_t>(number)]);
  return read(Memory::values, number, 1);
}

void SeriesWriter::pause() {
  const int label = text_.number();
  text_.add(saltus::text("  br label %b", label, "\nb", label, ":"));
  stored_.clear();
  addresses_.clear();
}

void SeriesWriter::leave_if_zero(const Written& a) {
  for (int l = 0; l < a.lanes; ++l) {
    const std::string lane = text_.lane(a.value, a.lanes, l);
    const std::string zero =
        text_.define(saltus::text("fcmp oeq double ", lane, ", ", detail::constant_of(0.0, 1)));
    const int label = text_.number();
    text_.add(saltus::text("  br i1 ", zero, ", label %leave, label %b", label, "\nb", label, ":"));
  }
}

}  // namespace saltus::tape::series
