#pragma once
// Contact normals of all pairs of kinds and relative positions, each computed once.

#include <vector>

#include "clca/grains/state.hpp"
#include "contact/rule/bodies.hpp"

namespace clca::contact {

class NormalTable {
 public:
  explicit NormalTable(const std::vector<grains::Kind>& kinds)
      : kinds_(kinds), tables_(kinds.size() * kinds.size()) {}

  /// normal_between() of the kinds; zero if they do not touch.
  UnitVector normal(std::uint16_t first, std::uint16_t second, lattice::Axial apart) {
    Table& table = tables_[first * kinds_.size() + second];
    if (table.normals.empty()) {
      make(table, kinds_[first].shape, kinds_[second].shape);
    }
    const lattice::Axial at = apart - table.low;
    if (at.x < 0 || at.q < 0 || at.x >= table.columns || at.q >= table.rows) {
      return {};
    }
    UnitVector& normal =
        table.normals[static_cast<std::size_t>(at.x) * static_cast<std::size_t>(table.rows) +
                      static_cast<std::size_t>(at.q)];
    if (normal == kUnknown) {
      normal =
          normal_between(kinds_[first].shape, kinds_[second].shape, apart).value_or(UnitVector());
    }
    return normal;
  }

 private:
  struct Table {
    lattice::Axial low;
    int columns = 0;
    int rows = 0;
    std::vector<UnitVector> normals;  // by column of `apart`, then by row
  };
  static constexpr UnitVector kUnknown = {1, 1};

  static void make(Table& table, const lattice::Shape& first, const lattice::Shape& second);

  const std::vector<grains::Kind>& kinds_;
  std::vector<Table> tables_;  // by first kind, then by second
};

}  // namespace clca::contact
