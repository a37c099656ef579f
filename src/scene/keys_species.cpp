// Species: shapes, orientations, colours.

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "clca/scene/walls.hpp"
#include "scene/sections.hpp"
#include "scene/sizes.hpp"
#include "scene/types.hpp"

namespace clca::scene {

namespace {

constexpr int kMaxRadius = 100;
constexpr std::size_t kMaxSites = 100'000;       // of a shape
constexpr std::size_t kMaxAllSites = 2'000'000;  // of the shapes of all species
constexpr std::size_t kMaxCorners = 1000;
constexpr double kMaxLength = 1000;  // spacings, of a shape

/// Of `[x, q]`, each once.
Type<std::vector<lattice::Axial>> sites(std::size_t least, std::size_t most) {
  const auto site =
      list_of_members("", integer_type(-1000, 1000), &lattice::Axial::x, &lattice::Axial::q);
  auto type = set_type(site, least, most, flow_text);
  type.allowed = fmt::format("{} to {} `[x, q]`", least, most);
  return type;
}

Type<RodSpec> rod() {
  return type_of<RodSpec>(
      {.keys = {required_key("radius", &RodSpec::radius, integer_type(0, kMaxRadius),
                             "radius of the hexagons"),
                required_key("length", &RodSpec::length, integer_type(1, 1000),
                             "number of sites on the line")}});
}

Type<ShapeSpec> shape() {
  return one_of_type<ShapeSpec>(
      {alternative_key<ShapeSpec>(
           "hexagon", member_type(&HexagonSpec::radius, integer_type(0, kMaxRadius)),
           "all sites within that many steps of the centre: 0 is a single site, 1 has 7, 2 has 19"),
       alternative_key<ShapeSpec>(
           "disc", member_type(&DiscSpec::radius, length_type(number_type(0, kMaxRadius))),
           "all sites within that many spacings of the centre"),
       alternative_key<ShapeSpec>(
           "rectangle",
           list_of_members("`[width, height]`", length_type(positive_type(kMaxLength)),
                           &RectangleSpec::width, &RectangleSpec::height),
           "an upright rectangle, to the nearest number of columns and of sites "
           "in each"),
       alternative_key<ShapeSpec>(
           "outline",
           member_type(&OutlineSpec::corners, list_type(point_type(kMaxLength), 3, kMaxCorners)),
           "all sites whose centre lies on or inside the outline with these "
           "corners, in spacings to the right and upwards"),
       alternative_key<ShapeSpec>("sites", member_type(&SitesSpec::sites, sites(1, kMaxSites)),
                                  "these sites"),
       alternative_key<ShapeSpec>(
           "polygon", member_type(&PolygonSpec::corners, sites(3, kMaxCorners)),
           "all sites on and inside the outline with these sites as corners"),
       alternative_key<ShapeSpec>("rod", rod(), "hexagons on an upright line of sites")});
}

lattice::Shape build(const HexagonSpec& spec) {
  return lattice::Shape::hexagon(spec.radius);
}
lattice::Shape build(const DiscSpec& spec) {
  return lattice::Shape::disc(spec.radius);
}
lattice::Shape build(const SitesSpec& spec) {
  return lattice::Shape(spec.sites);
}
lattice::Shape build(const PolygonSpec& spec) {
  return lattice::Shape::polygon(spec.corners);
}
lattice::Shape build(const RectangleSpec& spec) {
  const auto columns =
      std::max(1, static_cast<int>(std::lround(spec.width / lattice::kColumnPitch)));
  const auto rows = std::max(1, static_cast<int>(std::lround(spec.height)));
  std::vector<lattice::Axial> sites;
  for (int x = 0; x < columns; ++x) {
    for (int row = 0; row < rows; ++row) {
      sites.push_back({x, row - x / 2});
    }
  }
  return lattice::Shape(sites);
}
/// Even-odd, as of a polygon; with those on the outline.
bool is_inside(const Eigen::Vector2d& point, const std::vector<Eigen::Vector2d>& corners) {
  constexpr double kRounding = 1e-6;
  bool inside = false;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Eigen::Vector2d& from = corners[i];
    const Eigen::Vector2d along = corners[(i + 1) % corners.size()] - from;
    const Eigen::Vector2d to_point = point - from;
    const double cross = along.x() * to_point.y() - along.y() * to_point.x();
    const double share = std::clamp(along.dot(to_point) / along.squaredNorm(), 0.0, 1.0);
    if ((to_point - share * along).norm() < kRounding) {
      return true;
    }
    if ((to_point.y() < 0) != (to_point.y() < along.y()) && (cross > 0) == (along.y() > 0)) {
      inside = !inside;
    }
  }
  return inside;
}
lattice::Shape build(const OutlineSpec& spec) {
  Eigen::AlignedBox2d box;
  for (const Eigen::Vector2d& corner : spec.corners) {
    box.extend(corner);
  }
  std::vector<lattice::Axial> sites;
  const auto first = static_cast<int>(std::floor(box.min().x() / lattice::kColumnPitch));
  for (int x = first; lattice::kColumnPitch * (x - 1) < box.max().x(); ++x) {
    const auto lowest = static_cast<int>(std::floor(box.min().y() - 0.5 * x));
    for (int q = lowest; q - 1 + 0.5 * x < box.max().y(); ++q) {
      if (is_inside(position(lattice::Axial{x, q}), spec.corners)) {
        sites.push_back({x, q});
      }
    }
  }
  return lattice::Shape(sites);
}
lattice::Shape build(const RodSpec& spec) {
  return lattice::Shape::rod(spec.radius, spec.length);
}

/// Twice the area, in sites. Pick: a polygon that does not cross itself has more sites than area.
double doubled_area(const PolygonSpec& spec) {
  double sum = 0;
  for (std::size_t i = 0; i < spec.corners.size(); ++i) {
    const lattice::Axial from = spec.corners[i];
    const lattice::Axial to = spec.corners[(i + 1) % spec.corners.size()];
    sum += static_cast<double>(from.x) * to.q - static_cast<double>(to.x) * from.q;
  }
  return std::abs(sum);
}

lattice::Shape build_checked(const ShapeSpec& spec) {
  const std::string message = fmt::format("expected a shape of at most {} sites", kMaxSites);
  const auto* polygon = std::get_if<PolygonSpec>(&spec);
  const auto* rectangle = std::get_if<RectangleSpec>(&spec);
  if ((polygon != nullptr && doubled_area(*polygon) > 2.0 * kMaxSites) ||
      (rectangle != nullptr &&
       rectangle->width * rectangle->height > kMaxSites * lattice::kColumnPitch)) {
    throw std::invalid_argument(message);  // before the sites are listed, which takes long
  }
  lattice::Shape shape = std::visit([](const auto& held) { return build(held); }, spec);
  if (shape.size() > kMaxSites) {
    throw std::invalid_argument(message);
  }
  return shape;
}

Type<std::vector<int>> orientations() {
  static const std::vector<int> kAll = {0, 60, 120, 180, 240, 300};
  Type<int> angle = integer_type(0, 360 - kOrientationStep)
                        .checked([](const int& degrees, const PlacedValue& place) {
                          if (degrees % kOrientationStep != 0) {
                            fail(place, "expected a multiple of 60, found {}", degrees);
                          }
                        });
  angle.schema = R"({"enum": [0, 60, 120, 180, 240, 300]})";
  const auto list = set_type(angle, 1, kAll.size(), flow_text);
  return custom_type<std::vector<int>>(
      "list of 0, 60, 120, 180, 240, 300, or `any`", any_of({word_schema("any"), list.schema}),
      [=](const PlacedValue& place) {
        if (place.value.text == "any") {
          return kAll;
        }
        if (!place.value.is(Value::Kind::list)) {
          fail(place, "expected any or a list of angles, found {}", found(place));
        }
        return list.read(place);
      },
      [=](const std::vector<int>& angles, const Scene& scene) {
        return angles == kAll ? Value::scalar("any") : list.text(angles, scene);
      });
}

image::Rgb read_color(const PlacedValue& place) {
  const std::string& text = place.value.text;
  const bool hexadecimal = text.size() == 7 && text.front() == '#' &&
                           text.find_first_not_of("0123456789abcdefABCDEF", 1) == std::string::npos;
  if (!hexadecimal) {
    fail(place, "expected a colour like \"#3a6ea5\", in quotes, found {}", found(place));
  }
  const auto part = [&](std::size_t start) {
    return static_cast<std::uint8_t>(std::stoi(text.substr(start, 2), nullptr, 16));
  };
  return {part(1), part(3), part(5)};
}

/// A particle that met itself across a periodic boundary would block itself.
void check_width(const Species& species, const PlacedValue& fields) {
  const Box& box = fields.scene.box;
  if (!box.periodic) {
    return;
  }
  const int columns = lattice_of(box).columns();
  for (const int degrees : species.orientations) {
    const std::vector<lattice::Axial> sites =
        species.shape.rotated(degrees / kOrientationStep).sites();
    const int width = sites.back().x - sites.front().x + 1;
    if (width >= columns) {
      fail(fields, "{} columns wide at {} degrees, too wide for a periodic box of {} columns",
           width, degrees, columns);
    }
  }
}

}  // namespace

Type<image::Rgb> color_type() {
  return custom_type<image::Rgb>("`\"#rrggbb\"`, in quotes", text_schema("^#[0-9A-Fa-f]{6}$"),
                                 read_color, [](const image::Rgb& color) {
                                   return Value::quoted_text(fmt::format(
                                       "#{:02x}{:02x}{:02x}", color.red, color.green, color.blue));
                                 });
}

Type<std::vector<Species>> species_type() {
  Map<Species> map = {
      .keys = {Key<Species>(any_key("shape", member_access(&Species::shape_spec), shape(),
                                    "the sites of a particle"))
                   .with_condition("this or `sizes`"),
               // Replaced by species with shapes before the keys are read; see expand_sizes.
               custom_key<Species>("sizes", sizes_type(),
                                   "round particles whose sizes follow a law: [sizes](#sizes)")
                   .with_condition("this or `shape`"),
               key("orientations", &Species::orientations, orientations(),
                   "angles it may start with, clockwise; one of them at random"),
               key("color", &Species::color, color_type(), "colour for `color_by: species`")
                   .defaults_to("palette"),
               key("sieve", &Species::sieve, number_type(0, 1),
                   "factor of the chance that a void takes such a grain and not another beside it")
                   .of(Model::voids)},
      .one_of = {"shape", "sizes"}};
  map.check = [](const PlacedValue& fields, Species& species) {
    try {
      species.shape = build_checked(species.shape_spec);
    } catch (const std::invalid_argument& error) {
      fail(fields.at("shape"), "{}", error.what());
    }
    std::size_t sites = 0;
    for (const Species& each : fields.scene.species) {
      sites += each.shape.size();
    }
    if (sites > kMaxAllSites) {
      fail(fields.at("shape"), "with this shape all species have more than {} sites", kMaxAllSites);
    }
    check_width(species, fields);
  };
  return by_name("species", map, 1);
}

}  // namespace clca::scene
