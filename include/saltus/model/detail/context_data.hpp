// The fields of a context as data: one list for writing and reading, for JSON and for Python.
//
// A `Tree` is a form of such data, such as JSON. Its `Value` is a record (names and values), a list
// or a number:
//   record(), list(), row(values...)  make an empty record, an empty list, a list of these values
//   set(record, key, value), append(list, value)
//   get<T>(record, key), entry<T>(row, index), items(record, key), has(record, key)
//   is(value, text), shown(value)     whether it is this text; the value in a message
// The functions of a Tree throw its own exceptions for a missing key or a wrong type.
#pragma once

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "saltus/model/context.hpp"

namespace saltus::detail {

inline constexpr const char* context_format = "saltus context 1";

/// Writes fields into a record, one for each call.
template <class Tree>
struct FieldWriter {
  typename Tree::Value data = Tree::record();

  template <class T>
  void field(const char* key, const T& value) {
    Tree::set(data, key, value);
  }

  template <class T>
  void optional(const char* key, const T& value) {
    field(key, value);
  }

  /// A list of items, each a row of its members.
  template <class T, class... Member>
  void rows(const char* key, const std::vector<T>& items, Member T::*... member) {
    auto list = Tree::list();
    for (const T& item : items) Tree::append(list, Tree::row(item.*member...));
    Tree::set(data, key, list);
  }

  /// A list of items, each a record with the fields that `fields(writer, item)` names.
  template <class T, class Fields>
  void records(const char* key, std::vector<T>& items, const Fields& fields) {
    auto list = Tree::list();
    for (T& item : items) {
      FieldWriter writer;
      fields(writer, item);
      Tree::append(list, writer.data);
    }
    Tree::set(data, key, list);
  }

  /// As `records`, but nothing is written for an empty list.
  template <class T, class Fields>
  void optional_records(const char* key, std::vector<T>& items, const Fields& fields) {
    if (!items.empty()) records(key, items, fields);
  }
};

/// Reads fields from a record, one for each call.
template <class Tree>
struct FieldReader {
  const typename Tree::Value& data;

  template <class T>
  void field(const char* key, T& value) {
    value = Tree::template get<T>(data, key);
  }

  /// A field that data of earlier versions do not have: the value remains as it is.
  template <class T>
  void optional(const char* key, T& value) {
    if (Tree::has(data, key)) field(key, value);
  }

  template <class T, class... Member>
  void rows(const char* key, std::vector<T>& items, Member T::*... member) {
    for (const auto& row : Tree::items(data, key)) {
      T item{};
      std::size_t i = 0;
      ((item.*member = Tree::template entry<Member>(row, i++)), ...);
      items.push_back(item);
    }
  }

  template <class T, class Fields>
  void records(const char* key, std::vector<T>& items, const Fields& fields) {
    for (const auto& data_of_one : Tree::items(data, key)) {
      FieldReader reader{data_of_one};
      fields(reader, items.emplace_back());
    }
  }

  template <class T, class Fields>
  void optional_records(const char* key, std::vector<T>& items, const Fields& fields) {
    if (Tree::has(data, key)) records(key, items, fields);
  }
};

template <class Archive>
void fields_of(Archive& archive, Continuation& c) {
  using Guard = Continuation::Guard;
  archive.field("jump", c.jump);
  archive.field("relations", c.relations);
  archive.rows("guards", c.guards, &Guard::side, &Guard::from, &Guard::at_zero, &Guard::resting,
               &Guard::error, &Guard::base);
  archive.records("firings", c.firings, [](auto& one, auto& firings) {
    one.field("times", firings.times);
    one.field("after", firings.after);
    one.optional("states", firings.states);
    one.optional("longest", firings.longest);
    one.field("holding", firings.holding);
  });
  archive.field("edges", c.edges);
  archive.optional_records("contacts", c.contacts, [](auto& one, auto& contact) {
    one.field("guard", contact.guard);
    one.field("pressed_on", contact.pressed_on);
    one.field("look_ahead", contact.look_ahead);
  });
  archive.optional_records("leaving", c.leaving, [](auto& one, auto& guard) {
    one.field("guard", guard.guard);
    one.field("waited", guard.waited);
    one.field("armed_at", guard.armed_at);
    one.field("clear_at", guard.clear_at);
  });
  archive.field("counts", c.counts);
  archive.optional("settled", c.settled);
  archive.optional_records("islands", c.islands,
                           [](auto& one, auto& island) { fields_of(one, island); });
}

template <class Archive>
void fields_of(Archive& archive, PendingExecutions& pending) {
  archive.records("all", pending.all, [](auto& one, auto& execution) {
    one.field("leaf", execution.leaf);
    one.field("event", execution.event);
    one.field("entry", execution.entry);
    one.field("due", execution.due);
    one.field("number", execution.number);
    one.field("frozen", execution.frozen);
    FrozenValues& values = execution.values;
    one.field("wrote_continuous", values.wrote_continuous);
    one.field("wrote_discrete", values.wrote_discrete);
    one.field("wrote_mode", values.wrote_mode);
    one.field("continuous_entries", values.continuous_entries);
    one.field("discrete_entries", values.discrete_entries);
    one.field("continuous", values.continuous);
    one.field("discrete", values.discrete);
    one.field("mode", values.mode);
  });
  archive.field("scheduled", pending.scheduled);
  archive.field("draws", pending.draws);
  archive.optional_records("deliveries", pending.deliveries, [](auto& one, auto& delivery) {
    one.field("leaf", delivery.leaf);
    one.field("event", delivery.event);
    one.field("entry", delivery.entry);
    one.field("delay", delivery.delay);
    one.field("due", delivery.due);
  });
}

/// The values of one leaf.
struct BlockData {
  std::string block;  ///< its path
  std::vector<double> continuous_state, discrete_state, parameters;
  int mode = 0;
};

template <class Archive>
void fields_of(Archive& archive, BlockData& data) {
  archive.field("block", data.block);
  archive.field("continuous_state", data.continuous_state);
  archive.field("discrete_state", data.discrete_state);
  archive.field("parameters", data.parameters);
  archive.field("mode", data.mode);
}

template <class Tree, class T>
typename Tree::Value written(T& value) {
  FieldWriter<Tree> writer;
  fields_of(writer, value);
  return std::move(writer.data);
}

template <class Tree, class T>
T read(const typename Tree::Value& data) {
  T value;
  FieldReader<Tree> reader{data};
  fields_of(reader, value);
  return value;
}

inline std::vector<double> numbers_of(const Eigen::Ref<const Eigen::VectorXd>& values) {
  return {values.begin(), values.end()};
}

/// The values of a context, leaf by leaf, the continuation of the run that ended with it, and its
/// pending executions.
template <class Tree>
typename Tree::Value data_of(const Context& context) {
  const ContextValues v = context.values();
  auto blocks = Tree::list();
  for (std::size_t i = 0; i < v.modes.size(); ++i) {
    const Layout::Leaf& leaf = context.layout().leaves[i];
    BlockData block{.block = leaf.path,
                    .continuous_state = numbers_of(v.continuous_state.segment(leaf.x, leaf.nx)),
                    .discrete_state = numbers_of(v.discrete_state.segment(leaf.z, leaf.nz)),
                    .parameters = numbers_of(v.parameters.segment(leaf.p, leaf.np)),
                    .mode = v.modes[i]};
    Tree::append(blocks, written<Tree>(block));
  }
  auto data = Tree::record();
  Tree::set(data, "format", std::string(context_format));
  Tree::set(data, "time", v.time);
  Tree::set(data, "settled", v.settled);
  Tree::set(data, "blocks", blocks);
  if (v.continuation) {
    Continuation continuation = *v.continuation;
    Tree::set(data, "continuation", written<Tree>(continuation));
  }
  if (v.pending) {
    PendingExecutions pending = *v.pending;
    Tree::set(data, "pending", written<Tree>(pending));
  }
  return data;
}

inline void require_size(std::size_t found, Index expected, const char* key,
                         const std::string& path) {
  if (static_cast<Index>(found) == expected) return;
  throw ModelError(
      text("block '", path, "': expected ", expected, " numbers under '", key, "', found ", found));
}

/// Throws ModelError if the values of a leaf are not as many as its layout says.
inline void require_values(const Layout::Leaf& leaf, const BlockData& data) {
  if (data.block != leaf.path)
    throw ModelError(text("expected block '", leaf.path, "', found '", data.block, "'"));
  require_size(data.continuous_state.size(), leaf.nx, "continuous_state", leaf.path);
  require_size(data.discrete_state.size(), leaf.nz, "discrete_state", leaf.path);
  require_size(data.parameters.size(), leaf.np, "parameters", leaf.path);
}

/// The numbers of all leaves, one after the other.
inline Eigen::VectorXd joined(const std::vector<BlockData>& blocks,
                              std::vector<double> BlockData::*numbers) {
  std::vector<double> all;
  for (const BlockData& block : blocks)
    all.insert(all.end(), (block.*numbers).begin(), (block.*numbers).end());
  return Eigen::Map<const Eigen::VectorXd>(all.data(), static_cast<Index>(all.size()));
}

/// The values for a sound layout that data_of gave. Throws ModelError for data of another format
/// and for a context of other blocks. It takes as much memory as the data, whatever sizes the
/// layout names.
template <class Tree>
ContextValues values_from(const Layout& layout, const typename Tree::Value& data) {
  const auto& leaves = layout.leaves;
  ContextValues v;
  const auto format = Tree::template get<typename Tree::Value>(data, "format");
  if (!Tree::is(format, context_format))
    throw ModelError(text("expected format '", context_format, "', found ", Tree::shown(format)));
  const auto blocks = Tree::items(data, "blocks");
  if (blocks.size() != leaves.size()) {
    throw ModelError(text("the context is not one of this system: expected ", leaves.size(),
                          " blocks, found ", blocks.size()));
  }
  v.time = Tree::template get<double>(data, "time");
  v.settled = Tree::template get<bool>(data, "settled");
  std::vector<BlockData> all;
  for (std::size_t i = 0; i < leaves.size(); ++i) {
    all.push_back(read<Tree, BlockData>(blocks[i]));
    require_values(leaves[i], all.back());
    v.modes.push_back(all.back().mode);
  }
  v.continuous_state = joined(all, &BlockData::continuous_state);
  v.discrete_state = joined(all, &BlockData::discrete_state);
  v.parameters = joined(all, &BlockData::parameters);
  if (Tree::has(data, "continuation")) {
    v.continuation = std::make_shared<const Continuation>(
        read<Tree, Continuation>(Tree::template get<typename Tree::Value>(data, "continuation")));
  }
  if (Tree::has(data, "pending")) {
    v.pending = std::make_shared<const PendingExecutions>(
        read<Tree, PendingExecutions>(Tree::template get<typename Tree::Value>(data, "pending")));
  }
  return v;
}

}  // namespace saltus::detail
