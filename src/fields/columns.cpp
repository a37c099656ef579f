#include "clca/fields/columns.hpp"

namespace clca::fields {

std::string difference(const Columns& a, const Columns& b) {
  for (const auto& [path, column] : a) {
    const auto found = b.find(path);
    if (found == b.end() || found->second != column) {
      return path;
    }
  }
  for (const auto& [path, column] : b) {
    if (!a.contains(path)) {
      return path;
    }
  }
  return "";
}

}  // namespace clca::fields
