#pragma once
// Movers that want the same sites, in the order in which they have their turn.

#include <vector>

#include "automaton/update_order.hpp"

namespace clca::automaton {

struct Mover;

struct Turn {
  UpdateKey key;
  Mover* mover = nullptr;
};

/// From the first to have its turn on.
void sort(std::vector<Turn>& turns);

/// Adds sorted turns to sorted ones.
void merge(std::vector<Turn>& all, const std::vector<Turn>& more);

}  // namespace clca::automaton
