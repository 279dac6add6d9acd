// Pictures of a system as Graphviz DOT or as Mermaid text: its blocks, frames around inner
// diagrams, the wires, the control signals, and the use that a plan makes of each block.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "saltus/plan/plan.hpp"

namespace saltus {

struct PictureOptions {
  /// The signals that a run would record. A block that nothing else reads is drawn as dropped. If
  /// not given: every output of the system.
  std::optional<RecordedSignals> recorded_signals = {};
  /// Inner diagrams deeper than this are drawn as one block each; 0 makes one block of the whole.
  int max_depth = std::numeric_limits<int>::max();
};

/// The contents of a picture, before they are written in one language or the other.
struct Picture {
  /// The rate of a value, or the reason why it is not computed.
  enum class Flow { unknown, continuous, held, folded, dropped };

  struct Block {
    enum class Kind { leaf, diagram, input, output };
    Kind kind = Kind::leaf;
    int frame = -1;  ///< the inner diagram that contains it; -1: none
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
    Index columns = 0;  ///< of a matrix
    Flow flow = Flow::unknown;
    bool event = false;  ///< read by guards, resets and updates only
  };

  /// A control signal, and the block or the inner diagram that it executes.
  struct Control {
    int from = 0, output = 0;
    int block = -1, frame = -1;  ///< one of them is -1
    std::string words = {};      ///< "enables", "triggers ↑"
    Flow flow = Flow::unknown;
  };

  /// The event wires from one event of a block to one event input of another.
  struct EventWire {
    int from = 0, to = 0;    ///< blocks
    std::string words = {};  ///< "fire → synapse"
    int count = 1;           ///< how many wires there are
  };

  std::string name = {};
  std::vector<Frame> frames = {};  ///< each after the frame around it
  std::vector<Block> blocks = {};
  std::vector<Wire> wires = {};
  std::vector<Control> controls = {};
  std::vector<EventWire> event_wires = {};
  std::string trouble = {};  ///< the reason why there is no plan; every flow is then unknown
};

/// The blocks and wires of a system, with their use in the plan of compile(). An input of the
/// system counts as a continuous signal. A system that does not compile is drawn too, with the
/// reason. Throws ModelError for a recorded signal of another system.
Picture picture(const System& system, const PictureOptions& options = {});

/// Whether the name of a port says nothing: the only input of a block is called "in", or the only
/// output "out".
bool obvious(const std::vector<std::string>& ports, std::string_view usual);

/// The width of a wire in words: "3", or "2 x 3" of a matrix.
std::string dimensions_of(const Picture::Wire& wire);

/// The words at an event wire: "fire → synapse", or "fire → synapse (100)".
std::string event_label(const Picture::EventWire& wire);

/// The picture in the language of Graphviz: `dot -Tsvg`. Inner diagrams are clusters. Wires that
/// are read at events only are dashed; folded and dropped blocks are grey; a legend says so. A
/// dotted edge leads from a control signal to the block or the cluster that it executes. Event wires
/// have a colour of their own, and their events and inputs as words.
std::string to_dot(const System& system, const PictureOptions& options = {});

/// The same picture as a Mermaid flowchart, which GitHub, GitLab, JupyterLab and MkDocs-Material
/// draw.
std::string to_mermaid(const System& system, const PictureOptions& options = {});

/// The modes of a leaf and the zero crossings from one mode to another, as a Mermaid state diagram.
/// Throws ModelError for a system without modes.
std::string modes_to_mermaid(const System& system);

}  // namespace saltus
