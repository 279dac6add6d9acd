// The shelf: every ready scene by the name that command lines, benchmarks and tests use.
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
  std::string title;                ///< the scene and its difficulty, in one line
  std::function<Scene()> make;      ///< the scene with its usual parameters
  SceneParameters parameters = {};  ///< these
  /// The scene with some parameters changed, and its known answer for them if there is one.
  std::function<Scene(const SceneParameters&)> make_with = {};
  bool quick = true;  ///< short enough to run by every method in each test
};

/// All scenes, hybrid ones first. They are compiled into the library.
const std::vector<ShelfEntry>& shelf();

/// The scene with this name. Throws ModelError with the known names if there is none.
Scene scene(std::string_view name);

/// The same with some of its parameters changed. Throws ModelError for an unknown name, with the
/// nearest one, and for a value without meaning in the scene.
Scene scene(std::string_view name, const SceneParameters& with);

}  // namespace saltus::models
