#include "shared_outside.hpp"

#include <utility>

#include "python_leaf.hpp"

namespace saltus::python {

namespace {

template <class Result, class Map>
void note_writes(const PythonLeaf& leaf, Map& map) {
  map = [&leaf, own = std::move(map)](const At& at, Result& next) {
    own(leaf, at, next);
    next.note_write_outside();
  };
}

void declare_writer(const PythonLeaf& leaf, const Function& function, Declarations& declared) {
  switch (function.role) {
    case Role::update:
      return note_writes<Next>(leaf, declared.time_events[function.index].update);
    case Role::reset_map:
      return note_writes<Next>(leaf, declared.zero_crossings[function.index].reset_map);
    case Role::edge_reset:
      return note_writes<Next>(leaf, declared.edge_resets[function.index].reset_map);
    case Role::event_input:
      return note_writes<Delivery>(leaf, declared.event_inputs[function.index].reset_map);
    default:  // it does not run at instants alone
      return;
  }
}

/// Derivatives and guards have no rate: they are computed again after each instant that wrote.
void declare_reader(const Function& function, Declarations& declared) {
  const auto add = [](Reads& reads) { reads = reads | Reads::outside; };
  if (function.role == Role::output) add(declared.outputs[function.index].reads);
  if (function.role == Role::relation) add(declared.relations[function.index].reads);
}

}  // namespace

void declare_shared(const PythonLeaf& leaf, const SharedOutside& shared, Declarations& declared) {
  for (const int k : shared.readers) declare_reader(leaf.function(k), declared);
  for (const int k : shared.writers) declare_writer(leaf, leaf.function(k), declared);
  declared.shares_outside = shared.any();
}

}  // namespace saltus::python
