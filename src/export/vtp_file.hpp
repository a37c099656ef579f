#pragma once
// One polygonal data set of VTK as an XML file with raw binary data behind it (VTK file formats,
// "PolyData", appended data).

#include <Eigen/Core>
#include <string>
#include <string_view>
#include <vector>

#include "clca/store/atomic_file.hpp"
#include "export/bytes.hpp"

namespace clca::exports {

class VtpFile {
 public:
  /// Of the polygon that is begun.
  void add_corner(const Eigen::Vector2d& corner);
  void end_polygon();

  /// A value for each polygon: `numbers` in groups of `components`. `type` as VTK names it.
  void add_cell_data(std::string_view name, std::string_view type, int components, Bytes numbers);
  /// In steps; for readers that play files one after the other.
  void set_time(double time) { time_ = time; }
  /// A list of texts that belongs to the whole.
  void set_names(std::string_view name, const std::vector<std::string>& texts);

  /// Throws store::StoreError.
  void write(store::AtomicFile file) const;

 private:
  struct Array {
    std::string name;
    std::string type;
    int components = 1;
    Bytes numbers;
  };

  std::string field_data() const;

  double time_ = 0;
  std::int64_t corners_ = 0;
  Bytes points_;
  Bytes connectivity_;
  Bytes offsets_;
  std::vector<Array> cell_data_;
  std::string names_;
};

}  // namespace clca::exports
