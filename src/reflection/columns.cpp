#include "clca/reflection/columns.hpp"

namespace clca::reflection {

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

}  // namespace clca::reflection
