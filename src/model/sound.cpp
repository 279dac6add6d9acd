// The checks of layouts and continuations that come from outside, and the comparison of layouts.
#include "saltus/model/detail/sound.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "saltus/base/list.hpp"

namespace saltus::detail {

namespace {

/// Checks a place among the values of one kind, and moves `next` to the place after it. The sum
/// cannot overflow, because both numbers are at most `most`.
constexpr Index most = std::numeric_limits<Index>::max() / 4;

void require_place(Index offset, Index size, Index& next, const std::string& of) {
  if (offset != next || size < 0 || size > most || next > most) {
    throw ModelError(text("the layout of a context is damaged: ", of, " has ", size,
                          " values from place ", offset, ", expected them from place ", next));
  }
  next += size;
}

void require(bool sound, std::string_view what) {
  if (!sound) throw ModelError(text("the continuation of a context is damaged: ", what));
}

template <class Numbers>
bool all_finite(const Numbers& numbers) {
  return std::ranges::all_of(numbers, [](double number) { return std::isfinite(number); });
}

void require_sound(const Continuation::Guard& guard) {
  require(guard.side >= -1 && guard.side <= 1,
          text("a guard on side ", guard.side, "; expected -1, 0 or 1"));
  // 2 means that the guard fired because a block lifted off.
  require(guard.from >= -1 && guard.from <= 2,
          text("a guard that came from ", guard.from, "; expected -1 to 2"));
  require(guard.error >= 0.0, text("a guard with error ", guard.error));
  require(!std::isnan(guard.base), text("a guard with base ", guard.base));
}

void require_sound(const Continuation::Firings& firings) {
  require(firings.times.size() <= 4,
          text(firings.times.size(), " times of firings; expected at most 4"));
  require(all_finite(firings.times) && all_finite(firings.after), "a firing that is not finite");
  require(std::isfinite(firings.longest) && firings.longest >= 0.0,
          text("a longest gap of ", firings.longest, " s"));
  require(std::ranges::is_sorted(firings.times, std::greater<>()),
          "times of firings that are not from late to early");
}

void require_sound(const Continuation::Leaving& leaving, std::size_t guards) {
  require(leaving.guard >= 0 && static_cast<std::size_t>(leaving.guard) < guards,
          text("guard ", leaving.guard, " leaves zero, of ", guards));
  require(std::isfinite(leaving.armed_at) && std::isfinite(leaving.clear_at),
          text("guard ", leaving.guard, " leaves zero from t = ", leaving.armed_at, " s to ",
               leaving.clear_at, " s"));
}

void require_sound(const Continuation::Contact& contact, std::size_t guards) {
  require(contact.guard >= 0 && static_cast<std::size_t>(contact.guard) < guards,
          text("a contact of guard ", contact.guard, ", of ", guards));
  require(contact.look_ahead >= 0.0 && std::isfinite(contact.look_ahead),
          text("a contact with look ahead ", contact.look_ahead));
}

void require_count(std::int64_t count) {
  require(count >= 0 && count <= std::numeric_limits<std::int64_t>::max() / 2,
          text("a count of ", count));
}

std::string counts(const Layout::Leaf& leaf) {
  return text(leaf.nx, " continuous and ", leaf.nz, " discrete states, ", leaf.np, " parameters");
}

std::string names(const Layout::Leaf& leaf) {
  std::string all;
  for (const Layout::Parameter& parameter : leaf.parameters) {
    const std::string size = parameter.size == 1 ? "" : text("[", parameter.size, "]");
    all += text(all.empty() ? "'" : ", '", parameter.name, size, "'");
  }
  return all.empty() ? "none" : all;
}

bool same_parameters(const Layout::Leaf& a, const Layout::Leaf& b) {
  const auto same = [](const Layout::Parameter& one, const Layout::Parameter& other) {
    return one.name == other.name && one.size == other.size;
  };
  return std::ranges::equal(a.parameters, b.parameters, same);
}

}  // namespace

void require_sound(const Layout& layout) {
  Index x = 0, z = 0, p = 0;
  for (const Layout::Leaf& leaf : layout.leaves) {
    const std::string of = text("block '", leaf.path, "'");
    require_place(leaf.x, leaf.nx, x, of);
    require_place(leaf.z, leaf.nz, z, of);
    require_place(leaf.p, leaf.np, p, of);
    if (!leaf.states.empty() && std::ssize(leaf.states) != leaf.nx)
      throw ModelError(text("the layout of a context is damaged: ", of, " has ", leaf.nx,
                            " continuous states, and names of ", leaf.states.size()));
    Index within = 0;
    for (const Layout::Parameter& parameter : leaf.parameters)
      require_place(parameter.offset, parameter.size, within,
                    text("parameter '", parameter.name, "' of ", of));
    if (within == leaf.np) continue;
    throw ModelError(text("the layout of a context is damaged: ", of, " has ", leaf.np,
                          " parameters, its names are of ", within));
  }
  for (const Layout::Range& range : layout.systems) {
    if (range.first <= range.last && range.last <= layout.leaves.size()) continue;
    throw ModelError(text("the layout of a context is damaged: system '", range.path,
                          "' has blocks ", range.first, " to ", range.last, " of ",
                          layout.leaves.size()));
  }
}

void require_sound(const Continuation& c) {
  require(c.jump >= 0 && c.jump <= std::numeric_limits<int>::max() / 2,
          text("jump ", c.jump, "; expected a count"));
  for (const double truth : c.relations)
    require(truth == 0.0 || truth == 1.0, text("a relation that is ", truth));
  for (const Continuation::Guard& guard : c.guards) require_sound(guard);
  for (const Continuation::Firings& firings : c.firings) require_sound(firings);
  for (const Continuation::Leaving& leaving : c.leaving) require_sound(leaving, c.guards.size());
  for (const Continuation::Contact& contact : c.contacts) require_sound(contact, c.guards.size());
  for (const int edge : c.edges) require(edge == 0 || edge == 1, text("an edge that is ", edge));
  for (const std::int64_t count : c.counts) require_count(count);
  for (const Continuation& island : c.islands) {
    require(island.islands.empty(), "an island with islands");
    require_sound(island);
  }
}

namespace {

bool increases_within(const std::vector<int>& entries, Index size) {
  const bool sorted = std::ranges::adjacent_find(entries, std::greater_equal<>()) == entries.end();
  return entries.empty() || (sorted && entries.front() >= 0 && entries.back() < size);
}

void require_sound(const FrozenValues& values, const Layout::Leaf& leaf) {
  require(increases_within(values.continuous_entries, leaf.nx) &&
              increases_within(values.discrete_entries, leaf.nz),
          text("an execution that writes states which block '", leaf.path, "' does not have"));
  require(values.continuous.size() == values.continuous_entries.size() &&
              values.discrete.size() == values.discrete_entries.size(),
          text("an execution of block '", leaf.path, "' with more or fewer values than states"));
  require(all_finite(values.continuous) && all_finite(values.discrete),
          text("an execution of block '", leaf.path, "' with a value that is not finite"));
}

void require_sound(const std::vector<PendingDelivery>& deliveries, const Layout& layout) {
  for (const PendingDelivery& one : deliveries) {
    require(
        one.leaf >= 0 && one.leaf < std::ssize(layout.leaves) && one.event >= 0 && one.entry >= 0,
        text("a delivery of block ", one.leaf, " of ", layout.leaves.size()));
    require(std::isfinite(one.delay) && one.delay > 0.0,
            text("a delivery with a delay of ", one.delay, " s"));
    require(std::isfinite(one.due), text("a delivery that is due at ", one.due, " s"));
  }
  require(std::ranges::is_sorted(deliveries, {}, &PendingDelivery::due),
          "deliveries that are not in the order in which they are due");
}

}  // namespace

void require_sound(const PendingExecutions& pending, const Layout& layout) {
  constexpr std::int64_t many = std::numeric_limits<std::int64_t>::max() / 2;
  require(pending.scheduled >= 0 && pending.scheduled <= many && pending.draws >= 0 &&
              pending.draws <= many,
          text(pending.scheduled, " executions and ", pending.draws, " draws; expected counts"));
  const PendingExecution* before = nullptr;
  for (const PendingExecution& one : pending.all) {
    require(
        one.leaf >= 0 && one.leaf < std::ssize(layout.leaves) && one.event >= 0 && one.entry >= 0,
        text("an execution of block ", one.leaf, " of ", layout.leaves.size()));
    require(std::isfinite(one.due), text("an execution that is due at ", one.due, " s"));
    require(one.number >= 0 && one.number < pending.scheduled,
            text("execution ", one.number, " of ", pending.scheduled));
    require(before == nullptr || before->due < one.due ||
                (before->due == one.due && before->number < one.number),
            "executions that are not in the order in which they are due");
    require_sound(one.values, nth(layout.leaves, one.leaf));
    before = &one;
  }
  require_sound(pending.deliveries, layout);
}

std::string difference(const Layout& expected, const Layout& found, bool paths) {
  const std::size_t n = expected.leaves.size();
  if (found.leaves.size() != n) return text("expected ", n, " blocks, found ", found.leaves.size());
  for (std::size_t i = 0; i < n; ++i) {
    const Layout::Leaf &a = expected.leaves[i], &b = found.leaves[i];
    if ((paths || n > 1) && a.path != b.path)
      return text("expected block '", a.path, "', found '", b.path, "'");
    if (a.nx != b.nx || a.nz != b.nz || a.np != b.np)
      return text("block '", a.path, "': expected ", counts(a), ", found ", counts(b));
    if (!same_parameters(a, b))
      return text("block '", a.path, "': expected the parameters ", names(a), ", found ", names(b));
  }
  return {};
}

}  // namespace saltus::detail
