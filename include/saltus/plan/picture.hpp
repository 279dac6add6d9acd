// Pictures of a system: its blocks, frames around inner diagrams, the wires, and what becomes of
// each in a plan. As Graphviz DOT or as Mermaid text.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "saltus/plan/plan.hpp"

namespace saltus {

struct PictureOptions {
  /// What a run would record: whatever else nothing reads is drawn as dropped. Not said: every
  /// output of the system.
  std::optional<RecordedSignals> recorded_signals = {};
  /// Inner diagrams deeper than this are one block each; 0 makes one block of the whole.
  int max_depth = std::numeric_limits<int>::max();
};

/// What a picture shows, before it is written in one language or the other.
struct Picture {
  /// How often a value moves, or what the plan made of it.
  enum class Flow { unknown, continuous, held, folded, dropped };

  struct Block {
    enum class Kind { leaf, diagram, input, output };
    Kind kind = Kind::leaf;
    int frame = -1;  ///< the inner diagram it is part of; -1: of none
    std::string name = {}, type = {};
    std::vector<std::string> inputs = {}, outputs = {};
    std::vector<std::string> notes = {};  ///< states, modes, zero crossings, time events
    Flow flow = Flow::unknown;
  };
  struct Frame {
    int parent = -1;
    std::string name = {};
  };
  struct Wire {
    int from = 0, output = 0, to = 0, input = 0;
    Index width = 1;
    Flow flow = Flow::unknown;
    bool event = false;  ///< read by guards, resets and updates only
  };

  std::string name = {};
  std::vector<Frame> frames = {};  ///< each after the one around it
  std::vector<Block> blocks = {};
  std::vector<Wire> wires = {};
  std::string trouble = {};  ///< why there is no plan; then every flow is unknown
};

/// The blocks and wires of a system, with what compile() makes of them. An input of the system
/// counts as a continuous signal. A system that does not compile is drawn all the same, with the
/// reason. Throws ModelError for a recorded signal of another system.
Picture picture(const System& system, const PictureOptions& options = {});

/// A port whose name says nothing: the only input of a block if it is called "in", the only output
/// if it is called "out".
bool obvious(const std::vector<std::string>& ports, std::string_view usual);

/// The picture in the language of Graphviz: `dot -Tsvg`. Inner diagrams are clusters; what is read
/// at events only is dashed; what was folded and dropped is grey; a legend says so.
std::string to_dot(const System& system, const PictureOptions& options = {});

/// The same as a Mermaid flowchart, which GitHub, GitLab, JupyterLab and MkDocs-Material draw.
std::string to_mermaid(const System& system, const PictureOptions& options = {});

/// The modes of a leaf and the zero crossings that lead from one to another, as a Mermaid state
/// diagram. Throws ModelError for a system without modes.
std::string modes_to_mermaid(const System& system);

}  // namespace saltus
