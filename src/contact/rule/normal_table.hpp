#pragma once
// Contact normals of all pairs of kinds and relative positions, each computed once.

#include <vector>

#include "clca/grains/state.hpp"
#include "contact/rule/bodies.hpp"
#include "grains/internal/apart_table.hpp"

namespace clca::contact {

class NormalTable {
 public:
  explicit NormalTable(const std::vector<grains::Kind>& kinds)
      : kinds_(kinds), tables_(kinds.size() * kinds.size()) {}

  /// normal_between() of the kinds; zero if they do not touch.
  UnitVector normal(std::uint16_t first, std::uint16_t second, lattice::Axial apart) {
    grains::ApartTable<UnitVector>& table = tables_[first * kinds_.size() + second];
    if (table.is_empty()) {
      table = {kinds_[first].shape, kinds_[second].shape, kUnknown};
    }
    UnitVector* normal = table.find(apart);
    if (normal == nullptr) {
      return {};
    }
    if (*normal == kUnknown) {
      *normal =
          normal_between(kinds_[first].shape, kinds_[second].shape, apart).value_or(UnitVector());
    }
    return *normal;
  }

 private:
  static constexpr UnitVector kUnknown = {1, 1};

  const std::vector<grains::Kind>& kinds_;
  std::vector<grains::ApartTable<UnitVector>> tables_;  // by first kind, then by second
};

}  // namespace clca::contact
