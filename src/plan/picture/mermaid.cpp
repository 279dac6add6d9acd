// A picture as a Mermaid flowchart, and the modes of a leaf as a Mermaid state diagram.
#include <cctype>
#include <set>

#include "parts.hpp"
#include "saltus/base/list.hpp"

namespace saltus {

namespace {

using Block = Picture::Block;
using Flow = Picture::Flow;
using Wire = Picture::Wire;

/// The text of a label. Mermaid writes an entity as #number;, and every character that could end a
/// label or begin something else becomes an entity.
std::string escaped(std::string_view raw) {
  std::string out;
  for (const char c : raw) {
    const bool plain = static_cast<unsigned char>(c) >= 0x80 || std::isalnum(c) != 0 ||
                       std::string_view(" .,_-+*/=!?'").find(c) != std::string_view::npos;
    if (c == '\n')
      out += "<br/>";
    else if (plain)
      out += c;
    else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f)
      out += ' ';
    else
      out += text("#", static_cast<int>(c), ";");
  }
  return out;
}

const char* class_of(Flow flow) {
  switch (flow) {
    case Flow::continuous:
      return "continuous";
    case Flow::held:
      return "held";
    case Flow::folded:
      return "folded";
    case Flow::dropped:
      return "dropped";
    case Flow::unknown:
      break;
  }
  return "unknown";
}

constexpr const char* classes =
    "  classDef continuous fill:#E8F3FA,stroke:#0072B2,color:#1A1A1A\n"
    "  classDef held fill:#FCEFE6,stroke:#D55E00,color:#1A1A1A\n"
    "  classDef folded fill:#F0F0F0,stroke:#8C8C8C,color:#5A5A5A\n"
    "  classDef dropped fill:#FAFAFA,stroke:#C4C4C4,color:#A8A8A8,stroke-dasharray:3 3\n"
    "  classDef unknown fill:#FFFFFF,stroke:#404040,color:#1A1A1A\n"
    "  classDef frame fill:none,stroke:#B0B0B0\n";

const char* colour_of(Flow flow) {
  switch (flow) {
    case Flow::continuous:
      return "#0072B2";
    case Flow::held:
      return "#D55E00";
    case Flow::folded:
      return "#8C8C8C";
    case Flow::dropped:
      return "#C4C4C4";
    case Flow::unknown:
      break;
  }
  return "#404040";
}

std::string block_line(const Block& block, std::size_t i) {
  const bool port = block.kind == Block::Kind::input || block.kind == Block::Kind::output;
  const bool inner = block.kind == Block::Kind::diagram;
  std::string label = escaped(block.name);
  if (!port) {
    label = text("<b>", escaped(block.name.empty() ? block.type : block.name), "</b>");
    if (block.type != block.name && !block.name.empty()) label += "<br/>" + escaped(block.type);
    for (const std::string& note : block.notes) label += "<br/>" + escaped(note);
  }
  return text("b", i,
              port    ? "([\""
              : inner ? "[[\""
                      : "[\"",
              label,
              port    ? "\"])"
              : inner ? "\"]]"
                      : "\"]",
              ":::", class_of(block.flow), "\n");
}

/// The port names that are not obvious, and the width of a vector or the dimensions of a matrix.
std::string words_of(const Picture& picture, const Wire& wire) {
  const Block& from = nth(picture.blocks, wire.from);
  const Block& to = nth(picture.blocks, wire.to);
  std::string out;
  if (!obvious(from.outputs, "out")) out = escaped(nth(from.outputs, wire.output));
  if (!obvious(to.inputs, "in"))
    out += text(out.empty() ? "" : " → ", escaped(nth(to.inputs, wire.input)));
  if (wire.width > 1)
    out += text(out.empty() ? "" : " ", escaped(text("[", dimensions_of(wire), "]")));
  return out;
}

std::string wire_line(const Picture& picture, const Wire& wire) {
  const std::string words = words_of(picture, wire);
  const std::string label = words.empty() ? std::string() : text("|\"", words, "\"|");
  return text("  b", wire.from, wire.event ? " -.->" : " -->", label, " b", wire.to, "\n");
}

std::string control_line(const Picture::Control& control) {
  const std::string to = control.frame >= 0 ? text("f", control.frame) : text("b", control.block);
  return text("  b", control.from, " -.->|\"", escaped(control.words), "\"| ", to, "\n");
}

std::string event_line(const Picture::EventWire& wire) {
  return text("  b", wire.from, " ==>|\"", escaped(event_label(wire)), "\"| b", wire.to, "\n");
}

void write_frame(std::string& out, const Picture& picture, int frame, const std::string& indent) {
  for (std::size_t i = 0; i < picture.blocks.size(); ++i) {
    if (picture.blocks[i].frame == frame) out += indent + block_line(picture.blocks[i], i);
  }
  for (std::size_t i = 0; i < picture.frames.size(); ++i) {
    if (picture.frames[i].parent != frame) continue;
    out += text(indent, "subgraph f", i, "[\"", escaped(picture.frames[i].name), "\"]\n");
    write_frame(out, picture, static_cast<int>(i), indent + "  ");
    out += indent + "end\n";
  }
}

/// The colours of wires, which Mermaid identifies by number.
std::string link_styles(const Picture& picture) {
  std::string out;
  for (const Flow flow :
       {Flow::continuous, Flow::held, Flow::folded, Flow::dropped, Flow::unknown}) {
    std::string numbers;
    for (std::size_t i = 0; i < picture.wires.size(); ++i) {
      if (picture.wires[i].flow == flow) numbers += text(numbers.empty() ? "" : ",", i);
    }
    for (std::size_t i = 0; i < picture.controls.size(); ++i) {
      if (picture.controls[i].flow == flow)
        numbers += text(numbers.empty() ? "" : ",", picture.wires.size() + i);
    }
    if (!numbers.empty()) out += text("  linkStyle ", numbers, " stroke:", colour_of(flow), "\n");
  }
  return out;
}

std::string legend_of(const Picture& picture) {
  std::string out;
  const auto entry = [&](Flow flow, const char* says) {
    const bool there =
        std::ranges::any_of(picture.blocks,
                            [&](const Block& block) { return block.flow == flow; }) ||
        std::ranges::any_of(picture.wires, [&](const Wire& w) { return w.flow == flow; });
    if (there) out += text("    key_", class_of(flow), "[\"", says, "\"]:::", class_of(flow), "\n");
  };
  entry(Flow::continuous, "continuous");
  entry(Flow::held, "held between instants");
  entry(Flow::folded, "folded#58; constant, computed once");
  entry(Flow::dropped, "dropped#58; nothing reads it");
  if (std::ranges::any_of(picture.wires, [](const Wire& w) { return w.event; }))
    out += "    key_event[\"dashed wire#58; read at events only\"]:::unknown\n";
  if (!picture.trouble.empty())
    out += text("    trouble[\"", escaped(picture.trouble), "\"]:::unknown\n");
  const bool plain = picture.trouble.empty() && std::ranges::count(out, '\n') == 1 &&
                     out.find("key_continuous") != std::string::npos;  // nothing to explain
  return out.empty() || plain ? "" : text("  subgraph legend\n", out, "  end\n");
}

std::string frames_of(const Picture& picture, bool legend) {
  std::string names = legend ? "legend" : "";
  for (std::size_t i = 0; i < picture.frames.size(); ++i)
    names += text(names.empty() ? "f" : ",f", i);
  return names.empty() ? names : text("  class ", names, " frame\n");
}

const Declarations& declarations_with_modes(const System& system) {
  const auto* leaf = dynamic_cast<const LeafSystem*>(&system.itself());
  if (leaf == nullptr || !leaf->declarations().has_modes) {
    throw ModelError(text("block '", system.name(),
                          "' has no modes to draw: declare_default_mode, or start_mode and "
                          "end_mode of a zero crossing, would give it some"));
  }
  return leaf->declarations();
}

std::set<int> modes_of(const Declarations& d) {
  std::set<int> modes{d.mode};
  for (const ZeroCrossing& crossing : d.zero_crossings) {
    for (const auto& mode : {crossing.start_mode, crossing.end_mode}) {
      if (mode) modes.insert(*mode);
    }
    if (crossing.on_zeno.kind() == OnZeno::Kind::mode) modes.insert(crossing.on_zeno.mode());
  }
  return modes;
}

/// A name that Mermaid accepts, for negative modes too.
std::string state_name(int mode) { return mode < 0 ? text("m_", -mode) : text("m", mode); }

std::string transitions(const ZeroCrossing& crossing, int from) {
  const std::string words = escaped(detail::words_of(crossing));
  const std::string to = crossing.terminal && !crossing.end_mode
                             ? std::string("[*]")
                             : state_name(crossing.end_mode.value_or(from));
  std::string out = text("  ", state_name(from), " --> ", to, " : ", words, "\n");
  if (crossing.on_zeno.kind() == OnZeno::Kind::mode) {
    out += text("  ", state_name(from), " --> ", state_name(crossing.on_zeno.mode()), " : Zeno ",
                escaped(crossing.name), "\n");
  }
  return out;
}

}  // namespace

std::string to_mermaid(const System& system, const PictureOptions& options) {
  const Picture drawn = picture(system, options);
  std::string out = "flowchart LR\n";
  write_frame(out, drawn, -1, "  ");
  for (const Wire& wire : drawn.wires) out += wire_line(drawn, wire);
  for (const Picture::Control& control : drawn.controls) out += control_line(control);
  for (const Picture::EventWire& wire : drawn.event_wires) out += event_line(wire);
  const std::string legend = legend_of(drawn);
  return out + legend + classes + frames_of(drawn, !legend.empty()) + link_styles(drawn);
}

std::string modes_to_mermaid(const System& system) {
  const Declarations& d = declarations_with_modes(system);
  const std::set<int> modes = modes_of(d);
  std::string out = "stateDiagram-v2\n";
  for (int mode : modes) out += text("  state \"mode ", mode, "\" as ", state_name(mode), "\n");
  out += text("  [*] --> ", state_name(d.mode), "\n");
  for (const ZeroCrossing& crossing : d.zero_crossings) {
    if (crossing.direction == Direction::none) continue;
    for (int mode : modes) {
      if (crossing.start_mode.value_or(mode) == mode) out += transitions(crossing, mode);
    }
  }
  return out;
}

}  // namespace saltus
