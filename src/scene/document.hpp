#pragma once
// A scene as a tree of values: parsed from text by the only user of yaml-cpp, with overrides of the
// command line, expressions and files of pictures.

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "clca/image/image.hpp"
#include "scene/value.hpp"

namespace clca::scene {

/// Reads the single document in `text`. Stricter than YAML: no duplicate or compound keys, anchors,
/// aliases, merge keys, tags, directives or further documents.
/// Without a document the value is nothing. Throws SceneError.
Value read_document(std::string_view text, std::shared_ptr<const Origin> origin);

/// Puts the value of `text` into the tree. Throws SceneError that names `OPTION KEY=VALUE`.
void apply_override(Value& root, const std::string& text, std::string_view option);

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

struct PictureFile {
  image::Image image;
  std::string problem;  ///< why it cannot be read; empty if it can
};

/// Reads each file that a `picture` names as its `file`, once, and attaches it to all values that
/// name it. Paths begin at `folder`. Throws SceneError at the first picture with which the rows of
/// all are larger than the text of a scene may be.
void read_picture_files(Value& root, const std::string& folder);

}  // namespace clca::scene
