// The two halves of the shelf, one list in each source file, and the parts of an entry.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <variant>

#include "saltus/models/shelf.hpp"

namespace saltus::models::detail {

std::vector<ShelfEntry> hybrid_scenes();  // hybrid_scenes.cpp
std::vector<ShelfEntry> smooth_scenes();  // smooth_scenes.cpp: stiff and smooth scenes

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr double positive = std::numeric_limits<double>::min();
constexpr double below_one = 1.0 - std::numeric_limits<double>::epsilon();

/// One parameter of a scene, and the range of its meaningful values.
template <class Parameters>
struct Member {
  std::string name;
  std::variant<double Parameters::*, int Parameters::*, Index Parameters::*> at;
  double least = -infinite, most = infinite;

  double get(const Parameters& from) const {
    return std::visit([&](auto member) { return static_cast<double>(from.*member); }, at);
  }
  /// Throws ModelError for a value out of bounds, or for a fraction if an integer is required.
  void set(Parameters& to, double value) const {
    if (!(value >= least && value <= most) || !std::isfinite(value))
      throw ModelError(
          text("parameter '", name, "': expected ", least, " to ", most, ", found ", value));
    std::visit(
        [&](auto member) {
          using Number = std::remove_reference_t<decltype(to.*member)>;
          to.*member = static_cast<Number>(value);
          if (static_cast<double>(to.*member) != value)
            throw ModelError(text("parameter '", name, "': expected an integer, found ", value));
        },
        at);
  }
};

template <class Parameters>
void change(Parameters& all, const std::vector<Member<Parameters>>& members,
            const SceneParameters& with) {
  for (const auto& [name, value] : with) {
    const auto found = std::ranges::find(members, name, &Member<Parameters>::name);
    if (found == members.end()) {
      std::vector<std::string> known;
      for (const auto& member : members) known.push_back(member.name);
      throw ModelError(text("unknown parameter '", name, "'", known_names(name, known)));
    }
    found->set(all, value);
  }
}

/// A condition between parameters, without which the scene has no meaning.
template <class Parameters>
struct Condition {
  const char* expected = nullptr;  ///< "fk < fs"
  bool (*holds)(const Parameters&) = nullptr;
};

/// Makes an entry of the shelf: `make` with `usual` parameters, of which `members` can be changed.
template <class Parameters>
ShelfEntry entry(std::string name, std::string title, Scene (*make)(const Parameters&),
                 std::vector<Member<Parameters>> members, Parameters usual = {}, bool quick = true,
                 Condition<Parameters> condition = {}) {
  SceneParameters values;
  for (const auto& member : members) values.emplace_back(member.name, member.get(usual));
  return {std::move(name),
          std::move(title),
          [=] { return make(usual); },
          values,
          [=](const SceneParameters& with) {
            Parameters changed = usual;
            change(changed, members, with);
            if (condition.holds != nullptr && !condition.holds(changed))
              throw ModelError(text("scene '", name, "': expected ", condition.expected));
            return make(changed);
          },
          quick};
}

}  // namespace saltus::models::detail
