// The two halves of the shelf; each is a list in a source file of its own.
#pragma once

#include "saltus/models/shelf.hpp"

namespace saltus::models::detail {

std::vector<ShelfEntry> hybrid_scenes();  // hybrid_scenes.cpp
std::vector<ShelfEntry> smooth_scenes();  // smooth_scenes.cpp: stiff and smooth ones

}  // namespace saltus::models::detail
