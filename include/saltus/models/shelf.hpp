// The shelf: every ready scene under the name that command lines, benchmarks and tests know it by.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "saltus/report/scene.hpp"

namespace saltus::models {

/// Parameters of a scene by name, as in the struct of its header: {{"e", 0.9}, {"y0", 3.0}}.
using SceneParameters = std::vector<std::pair<std::string, double>>;

struct ShelfEntry {
  std::string name;                 ///< "bouncing-ball"
  std::string title;                ///< one line: what it is, and what it is hard for
  std::function<Scene()> make;      ///< the scene with its usual parameters
  SceneParameters parameters = {};  ///< these
  /// The scene with some of them changed, and its known answer with them where that is possible.
  std::function<Scene(const SceneParameters&)> make_with = {};
  bool quick = true;  ///< short enough to run by every method in each test
};

/// All scenes, hybrid ones first. They are compiled into the library.
const std::vector<ShelfEntry>& shelf();

/// The scene of that name. Throws ModelError, with the names there are, where there is none.
Scene scene(std::string_view name);

/// The same with some of its parameters changed. Throws ModelError for an unknown name, with the
/// nearest one, and for a value that the scene has no meaning for.
Scene scene(std::string_view name, const SceneParameters& with);

}  // namespace saltus::models
