#pragma once
// Which of the two kinds of scenes a text is.

#include "scene/value.hpp"

namespace clca::scene {

enum class Kind { automaton, boltzmann };

/// By the keys of the map. Throws SceneError where they belong to both kinds.
Kind kind_of(const Value& root);

}  // namespace clca::scene
