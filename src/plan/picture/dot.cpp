// A picture in the language of Graphviz, with HTML-like labels.
#include "parts.hpp"
#include "saltus/base/list.hpp"

namespace saltus {

namespace {

using Block = Picture::Block;
using Flow = Picture::Flow;
using Wire = Picture::Wire;

struct Style {
  const char* line;
  const char* fill;
  const char* text;
  const char* small;  // of ports and small print
  const char* says;
};

/// Okabe and Ito's blue and vermilion, which colour-blind readers can distinguish.
Style style_of(Flow flow) {
  switch (flow) {
    case Flow::continuous:
      return {"#0072B2", "#E8F3FA", "#1A1A1A", "#5A5A5A", "continuous"};
    case Flow::held:
      return {"#D55E00", "#FCEFE6", "#1A1A1A", "#5A5A5A", "held between instants"};
    case Flow::folded:
      return {"#8C8C8C", "#F0F0F0", "#5A5A5A", "#7A7A7A", "folded: constant, computed once"};
    case Flow::dropped:
      return {"#C4C4C4", "#FAFAFA", "#A8A8A8", "#B4B4B4", "dropped: nothing reads it"};
    case Flow::unknown:
      break;
  }
  return {"#404040", "#FFFFFF", "#1A1A1A", "#5A5A5A", ""};
}

/// Text within an HTML-like label or an attribute of an SVG.
std::string escaped(std::string_view raw) {
  std::string out;
  for (const char c : raw) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      case '\n':
        out += "<BR/>";
        break;
      default:
        out += static_cast<unsigned char>(c) < 0x20 || c == 0x7f ? ' ' : c;
    }
  }
  return out;
}

/// The same text where a line break is not possible.
std::string in_one_line(std::string_view raw) {
  std::string flat(raw);
  std::ranges::replace(flat, '\n', ' ');
  return escaped(flat);
}

/// A quoted string. Graphviz reads \n, \l, \N in it as escapes, so a backslash is doubled.
std::string quoted(std::string_view raw) {
  std::string out = "\"";
  for (const char c : raw) {
    if (c == '"' || c == '\\') out += '\\';
    out += static_cast<unsigned char>(c) < 0x20 || c == 0x7f ? ' ' : c;
  }
  return out + "\"";
}

/// Its argument in a font. Without words it is empty, because Graphviz refuses an empty font.
std::string words(std::string_view html, std::string_view attributes) {
  return html.empty() ? std::string() : text("<FONT ", attributes, ">", html, "</FONT>");
}

std::string small_print(const Style& style) {
  return text("POINT-SIZE=\"8\" COLOR=\"", style.small, "\"");
}

/// A column of a block's table: a cell for each port, at which wires end.
std::string ports_cell(const std::vector<std::string>& ports, char side, const Style& style) {
  std::string rows;
  for (std::size_t i = 0; i < ports.size(); ++i) {
    const std::string align = side == 'i' ? "LEFT" : "RIGHT";
    rows += text("<TR><TD ALIGN=\"", align, "\" PORT=\"", std::string(1, side), i, "\">",
                 words(in_one_line(ports[i]), small_print(style)), "</TD></TR>");
  }
  return text("<TD CELLPADDING=\"0\"><TABLE BORDER=\"0\" CELLBORDER=\"0\" CELLSPACING=\"0\" ",
              "CELLPADDING=\"3\">", rows, "</TABLE></TD>");
}

/// Name, kind, and the small print.
std::string middle_cell(const Block& block, const Style& style) {
  std::string lines = text("<B>", escaped(block.name.empty() ? block.type : block.name), "</B>");
  if (block.type != block.name && !block.name.empty())
    lines += "<BR/>" + words(escaped(block.type), "POINT-SIZE=\"9\"");
  for (const std::string& note : block.notes) {
    lines += "<BR/>" + words(in_one_line(note), small_print(style));
  }
  return text("<TD CELLPADDING=\"5\">", lines, "</TD>");
}

bool shows_inputs(const Block& block) { return !obvious(block.inputs, "in"); }
bool shows_outputs(const Block& block) { return !obvious(block.outputs, "out"); }

std::string label_of(const Block& block, const Style& style) {
  std::string row;
  if (shows_inputs(block)) row += ports_cell(block.inputs, 'i', style);
  row += middle_cell(block, style);
  if (shows_outputs(block)) row += ports_cell(block.outputs, 'o', style);
  return text("<<TABLE BORDER=\"0\" CELLBORDER=\"0\" CELLSPACING=\"0\" CELLPADDING=\"0\"><TR>", row,
              "</TR></TABLE>>");
}

std::string block_line(const Block& block, std::size_t i) {
  const Style style = style_of(block.flow);
  const std::string common = text("color=\"", style.line, "\" fillcolor=\"", style.fill,
                                  "\" fontcolor=\"", style.text, "\"");
  if (block.kind == Block::Kind::input || block.kind == Block::Kind::output) {
    return text("b", i, " [shape=oval margin=\"0.06,0.02\" height=0.2 fontsize=9 label=",
                quoted(block.name), " ", common, "];\n");
  }
  const std::string inner = block.kind == Block::Kind::diagram ? " peripheries=2" : "";
  const std::string dotted =
      block.flow == Flow::dropped ? " style=\"rounded,filled,dotted\"" : std::string();
  return text("b", i, " [label=", label_of(block, style), " ", common, inner, dotted, "];\n");
}

/// The end of a wire: its port if the block shows ports, otherwise the middle of its side.
std::string end_of(const Block& block, int number, char side, int port) {
  const bool shown = side == 'i' ? shows_inputs(block) : shows_outputs(block);
  const char* compass = side == 'i' ? ":w" : ":e";
  return text("b", number, shown ? text(":", std::string(1, side), port) : std::string(), compass);
}

std::string wire_line(const Picture& picture, const Wire& wire) {
  const Block& from = nth(picture.blocks, wire.from);
  const Block& to = nth(picture.blocks, wire.to);
  const Style style = style_of(wire.flow);
  std::string out = text("  ", end_of(from, wire.from, 'o', wire.output), " -> ",
                         end_of(to, wire.to, 'i', wire.input), " [color=\"", style.line,
                         "\" fontcolor=\"", style.line, "\"");
  if (wire.event) out += " style=dashed weight=0";
  if (wire.width > 1) out += text(" penwidth=2 label=\"", dimensions_of(wire), "\"");
  const std::string target = nth(to.inputs, wire.input);
  const std::string says = wire.flow == Flow::unknown ? "" : text(": ", style.says);
  return out +
         text(" edgetooltip=", quoted(text(from.name, " → ", to.name, ".", target, says)), "];\n");
}

/// A block within a frame, or within the frames in it: an edge to a cluster ends at a block of it.
int block_in(const Picture& picture, int frame) {
  for (std::size_t i = 0; i < picture.blocks.size(); ++i)
    if (picture.blocks[i].frame == frame) return static_cast<int>(i);
  for (std::size_t i = 0; i < picture.frames.size(); ++i) {
    if (picture.frames[i].parent != frame) continue;
    if (const int block = block_in(picture, static_cast<int>(i)); block >= 0) return block;
  }
  return -1;
}

std::string control_line(const Picture& picture, const Picture::Control& control) {
  const Style style = style_of(control.flow);
  const bool cluster = control.frame >= 0;
  const int to = cluster ? block_in(picture, control.frame) : control.block;
  if (to < 0) return "";
  return text("  ", end_of(nth(picture.blocks, control.from), control.from, 'o', control.output),
              " -> b", to, " [style=dotted penwidth=1.5 arrowhead=empty color=\"", style.line,
              "\" fontcolor=\"", style.line, "\" label=", quoted(control.words),
              cluster ? text(" lhead=cluster_", control.frame) : std::string(), "];\n");
}

constexpr const char* event_colour = "#B45309";

std::string event_line(const Picture::EventWire& wire) {
  return text("  b", wire.from, " -> b", wire.to, " [arrowhead=vee weight=0 color=\"", event_colour,
              "\" fontcolor=\"", event_colour, "\" label=", quoted(event_label(wire)), "];\n");
}

/// Writes the blocks of a frame and the frames in it.
void write_frame(std::string& out, const Picture& picture, int frame, const std::string& indent) {
  for (std::size_t i = 0; i < picture.blocks.size(); ++i) {
    if (picture.blocks[i].frame == frame) out += indent + block_line(picture.blocks[i], i);
  }
  for (std::size_t i = 0; i < picture.frames.size(); ++i) {
    if (picture.frames[i].parent != frame) continue;
    out += text(indent, "subgraph cluster_", i, " {\n", indent,
                "  labelloc=t fontsize=11 label=<<B>", escaped(picture.frames[i].name), "</B>>;\n");
    write_frame(out, picture, static_cast<int>(i), indent + "  ");
    out += indent + "}\n";
  }
}

/// The meaning of the colours and lines that the picture uses.
std::string legend_of(const Picture& picture) {
  std::string cells;
  int entries = 0;
  const auto entry = [&](const char* colour, const char* line, std::string_view says) {
    ++entries;
    cells += text("<TD>", words(line, text("COLOR=\"", colour, "\"")), " ", says, "</TD>");
  };
  for (const Flow flow : {Flow::continuous, Flow::held, Flow::folded, Flow::dropped}) {
    const bool there =
        std::ranges::any_of(picture.blocks,
                            [&](const Block& block) { return block.flow == flow; }) ||
        std::ranges::any_of(picture.wires, [&](const Wire& w) { return w.flow == flow; });
    if (there) entry(style_of(flow).line, "━━", style_of(flow).says);
  }
  if (std::ranges::any_of(picture.wires, [](const Wire& w) { return w.event; }))
    entry("#404040", "╌╌", "read at events only");
  if (!picture.event_wires.empty()) entry(event_colour, "━━", "event wire");
  const std::string trouble =
      picture.trouble.empty()
          ? std::string()
          : text("<TR><TD COLSPAN=\"9\">", words(escaped(picture.trouble), "COLOR=\"#B00020\""),
                 "</TD></TR>");
  const bool plain =
      entries == 0 || (entries == 1 && cells.find("continuous") != std::string::npos);
  if (plain && trouble.empty()) return "";  // nothing to explain
  const std::string row = cells.empty() ? std::string() : text("<TR>", cells, "</TR>");
  return text("<<TABLE BORDER=\"0\" CELLBORDER=\"0\" CELLSPACING=\"6\">", trouble, row,
              "</TABLE>>");
}

}  // namespace

std::string to_dot(const System& system, const PictureOptions& options) {
  const Picture drawn = picture(system, options);
  const char* font = "fontname=\"Helvetica,Arial,sans-serif\"";
  std::string out = text("digraph ", quoted(drawn.name), " {\n");
  out +=
      text("  graph [rankdir=LR compound=true nodesep=0.3 ranksep=0.45 labelloc=b style=rounded ",
           "color=\"#B0B0B0\" fontsize=9 ", font, "];\n");
  out +=
      text("  node [shape=box style=\"rounded,filled\" margin=\"0,0.05\" height=0.45 fontsize=11 ",
           font, "];\n");
  out += text("  edge [arrowsize=0.6 fontsize=8 ", font, "];\n");
  write_frame(out, drawn, -1, "  ");
  for (const Wire& wire : drawn.wires) out += wire_line(drawn, wire);
  for (const Picture::Control& control : drawn.controls) out += control_line(drawn, control);
  for (const Picture::EventWire& wire : drawn.event_wires) out += event_line(wire);
  if (const std::string legend = legend_of(drawn); !legend.empty())
    out += text("  label=", legend, ";\n");
  return out + "}\n";
}

}  // namespace saltus
