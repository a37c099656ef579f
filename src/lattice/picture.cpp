#include "clca/lattice/picture.hpp"

#include <algorithm>
#include <stdexcept>

namespace clca::lattice {

namespace {

/// Which of `count` equal parts holds the point at this share of the whole.
std::size_t part_at(double share, std::size_t count) {
  return std::min(static_cast<std::size_t>(share * static_cast<double>(count)), count - 1);
}

}  // namespace

char pixel_at(const Picture& picture, const Eigen::Vector2d& point) {
  if (picture.rows.empty() || picture.rows.front().empty()) {
    throw std::invalid_argument("a picture needs pixels");
  }
  const Rectangle& box = picture.box;
  const std::string& row =
      picture.rows[part_at((box.top - point.y()) / (box.top - box.bottom), picture.rows.size())];
  return row[part_at((point.x() - box.left) / (box.right - box.left), row.size())];
}

std::vector<Site> sites_in(const SweptRegion& swept_region, const Picture& picture) {
  if (std::any_of(picture.rows.begin(), picture.rows.end(),
                  [](const std::string& row) { return row.empty(); }) ||
      picture.rows.empty()) {
    throw std::invalid_argument("a picture needs pixels");
  }
  std::vector<Site> sites = sites_in(swept_region, picture.box);
  std::erase_if(sites,
                [&](Site site) { return pixel_at(picture, position(site)) != Picture::kDark; });
  return sites;
}

bool holds_no_site(const Lattice& lattice, const Picture& picture) {
  return sites_in(SweptRegion(lattice), picture).empty();
}

}  // namespace clca::lattice
