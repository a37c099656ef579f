#pragma once
// What an H5MD file is made of: groups, attributes, datasets with a row for each frame. All
// functions throw as store::hdf5::check().

#include <string>
#include <string_view>
#include <vector>

#include "store/internal/hdf5.hpp"

namespace clca::exports {

using store::hdf5::Handle;
using Dimensions = std::vector<hsize_t>;

/// For `file`, which this process has locked.
Handle new_file(const std::string& file);
Handle new_group(const Handle& file, const std::string& path);
/// `size`: none is a single value.
void add_attribute(const Handle& object, const char* name, hid_t type, const Dimensions& size,
                   const void* values);
/// A text, or several of one length.
void add_texts(const Handle& object, const char* name, const std::vector<std::string_view>& texts);

/// A dataset that gets a row with each frame.
class GrowingDataset {
 public:
  /// `chunk`: how many rows, and numbers of a row, are stored together. `fill`: what rows have
  /// where later ones are longer; may be null.
  GrowingDataset(const Handle& file, const std::string& path, hid_t type, const Dimensions& chunk,
                 const void* fill);

  /// `size`: of the row; never less than of the last one.
  void append(const Dimensions& size, const void* row);
  const Handle& dataset() const { return dataset_; }

 private:
  hid_t type_;
  Handle dataset_;
  hsize_t rows_ = 0;
};

}  // namespace clca::exports
