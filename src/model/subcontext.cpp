// context[id] and with_subcontext: take one system's values out of a context and write them back.
#include "saltus/model/detail/subcontext.hpp"

#include <algorithm>

#include "saltus/model/computed_parameter.hpp"
#include "saltus/model/detail/sound.hpp"

namespace saltus {

namespace detail {

std::pair<Index, Index> extent(const Layout& layout, const Layout::Range& range,
                               Index Layout::Leaf::*offset, Index Layout::Leaf::*size) {
  if (range.first == range.last) return {0, 0};
  Index count = 0;
  for (std::size_t i = range.first; i < range.last; ++i) count += layout.leaves[i].*size;
  return {layout.leaves[range.first].*offset, count};
}

namespace {

/// The parameters that a part computes from its own. The part has p[first .. last) of the whole.
std::shared_ptr<const ComputedParameters> part_of(
    const std::shared_ptr<const ComputedParameters>& whole, Index first, Index last) {
  if (!whole) return {};
  auto part = std::make_shared<ComputedParameters>();
  const auto inside = [&](Index at) { return first <= at && at < last; };
  for (ComputedParameter one : whole->all) {
    if (!inside(one.to) || !inside(one.from)) continue;
    one.to -= first, one.from -= first;
    part->all.push_back(std::move(one));
  }
  return part;
}

Index last_parameter(const Layout& whole, const Layout::Range& range) {
  const auto [first, count] = extent(whole, range, &Layout::Leaf::p, &Layout::Leaf::np);
  return first + count;
}

/// The systems within a part, the part itself first, with the numbers that its leaves have in it.
std::vector<Layout::Range> systems_within(const Layout& whole, const Layout::Range& range) {
  std::vector<Layout::Range> systems;
  bool inside = false;  // a system comes before the systems in it
  for (Layout::Range inner : whole.systems) {
    inside = inside || inner.id == range.id;
    if (!inside || inner.first < range.first || inner.last > range.last) continue;
    inner.first -= range.first, inner.last -= range.first;
    systems.push_back(std::move(inner));
  }
  return systems;
}

/// The beginning of the paths of the leaves that a part does not have; empty for the whole, and for a
/// leaf.
std::string prefix_of(const Layout& whole, const Layout::Range& range) {
  const bool leaf = range.last - range.first == 1 && whole.leaves[range.first].path == range.path;
  return leaf || whole.systems.front().id == range.id ? "" : range.path + ".";
}

}  // namespace

std::shared_ptr<const Layout> part_layout(const Layout& whole, const Layout::Range& range) {
  auto part = std::make_shared<Layout>();
  const Layout::Leaf origin = range.first < range.last ? whole.leaves[range.first] : Layout::Leaf{};
  const std::string prefix = prefix_of(whole, range);
  for (std::size_t i = range.first; i < range.last; ++i) {
    Layout::Leaf leaf = whole.leaves[i];
    leaf.x -= origin.x, leaf.z -= origin.z, leaf.p -= origin.p;
    if (!prefix.empty() && leaf.path.starts_with(prefix)) leaf.path.erase(0, prefix.size());
    if (leaf.of_diagram && leaf.path + "." == prefix) leaf.path.clear();
    part->leaves.push_back(std::move(leaf));
  }
  part->computed = part_of(whole.computed, origin.p, last_parameter(whole, range));
  part->systems = systems_within(whole, range);
  return part;
}

}  // namespace detail

using detail::difference, detail::extent, detail::part_layout;

Context Context::operator[](SystemId id) const {
  const Layout::Range& where = range(id);
  using Leaf = Layout::Leaf;
  const auto [x, nx] = extent(*layout_, where, &Leaf::x, &Leaf::nx);
  const auto [z, nz] = extent(*layout_, where, &Leaf::z, &Leaf::nz);
  const auto [p, np] = extent(*layout_, where, &Leaf::p, &Leaf::np);
  Context part(part_layout(*layout_, where));
  part.time_ = time_;
  part.settled_ = settled_;
  part.x_ = x_.segment(x, nx);
  part.z_ = z_.segment(z, nz);
  part.p_ = p_.segment(p, np);
  part.modes_.assign(modes_.begin() + static_cast<std::ptrdiff_t>(where.first),
                     modes_.begin() + static_cast<std::ptrdiff_t>(where.last));
  return part;
}

Context Context::with_subcontext(SystemId id, const Context& part) const {
  const Layout::Range& where = range(id);
  using Leaf = Layout::Leaf;
  const auto [x, nx] = extent(*layout_, where, &Leaf::x, &Leaf::nx);
  const auto [z, nz] = extent(*layout_, where, &Leaf::z, &Leaf::nz);
  const auto [p, np] = extent(*layout_, where, &Leaf::p, &Leaf::np);
  const std::size_t leaves = where.last - where.first;
  if (part.x_.size() != nx || part.z_.size() != nz || part.p_.size() != np ||
      part.modes_.size() != leaves) {
    throw ModelError(text("with_subcontext: the context given is not one of '", where.path,
                          "': expected ", nx, " continuous and ", nz, " discrete states, ", np,
                          " parameters and ", leaves, " modes, found ", part.x_.size(), ", ",
                          part.z_.size(), ", ", part.p_.size(), " and ", part.modes_.size()));
  }
  const std::string other = difference(*part_layout(*layout_, where), part.layout(), false);
  if (!other.empty()) {
    throw ModelError(
        text("with_subcontext: the context given is not one of '", where.path, "': ", other));
  }
  Context next = changed();
  next.x_.segment(x, nx) = part.x_;
  next.z_.segment(z, nz) = part.z_;
  next.p_.segment(p, np) = part.p_;
  std::copy(part.modes_.begin(), part.modes_.end(),
            next.modes_.begin() + static_cast<std::ptrdiff_t>(where.first));
  next.compute_parameters();
  return next;
}

}  // namespace saltus
