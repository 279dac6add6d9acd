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

// What is below does not depend on the type of the parameters, and is compiled once, in shelf.cpp.

/// The place of a parameter in the list of all. Throws ModelError if it is not there.
std::size_t known_place(const SceneParameters& all, const std::string& name);
/// Throws ModelError for a value out of bounds.
void require_in_range(const std::string& name, double least, double most, double value);
[[noreturn]] void refuse_fraction(const std::string& name, double value);
[[noreturn]] void refuse_together(const std::string& scene, const char* expected);

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
    require_in_range(name, least, most, value);
    std::visit(
        [&](auto member) {
          using Number = std::remove_reference_t<decltype(to.*member)>;
          to.*member = static_cast<Number>(value);
          if (static_cast<double>(to.*member) != value) refuse_fraction(name, value);
        },
        at);
  }
};

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
  return {name,  // not moved: an error of make_with says it
          std::move(title),
          [=] { return make(usual); },
          values,
          [=](const SceneParameters& with) {
            Parameters changed = usual;
            for (const auto& [parameter, value] : with)
              members[known_place(values, parameter)].set(changed, value);
            if (condition.holds != nullptr && !condition.holds(changed))
              refuse_together(name, condition.expected);
            return make(changed);
          },
          quick};
}

}  // namespace saltus::models::detail
