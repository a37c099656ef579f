#include "clca/lattice/region.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "lattice/internal/require.hpp"

namespace clca::lattice {

namespace {

double distance(const Segment& segment, const Eigen::Vector2d& point) {
  const Eigen::Vector2d along = segment.to - segment.from;
  const double square = along.squaredNorm();
  const double share =
      square > 0 ? std::clamp((point - segment.from).dot(along) / square, 0.0, 1.0) : 0.0;
  return (point - segment.from - share * along).norm();
}

constexpr double kMaxCoordinate = 1e8;  // lattice spacings

void check_coordinates(const Eigen::Vector2d& point) {
  require(std::abs(point.x()) < kMaxCoordinate && std::abs(point.y()) < kMaxCoordinate,
          "a point is too far from the lattice");
}

/// A range of t within [0, 1]; empty if begin > end.
struct ParameterRange {
  double begin = 0;
  double end = 1;
};

/// The t at which `from` + t `along` is between `low` and `high`.
ParameterRange range_between(double from, double along, double low, double high) {
  if (along == 0) {
    return low <= from && from <= high ? ParameterRange{} : ParameterRange{1, 0};
  }
  const double enter = (low - from) / along;
  const double leave = (high - from) / along;
  return {std::max(0.0, std::min(enter, leave)), std::min(1.0, std::max(enter, leave))};
}

/// The chain of neighbouring sites between the ends, at least the part inside the swept region.
std::vector<Site> chain_along(const SweptRegion& swept_region, const Segment& segment) {
  const Site first = nearest_site(segment.from);
  const Site last = nearest_site(segment.to);
  const int steps = std::max(1, length_in_steps(last - first));
  const Eigen::Vector2d start = position(first);
  const Eigen::Vector2d along = position(last) - start;
  constexpr double kBeyond = 2;  // further out lies no point nearest to a site of the swept region
  const RowRange rows = swept_region.enclosing_rows();
  const ParameterRange across =
      range_between(start.x(), along.x(), kColumnPitch * swept_region.first_column() - kBeyond,
                    kColumnPitch * swept_region.end_column() + kBeyond);
  const ParameterRange upwards =
      range_between(start.y(), along.y(), rows.first_row - kBeyond, rows.end_row + kBeyond);
  const double begin = std::floor(std::max(across.begin, upwards.begin) * steps);
  const double end = std::ceil(std::min(across.end, upwards.end) * steps);
  std::vector<Site> chain;
  for (int i = clamped_floor(begin, 0, steps); i <= end; ++i) {
    // The nudge keeps points that lie exactly between two sites on one side of the line.
    const Eigen::Vector2d nudge(1e-6, 2e-6);
    chain.push_back(nearest_site(start + along * (static_cast<double>(i) / steps) + nudge));
  }
  return chain;
}

/// Index of the one of `count` equal parts that holds the point at this share of the whole.
std::size_t part_of(double share, std::size_t count) {
  return std::min(static_cast<std::size_t>(share * static_cast<double>(count)), count - 1);
}

/// Index of the one of `count` rows of pixels at this height, of the one of `count` columns at x.
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

SweptRegion::SweptRegion(const Lattice& lattice, Direction direction, int low, int high)
    : lattice_(lattice),
      step_(unit(direction)),
      low_(low),
      high_(high),
      first_column_(0),
      end_column_(lattice.columns()) {
  if (!lattice.periodic()) {
    first_column_ -= std::max(step_.x * low, step_.x * high);
    end_column_ -= std::min(step_.x * low, step_.x * high);
  }
}

int SweptRegion::rise(int column, int steps) const {
  return (Site{column, 0} + Axial{step_.x * steps, step_.q * steps}).row;
}

RowRange SweptRegion::rows(int column) const {
  int from = low_;
  int to = high_;
  if (!lattice_.periodic() && step_.x != 0) {
    // Steps after which the column is in the box.
    const auto [enter, leave] =
        std::minmax({-step_.x * column, step_.x * (lattice_.columns() - 1 - column)});
    from = std::max(from, enter);
    to = std::min(to, leave);
  }
  if (from > to) {
    return {};
  }
  // A step raises by at most one row, so that the rows of consecutive steps are contiguous.
  const auto [least, most] = std::minmax({rise(column, from), rise(column, to)});
  return {-most, lattice_.rows() - least};
}

RowRange SweptRegion::enclosing_rows() const {
  // All columns of one parity rise alike.
  const auto [least, most] =
      std::minmax({rise(0, low_), rise(0, high_), rise(1, low_), rise(1, high_)});
  return {-most, lattice_.rows() - least};
}

bool SweptRegion::contains(Site site) const {
  if (site.column < first_column_ || site.column >= end_column_) {
    return false;
  }
  const RowRange inside = rows(site.column);
  return site.row >= inside.first_row && site.row < inside.end_row;
}

Site nearest_site(const Eigen::Vector2d& point) {
  check_coordinates(point);
  const int left = static_cast<int>(std::floor(point.x() / kColumnPitch));
  Site best;
  double least = INFINITY;
  for (const int column : {left, left + 1}) {
    const double shift = is_odd(column) ? 0.5 : 0.0;
    const Site site = {column, static_cast<int>(std::lround(point.y() - shift))};
    const double square = (position(site) - point).squaredNorm();
    if (square < least) {
      least = square;
      best = site;
    }
  }
  return best;
}

void check_valid(const Rectangle& rectangle) {
  for (const double edge : {rectangle.left, rectangle.bottom, rectangle.right, rectangle.top}) {
    require(!std::isnan(edge), "an edge of a rectangle is not a number");
  }
}

Rectangle bounding_rectangle(const Segment& segment) {
  const double reach = segment.thickness + 1;
  const Eigen::Vector2d low = segment.from.cwiseMin(segment.to);
  const Eigen::Vector2d high = segment.from.cwiseMax(segment.to);
  return {low.x() - reach, low.y() - reach, high.x() + reach, high.y() + reach};
}

std::vector<Site> sites_in(const SweptRegion& swept_region, const Rectangle& rectangle) {
  check_valid(rectangle);
  std::vector<Site> sites;
  any_site(swept_region, rectangle, [&](Site site) {
    sites.push_back(site);
    return false;
  });
  return sites;
}

std::vector<Site> sites_along(const SweptRegion& swept_region, const Segment& segment) {
  check_coordinates(segment.from);
  check_coordinates(segment.to);
  require(segment.thickness >= 0 && segment.thickness < kMaxCoordinate,
          "the thickness of a wall must not be negative");
  const double reach = 0.5 * segment.thickness;
  const double margin = reach + 1e-6;  // rounding must not lose a site
  const Eigen::Vector2d along = segment.to - segment.from;
  const auto part_of_column = [&](int column) {
    const double x = kColumnPitch * column;
    const ParameterRange part = range_between(segment.from.x(), along.x(), x - margin, x + margin);
    if (part.begin > part.end) {
      return std::array{std::pair<double, double>(INFINITY, -INFINITY)};
    }
    const auto [low, high] = std::minmax(
        {segment.from.y() + part.begin * along.y(), segment.from.y() + part.end * along.y()});
    return std::array{std::pair(low - margin, high + margin)};
  };
  const auto [left, right] = std::minmax({segment.from.x(), segment.to.x()});
  std::vector<Site> sites;
  any_site(swept_region, left - reach, right + reach, part_of_column, [&](Site site) {
    if (distance(segment, position(site)) <= reach) {
      sites.push_back(site);
    }
    return false;
  });
  for (const Site site : chain_along(swept_region, segment)) {
    if (swept_region.contains(site)) {
      sites.push_back(site);
    }
  }
  std::ranges::sort(sites);
  sites.erase(std::unique(sites.begin(), sites.end()), sites.end());
  return sites;
}

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
