// A table: refused with a line, or the same once written and read again.

#include <string>

#include "clca/store/file.hpp"
#include "clca/store/table.hpp"
#include "scratch_file.hpp"

namespace {

namespace fuzz = clca::fuzz;
namespace store = clca::store;

std::string written(const store::ParsedTable& read) {
  store::Table table(read.column_names);
  for (std::size_t row = 0; row < read.row_count(); ++row) {
    std::vector<store::Cell> cells;
    for (const auto& column : read.cells) {
      cells.emplace_back(column[row]);
    }
    table.add_row(std::move(cells));
  }
  return table.to_csv();
}

void read_numbers(const store::ParsedTable& table) {
  for (const std::string& name : table.column_names) {
    try {
      fuzz::require(table.column_numbers(name).size() == table.row_count(),
                    "not a number for each row");
    } catch (const store::StoreError&) {
      continue;
    }
  }
}

void require_same_again(const store::ParsedTable& table, const fuzz::ScratchFile& file) {
  try {
    file.hold(written(table));
    const store::ParsedTable again = store::read_table(file.path());
    fuzz::require(again.column_names == table.column_names && again.cells == table.cells,
                  "another table");
  } catch (const store::StoreError& error) {
    fuzz::found(error.what());
  }
}

}  // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const fuzz::ScratchFile file;
  file.hold({data, size});
  try {
    const store::ParsedTable table = store::read_table(file.path());
    read_numbers(table);
    require_same_again(table, file);
  } catch (const store::StoreError&) {
    return 0;
  }
  return 0;
}
