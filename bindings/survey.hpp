// The Python blocks of a system, with what their functions must know to become tapes.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "python_leaf.hpp"

namespace saltus::python {

/// One Python block where it stands in a system.
struct SurveyedBlock {
  const PythonLeaf* leaf;
  std::string path;
  std::vector<Shape> inputs, outputs;
  std::size_t declared;  // how much it had declared
};

/// It refers to the system and its blocks and keeps neither alive: the Python object of the system
/// owns this one.
struct Survey {
  const System* system;
  std::vector<SurveyedBlock> blocks;
  bool complete =
      true;  // every shape is known; else inputs count as their ports say, or as numbers

  /// Whether some block has declared more since.
  bool stale() const;
};

/// Compiles the system for its shapes. Throws what that throws, except with `incomplete`, which is
/// for a system that cannot run yet: open inputs then count as single numbers.
Survey survey_of(const System& system, bool incomplete);

}  // namespace saltus::python
