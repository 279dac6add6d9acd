#include "llvm_places.hpp"

#include <algorithm>

#include "llvm_program.hpp"
#include "saltus/base/error.hpp"

namespace saltus::tape::detail {

namespace {

bool is_array(Kind kind) {
  return kind == Kind::x || kind == Kind::p || kind == Kind::z || kind == Kind::input;
}

}  // namespace

LlvmPlaces::LlvmPlaces(LlvmText& text, const Program& program)
    : text_(text), program_(program), memory_(program.registers, 0), registers_(program.registers) {
  for (const Line& line : program.lines) {
    if (line.count <= longest_written_out) continue;
    keep_in_memory(line.to, line.count);
    for (std::size_t k = 0; k < line.operands(); ++k)
      if (line.from[k].stride != 0) keep_in_memory(line.from[k], line.count);
  }
}

void LlvmPlaces::keep_in_memory(const Place& place, std::size_t count) {
  if (place.kind != Kind::reg) return;
  for (std::size_t i = 0; i < count; ++i) memory_[index(place, i)] = 1;
}

/// How many of these registers are in memory.
int LlvmPlaces::count_in_memory(const Place& place, std::size_t first, int width) const {
  int count = 0;
  for (int i = 0; i < width; ++i)
    count += in_memory(place, first + static_cast<std::size_t>(i)) ? 1 : 0;
  return count;
}

bool LlvmPlaces::in_memory(const Place& place, std::size_t i) const {
  return place.kind == Kind::reg && memory_[index(place, i)] != 0;
}

/// The array of an input is an argument of its own, loaded when it is first needed.
std::string LlvmPlaces::array_of(const Place& place) {
  switch (place.kind) {
    case Kind::x:
      return "%x";
    case Kind::p:
      return "%p";
    case Kind::z:
      return "%z";
    case Kind::reg:
      return "%memory";
    case Kind::out:
      return "%out";
    default: {
      const auto found = std::ranges::find(program_.inputs, place.port);
      return text("%u", found - program_.inputs.begin());
    }
  }
}

std::string LlvmPlaces::address(const Place& place, std::size_t i) {
  return text_.address(array_of(place), text(index(place, i)));
}

std::string LlvmPlaces::load_one(const Place& place, std::size_t i) {
  std::string& known = loaded_[{place.kind, place.port, index(place, i)}];
  if (known.empty()) known = text_.load(address(place, i), 1);
  return known;
}

std::string LlvmPlaces::one(const Place& place, std::size_t i) {
  if (is_array(place.kind)) return load_one(place, i);
  switch (place.kind) {
    case Kind::before:
      return before_;
    case Kind::constant:
      return constant_of(place.value, 1);
    case Kind::time:
      return "%time";
    case Kind::mode:
      return "%mode";
    case Kind::entry:
      return "%entry";
    default:
      break;
  }
  if (in_memory(place, i)) return text_.load(address(place, i), 1);
  const Lane& lane = lane_of(place, i);
  return text_.lane(lane.value, lane.width, lane.lane);
}

std::string LlvmPlaces::read(const Place& place, std::size_t first, int width) {
  if (width == 1) return one(place, first);
  if (place.kind == Kind::constant) return constant_of(place.value, width);
  if (place.stride == 0) return text_.splat(one(place, first), width);
  const int loaded = is_array(place.kind) ? width : count_in_memory(place, first, width);
  if (loaded == width && place.stride == 1) return text_.load(address(place, first), width);
  if (loaded == 0) return of_registers(place, first, width);
  std::vector<std::string> lanes;
  for (int i = 0; i < width; ++i) lanes.push_back(one(place, first + static_cast<std::size_t>(i)));
  return text_.gather(lanes);
}

std::string LlvmPlaces::of_registers(const Place& place, std::size_t first, int width) {
  std::vector<Lane> lanes;
  for (int i = 0; i < width; ++i)
    lanes.push_back(lane_of(place, first + static_cast<std::size_t>(i)));
  if (const auto whole = whole_vector(lanes)) return *whole;
  if (const auto joined = shuffled(lanes)) return *joined;
  std::vector<std::string> values;
  for (const Lane& lane : lanes) values.push_back(text_.lane(lane.value, lane.width, lane.lane));
  return text_.gather(values);
}

/// The vector that has these lanes in this order, if there is one.
std::optional<std::string> LlvmPlaces::whole_vector(const std::vector<Lane>& lanes) const {
  const int width = static_cast<int>(lanes.size());
  for (int i = 0; i < width; ++i) {
    const Lane& lane = lanes[static_cast<std::size_t>(i)];
    if (lane.width != width || lane.lane != i || lane.value != lanes[0].value) return {};
  }
  return lanes[0].value;
}

/// The lanes of one or two vectors of equal width, in another order.
std::optional<std::string> LlvmPlaces::shuffled(const std::vector<Lane>& lanes) {
  const std::string& a = lanes[0].value;
  const int width = lanes[0].width;
  if (width == 1) return {};
  std::string b, order;
  for (const Lane& lane : lanes) {
    if (lane.width != width) return {};
    if (lane.value != a && b.empty()) b = lane.value;
    if (lane.value != a && lane.value != b) return {};
    order += text(order.empty() ? "" : ", ", "i32 ", lane.lane + (lane.value == a ? 0 : width));
  }
  const std::string type = type_of(width);
  return text_.define(text("shufflevector ", type, " ", a, ", ", type, " ",
                           b.empty() ? "poison" : b, ", <", lanes.size(), " x i32> <", order, ">"));
}

void LlvmPlaces::write(const Place& place, std::size_t first, int width, const std::string& value) {
  if (width == 1) before_ = value;
  const int stored = place.kind == Kind::out ? width : count_in_memory(place, first, width);
  if (stored == width && (width == 1 || place.stride == 1))
    return text_.store(value, width, address(place, first));
  for (int i = 0; i < width; ++i) {
    const std::size_t n = first + static_cast<std::size_t>(i);
    if (place.kind == Kind::out || in_memory(place, n))
      text_.store(text_.lane(value, width, i), 1, address(place, n));
    else
      lane_of(place, n) = {value, width, i};
  }
}

std::string LlvmPlaces::address_in_loop(const Place& place, const std::string& i, int lane) {
  const std::string scaled =
      place.stride == 1 ? i : text_.define(text("mul i64 ", i, ", ", place.stride));
  const Index offset = static_cast<Index>(place.offset) + place.stride * lane;
  return text_.address(array_of(place), text_.define(text("add i64 ", scaled, ", ", offset)));
}

std::string LlvmPlaces::read_in_loop(const Place& place, const std::string& i, int width) {
  if (place.stride == 1) return text_.load(address_in_loop(place, i, 0), width);
  std::vector<std::string> lanes;
  for (int lane = 0; lane < width; ++lane)
    lanes.push_back(text_.load(address_in_loop(place, i, lane), 1));
  return text_.gather(lanes);
}

void LlvmPlaces::write_in_loop(const Place& place, const std::string& i, int width,
                               const std::string& value) {
  if (place.stride == 1) return text_.store(value, width, address_in_loop(place, i, 0));
  for (int lane = 0; lane < width; ++lane)
    text_.store(text_.lane(value, width, lane), 1, address_in_loop(place, i, lane));
}

}  // namespace saltus::tape::detail
