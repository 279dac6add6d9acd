// A context as JSON and back, to the last bit. It needs nlohmann/json, as no other header here
// does: include it where you use it.
#pragma once

#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

#include "saltus/model/system.hpp"

namespace saltus {

namespace detail {

using Json = nlohmann::ordered_json;

inline Json json_of(const Eigen::Ref<const Eigen::VectorXd>& values) {
  Json list = Json::array();
  for (const double value : values) list.push_back(value);
  return list;
}

inline Json json_of(const Continuation& c) {
  Json guards = Json::array(), firings = Json::array();
  for (const auto& g : c.guards)
    guards.push_back({g.side, g.from, g.fresh, g.resting, g.band, g.base});
  for (const auto& f : c.firings)
    firings.push_back({{"times", f.times}, {"after", f.after}, {"holding", f.holding}});
  return {{"jump", c.jump},     {"relations", c.relations}, {"guards", guards},
          {"firings", firings}, {"edges", c.edges},         {"counts", c.counts}};
}

inline Continuation continuation_from(const Json& json) {
  Continuation c{.jump = json.at("jump"),
                 .relations = json.at("relations"),
                 .edges = json.at("edges"),
                 .counts = json.at("counts")};
  for (const Json& g : json.at("guards")) {
    c.guards.push_back({.side = g.at(0),
                        .from = g.at(1),
                        .fresh = g.at(2),
                        .resting = g.at(3),
                        .band = g.at(4),
                        .base = g.at(5)});
  }
  for (const Json& f : json.at("firings"))
    c.firings.push_back(
        {.times = f.at("times"), .after = f.at("after"), .holding = f.at("holding")});
  return c;
}

/// Reads a list of numbers to its place among the values of all blocks.
inline void read_numbers(const Json& block, const char* key, Eigen::Ref<Eigen::VectorXd> into,
                         const std::string& path) {
  const std::vector<double> numbers = block.at(key);
  if (static_cast<Index>(numbers.size()) != into.size()) {
    throw ModelError(text("block '", path, "': expected ", into.size(), " numbers under '", key,
                          "', found ", numbers.size()));
  }
  std::ranges::copy(numbers, into.begin());
}

}  // namespace detail

/// The values of a context, block by block, with the continuation of its run. Numbers are written
/// so that reading them gives the same bits.
inline std::string to_json(const Context& context) {
  const ContextValues v = context.values();
  detail::Json blocks = detail::Json::array();
  const auto& leaves = context.layout().leaves;
  for (std::size_t i = 0; i < leaves.size(); ++i) {
    const Layout::Leaf& leaf = leaves[i];
    blocks.push_back(
        {{"block", leaf.path},
         {"continuous_state", detail::json_of(v.continuous_state.segment(leaf.x, leaf.nx))},
         {"discrete_state", detail::json_of(v.discrete_state.segment(leaf.z, leaf.nz))},
         {"parameters", detail::json_of(v.parameters.segment(leaf.p, leaf.np))},
         {"mode", v.modes[i]}});
  }
  detail::Json json{
      {"format", "saltus context 1"}, {"time", v.time}, {"settled", v.settled}, {"blocks", blocks}};
  if (v.continuation) json["continuation"] = detail::json_of(*v.continuation);
  return json.dump(1);
}

/// The context of `system` that to_json wrote. Throws ModelError for text that is not such a
/// context, and for a context of a system with other blocks.
inline Context context_from_json(const System& system, std::string_view json_text) {
  const Context blank = system.create_context();
  const auto& leaves = blank.layout().leaves;
  ContextValues v = blank.values();
  try {
    const detail::Json json = detail::Json::parse(json_text);
    if (json.at("format") != "saltus context 1")
      throw ModelError(
          text("expected format 'saltus context 1', found ", json.at("format").dump()));
    const detail::Json& blocks = json.at("blocks");
    if (blocks.size() != leaves.size()) {
      throw ModelError(text("the context is not one of this system: expected ", leaves.size(),
                            " blocks, found ", blocks.size()));
    }
    v.time = json.at("time"), v.settled = json.at("settled");
    for (std::size_t i = 0; i < leaves.size(); ++i) {
      const Layout::Leaf& leaf = leaves[i];
      const std::string found = blocks[i].at("block");
      if (found != leaf.path)
        throw ModelError(text("expected block '", leaf.path, "', found '", found, "'"));
      using detail::read_numbers;
      read_numbers(blocks[i], "continuous_state", v.continuous_state.segment(leaf.x, leaf.nx),
                   found);
      read_numbers(blocks[i], "discrete_state", v.discrete_state.segment(leaf.z, leaf.nz), found);
      read_numbers(blocks[i], "parameters", v.parameters.segment(leaf.p, leaf.np), found);
      v.modes[i] = blocks[i].at("mode");
    }
    if (json.contains("continuation"))
      v.continuation =
          std::make_shared<const Continuation>(detail::continuation_from(json.at("continuation")));
  } catch (const detail::Json::exception& error) {
    throw ModelError(text("a context in JSON: ", error.what()));
  }
  return blank.with_values(v);
}

}  // namespace saltus
