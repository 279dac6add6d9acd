#include "shelf.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace saltus::models {

namespace detail {

std::size_t known_place(const SceneParameters& all, const std::string& name) {
  std::vector<std::string> known;
  for (const auto& [parameter, usual] : all) known.push_back(parameter);
  const auto found = std::ranges::find(known, name);
  if (found == known.end())
    throw ModelError(text("unknown parameter '", name, "'", known_names(name, known)));
  return static_cast<std::size_t>(found - known.begin());
}

void require_in_range(const std::string& name, double least, double most, double value) {
  if (!(value >= least && value <= most) || !std::isfinite(value))
    throw ModelError(
        text("parameter '", name, "': expected ", least, " to ", most, ", found ", value));
}

void refuse_fraction(const std::string& name, double value) {
  throw ModelError(text("parameter '", name, "': expected an integer, found ", value));
}

void refuse_together(const std::string& scene, const char* expected) {
  throw ModelError(text("scene '", scene, "': expected ", expected));
}

}  // namespace detail

const std::vector<ShelfEntry>& shelf() {
  static const std::vector<ShelfEntry> all = [] {
    std::vector<ShelfEntry> list = detail::hybrid_scenes();
    std::ranges::move(detail::smooth_scenes(), std::back_inserter(list));
    return list;
  }();
  return all;
}

Scene scene(std::string_view name) { return scene(name, {}); }

Scene scene(std::string_view name, const SceneParameters& with) {
  const auto found = std::ranges::find(shelf(), name, &ShelfEntry::name);
  if (found != shelf().end()) {
    const auto make = [entry = &*found, with] {
      return with.empty() ? entry->make() : entry->make_with(with);
    };
    Scene made = make();
    if (!made.build) made.build = [make] { return make().system; };
    return made;
  }
  std::string names;
  for (const ShelfEntry& entry : shelf()) names += (names.empty() ? "" : ", ") + entry.name;
  throw ModelError(text("no scene '", name, "' on the shelf; there are ", names));
}

}  // namespace saltus::models
