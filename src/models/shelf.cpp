#include "shelf.hpp"

#include <algorithm>
#include <iterator>

namespace saltus::models {

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
