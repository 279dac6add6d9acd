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

Scene scene(std::string_view name) {
  const auto found = std::ranges::find(shelf(), name, &ShelfEntry::name);
  if (found != shelf().end()) {
    Scene made = found->make();
    if (!made.build) made.build = [make = found->make] { return make().system; };
    return made;
  }
  std::string names;
  for (const ShelfEntry& entry : shelf()) names += (names.empty() ? "" : ", ") + entry.name;
  throw ModelError(text("no scene '", name, "' on the shelf; there are ", names));
}

}  // namespace saltus::models
