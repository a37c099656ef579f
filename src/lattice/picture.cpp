#include "clca/lattice/picture.hpp"

#include <algorithm>

#include "lattice/internal/require.hpp"

namespace clca::lattice {

namespace {

/// Which of `count` equal parts holds the point at this share of the whole.
std::size_t part_of(double share, std::size_t count) {
  return std::min(static_cast<std::size_t>(share * static_cast<double>(count)), count - 1);
}

/// Which of `count` rows of pixels is at this height, which of `count` columns at this x.
std::size_t row_at(const Rectangle& box, double y, std::size_t count) {
  return part_of((box.top - y) / (box.top - box.bottom), count);
}
std::size_t column_at(const Rectangle& box, double x, std::size_t count) {
  return part_of((x - box.left) / (box.right - box.left), count);
}

void check_pixels(const std::vector<std::string>& rows) {
  require(!rows.empty() && !rows.front().empty() &&
              std::ranges::all_of(
                  rows, [&](const std::string& row) { return row.size() == rows.front().size(); }),
          "a picture needs pixels, in rows of one length");
}

}  // namespace

char pixel_at(const Picture& picture, const Eigen::Vector2d& point) {
  require(!picture.rows.empty() && !picture.rows.front().empty(), "a picture needs pixels");
  const std::string& row = picture.rows[row_at(picture.box, point.y(), picture.rows.size())];
  return row[column_at(picture.box, point.x(), row.size())];
}

std::vector<Site> sites_in(const SweptRegion& swept_region, const Picture& picture) {
  check_pixels(picture.rows);
  std::vector<Site> sites = sites_in(swept_region, picture.box);
  std::erase_if(sites,
                [&](Site site) { return pixel_at(picture, position(site)) != Picture::kDark; });
  return sites;
}

bool holds_no_site(const Lattice& lattice, const Picture& picture) {
  const Rectangle& box = picture.box;
  const std::vector<std::string>& rows = picture.rows;
  check_pixels(rows);
  // Columns of one parity have their sites at the same heights.
  for (const int parity : {0, 1}) {
    std::vector<bool> columns_with_sites(rows.front().size(), false);
    for (int column = parity; column < lattice.columns(); column += 2) {
      if (const double x = position(Site{column, 0}).x(); x >= box.left && x < box.right) {
        columns_with_sites[column_at(box, x, rows.front().size())] = true;
      }
    }
    std::vector<bool> rows_with_sites(rows.size(), false);
    for (int row = 0; row < lattice.rows(); ++row) {
      if (const double y = position(Site{parity, row}).y(); y >= box.bottom && y < box.top) {
        rows_with_sites[row_at(box, y, rows.size())] = true;
      }
    }
    for (std::size_t y = 0; y < rows.size(); ++y) {
      for (std::size_t x = 0; rows_with_sites[y] && x < rows[y].size(); ++x) {
        if (rows[y][x] == Picture::kDark && columns_with_sites[x]) {
          return false;
        }
      }
    }
  }
  return true;
}

}  // namespace clca::lattice
