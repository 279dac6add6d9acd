// The shelf: every ready scene under the name that command lines, benchmarks and tests know it by.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "saltus/report/scene.hpp"

namespace saltus::models {

struct ShelfEntry {
  std::string name;   ///< "bouncing-ball"
  std::string title;  ///< one line: what it is, and what it is hard for
  Scene (*make)();    ///< the scene with its usual parameters
  bool quick = true;  ///< short enough to run by every method in each test
};

/// All scenes, hybrid ones first. They are compiled into the library.
const std::vector<ShelfEntry>& shelf();

/// The scene of that name. Throws ModelError, with the names there are, where there is none.
Scene scene(std::string_view name);

}  // namespace saltus::models
