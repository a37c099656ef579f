#pragma once
// Numbers with names, and expressions in the place of numbers.

#include <functional>
#include <optional>
#include <string>

#include "scene/value.hpp"

namespace clca::scene {

/// Evaluates what stands under `let`, in its order, then replaces each `=EXPRESSION` of the tree
/// by its value. In those under `measure`, which are of measures, too, it replaces the names.
/// Throws SceneError.
void evaluate_expressions(Value& root);
/// Expressions without names in a value. Throws SceneError.
void evaluate_expression(Value& value);

/// Refuses the text of a value that cannot be an expression, whatever its names stand for. Throws
/// SceneError.
void check_expression(const Value& value);
/// The expression with numbers for the names that have one.
std::string with_numbers(
    std::string_view expression,
    const std::function<std::optional<double>(std::string_view name)>& number_of);
/// Whether names in expressions may be like this.
bool is_expression_name(const std::string& name);

}  // namespace clca::scene
