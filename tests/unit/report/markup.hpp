#pragma once
// Whether a page is well-formed: not a validator, but what breaks a page breaks this.

#include <string>
#include <string_view>

namespace clca::testing {

/// What is wrong with the tags of an HTML page, empty where each is closed in its order, has
/// attributes that are closed, and no id comes twice.
std::string markup_error(std::string_view html);

}  // namespace clca::testing
