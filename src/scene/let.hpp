#pragma once
// Numbers with names, and expressions in the place of numbers.

#include "scene/value.hpp"

namespace clca::scene {

/// Evaluates what stands under `let`, in its order, then replaces each `=EXPRESSION` of the tree
/// by its value. Throws SceneError.
void evaluate_expressions(Value& root);
/// Expressions without names in a value. Throws SceneError.
void evaluate_expression(Value& value);

}  // namespace clca::scene
