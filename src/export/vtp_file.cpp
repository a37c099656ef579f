#include "export/vtp_file.hpp"

#include <fmt/format.h>

#include "clca/store/atomic_file.hpp"

namespace clca::exports {

namespace {

/// Arrays appended to the XML text, each after its length in bytes.
class Appended {
 public:
  /// The element that stands for the array.
  std::string element(std::string_view name, std::string_view type, int components,
                      const Bytes& numbers) {
    std::string text = fmt::format(
        R"(<DataArray Name="{}" type="{}" NumberOfComponents="{}" format="appended" offset="{}"/>)",
        name, type, components, size_);
    size_ += sizeof(std::uint64_t) + numbers.size();
    arrays_.push_back(&numbers);
    return text + "\n";
  }

  void write(store::AtomicFile& file) const {
    file.write("<AppendedData encoding=\"raw\">\n_");
    for (const Bytes* numbers : arrays_) {
      file.write(bytes_of(std::uint64_t{numbers->size()}));
      file.write(*numbers);
    }
    file.write("\n</AppendedData>\n");
  }

 private:
  std::size_t size_ = 0;
  std::vector<const Bytes*> arrays_;
};

}  // namespace

void VtpFile::add_corner(const Eigen::Vector2d& corner) {
  append_vector(points_, corner.x(), corner.y());
  append(connectivity_, corners_);
  ++corners_;
}

void VtpFile::end_polygon() {
  append(offsets_, corners_);
}

void VtpFile::add_cell_data(std::string_view name, std::string_view type, int components,
                            Bytes numbers) {
  cell_data_.push_back({std::string(name), std::string(type), components, std::move(numbers)});
}

// Texts are stored as character codes, each text terminated by a zero.
void VtpFile::set_names(std::string_view name, const std::vector<std::string>& texts) {
  names_ = fmt::format(R"(<DataArray Name="{}" type="String" NumberOfTuples="{}" format="ascii">)",
                       name, texts.size());
  for (const std::string& text : texts) {
    for (const char character : text) {
      names_ += fmt::format("{} ", static_cast<int>(character));
    }
    names_ += "0 ";
  }
  names_ += "</DataArray>\n";
}

std::string VtpFile::field_data() const {
  return fmt::format(
      "<FieldData>\n<DataArray Name=\"TimeValue\" type=\"Float64\" NumberOfTuples=\"1\" "
      "format=\"ascii\">{}</DataArray>\n{}</FieldData>\n",
      time_, names_);
}

void VtpFile::write(store::AtomicFile file) const {
  Appended appended;
  std::string text =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" "
      "byte_order=\"LittleEndian\" header_type=\"UInt64\">\n<PolyData>\n";
  text += field_data();
  text += fmt::format("<Piece NumberOfPoints=\"{}\" NumberOfPolys=\"{}\">\n<Points>\n", corners_,
                      offsets_.size() / sizeof(std::int64_t));
  text += appended.element("Points", "Float32", 3, points_);
  text += "</Points>\n<Polys>\n";
  text += appended.element("connectivity", "Int64", 1, connectivity_);
  text += appended.element("offsets", "Int64", 1, offsets_);
  text += "</Polys>\n<CellData>\n";
  for (const Array& array : cell_data_) {
    text += appended.element(array.name, array.type, array.components, array.numbers);
  }
  text += "</CellData>\n</Piece>\n</PolyData>\n";
  file.write(text);
  appended.write(file);
  file.write("</VTKFile>\n");
  file.finish();
}

}  // namespace clca::exports
