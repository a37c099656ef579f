#include "render/site_texture.hpp"

#include <algorithm>
#include <cmath>

namespace clca::render {

namespace {

// Heights of the corners of a lattice triangle differ from those of its points by less than one
// spacing, and an odd column stands half a spacing higher than its rows say.
constexpr int kRowsBelow = 2;
constexpr int kRowsAbove = 1;
constexpr int kColumnsRight = 1;

SiteWindow window_around(const lattice::Lattice& lattice, int column, int row, int columns,
                         int rows) {
  const auto column_of = [&](int value) { return std::clamp(value, -1, lattice.columns()); };
  const auto row_of = [&](int value) { return std::clamp(value, -1, lattice.rows()); };
  return {column_of(column), column_of(column + columns - 1 + kColumnsRight),
          row_of(row - kRowsBelow), row_of(row + rows - 1 + kRowsAbove)};
}

}  // namespace

std::vector<Tile> tiles(const lattice::Lattice& lattice, const lattice::Rectangle& area,
                        int largest) {
  if (!(area.left < area.right && area.bottom < area.top)) {
    return {};
  }
  const auto below = [](double value) { return static_cast<int>(std::floor(value)); };
  const int first_column = below(area.left / lattice::kColumnPitch);
  const int last_column = below(area.right / lattice::kColumnPitch);
  const int first_row = below(area.bottom);
  const int last_row = below(area.top);
  const int columns = largest - kColumnsRight;
  const int rows = largest - kRowsBelow - kRowsAbove;
  std::vector<Tile> result;
  for (int column = first_column; column <= last_column; column += columns) {
    for (int row = first_row; row <= last_row; row += rows) {
      const int width = std::min(columns, last_column + 1 - column);
      const int height = std::min(rows, last_row + 1 - row);
      const lattice::Rectangle part = {
          .left = std::max(area.left, column * lattice::kColumnPitch),
          .bottom = std::max(area.bottom, static_cast<double>(row)),
          .right = std::min(area.right, (column + width) * lattice::kColumnPitch),
          .top = std::min(area.top, static_cast<double>(row + height))};
      result.push_back({part, window_around(lattice, column, row, width, height)});
    }
  }
  return result;
}

SiteTexture::SiteTexture(const Gl& gl, const lattice::Lattice& lattice)
    : gl_(&gl),
      lattice_(lattice),
      stride_(static_cast<GLint>(lattice.index({1, 0}) - lattice.index({0, 0}))),
      name_(gl.texture()) {}

void SiteTexture::upload_block(int column, int row, int columns, int rows,
                               const automaton::Owner* owners) {
  gl_->TexSubImage2D(GL_TEXTURE_2D, 0, row, column, rows, columns, GL_RED_INTEGER, GL_INT, owners);
}

void SiteTexture::upload(const automaton::Occupancy& occupancy, const SiteWindow& window) {
  gl_->BindTexture(GL_TEXTURE_2D, name_);
  if (columns_ != window.columns() || rows_ != window.rows()) {
    columns_ = window.columns();
    rows_ = window.rows();
    gl_->TexImage2D(GL_TEXTURE_2D, 0, GL_R32I, rows_, columns_, 0, GL_RED_INTEGER, GL_INT, nullptr);
    gl_->check("a texture of sites");
  }
  // Not Lattice::index, which wraps.
  const auto column_start =
      static_cast<std::size_t>(window.first_column + 1) * static_cast<std::size_t>(stride_);
  const std::vector<automaton::Owner> owners = occupancy.owners();
  gl_->PixelStorei(GL_UNPACK_ROW_LENGTH, stride_);
  upload_block(0, 0, columns_, rows_,
               owners.data() + column_start + (window.first_row + 1));
  gl_->PixelStorei(GL_UNPACK_ROW_LENGTH, 0);
  if (lattice_.periodic()) {
    repeat_seam(occupancy, window);
  }
  open_lid(window);
}

void SiteTexture::repeat_seam(const automaton::Occupancy& occupancy, const SiteWindow& window) {
  const std::vector<automaton::Owner> owners = occupancy.owners();
  for (const int column : {-1, lattice_.columns()}) {
    if (column >= window.first_column && column <= window.last_column) {
      const std::size_t start = lattice_.index({column, window.first_row});
      upload_block(column - window.first_column, 0, 1, rows_, owners.data() + start);
    }
  }
}

void SiteTexture::mark(std::span<const lattice::Site> sites, const SiteWindow& window) {
  gl_->BindTexture(GL_TEXTURE_2D, name_);
  std::size_t first = 0;
  for (std::size_t i = 1; i <= sites.size(); ++i) {
    const lattice::Site above = {sites[i - 1].column, sites[i - 1].row + 1};
    if (i < sites.size() && sites[i] == above) {
      continue;
    }
    const int image = lattice_.periodic() ? lattice_.columns() : 0;
    for (int column = sites[first].column - image; column <= sites[first].column + image;
         column += std::max(image, 1)) {
      mark_run({column, sites[first].row}, static_cast<int>(i - first), window);
    }
    first = i;
  }
}

void SiteTexture::mark_run(lattice::Site lowest, int length, const SiteWindow& window) {
  const int low = std::max(lowest.row, window.first_row);
  const int high = std::min(lowest.row + length - 1, window.last_row);
  if (lowest.column < window.first_column || lowest.column > window.last_column || low > high) {
    return;
  }
  const std::vector<automaton::Owner> codes(static_cast<std::size_t>(high - low + 1), kMovingWall);
  upload_block(lowest.column - window.first_column, low - window.first_row, 1, high - low + 1,
               codes.data());
}

void SiteTexture::open_lid(const SiteWindow& window) {
  if (window.last_row < lattice_.rows()) {
    return;
  }
  // Side walls reach up to the rim.
  const int side = lattice_.periodic() ? 1 : 0;
  const int first = std::max(window.first_column, -side);
  const int last = std::min(window.last_column, lattice_.columns() - 1 + side);
  if (first <= last) {
    const std::vector<automaton::Owner> free(static_cast<std::size_t>(last - first + 1),
                                             automaton::kFree);
    upload_block(first - window.first_column, rows_ - 1, last - first + 1, 1, free.data());
  }
}

}  // namespace clca::render
