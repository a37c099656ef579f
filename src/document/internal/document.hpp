#pragma once
// Text as a tree of values: parsed by the only user of yaml-cpp, with overrides of the command line
// and expressions.

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "document/internal/value.hpp"

namespace clca::document {

inline constexpr std::size_t kMaxNameLength = 64;

/// Throws Error unless the text is UTF-8 without control characters, tabs (comments may hold some),
/// byte order mark and YAML directives, not larger than kMaxBytes, not with more than 32 brackets
/// inside each other and not with more than 260,000 values.
void check_text(std::string_view text, std::shared_ptr<const Origin> origin);

/// Reads the single document in `text`. Stricter than YAML: no duplicate or compound keys, anchors,
/// aliases, merge keys, tags, directives or further documents.
/// Without a document the value is nothing. Throws Error.
Value read_document(std::string_view text, std::shared_ptr<const Origin> origin);

/// Puts the value of `text` into the tree. In a map at a path that `is_choice`, which holds one key
/// out of several, a new key takes the place of the old one. Throws Error that names
/// `OPTION KEY=VALUE`.
void apply_override(Value& root, const std::string& text, std::string_view option,
                    bool (*is_choice)(const std::vector<std::string>& path));

/// Evaluates what stands under `let`, in its order, then replaces each `=EXPRESSION` of the tree
/// by its value. Keys at the top: nothing under `let` has a `taken` name, under the key `text`
/// there are no expressions; those under the key `open` may have other names, too.
/// Throws Error.
void evaluate_expressions(Value& root, const std::vector<std::string_view>& taken,
                          std::string_view text, std::string_view open);

/// Refuses the text of a value that cannot be an expression, whatever its names stand for. Throws
/// Error.
void check_expression(const Value& value);
/// The expression with numbers for the names that have one.
std::string with_numbers(
    std::string_view expression,
    const std::function<std::optional<double>(std::string_view name)>& number_of);
/// Whether names in expressions may be like this, of up to kMaxNameLength letters.
bool is_expression_name(const std::string& name);

}  // namespace clca::document
