// Fills: what a stage places, and where.

#include <algorithm>

#include "scene/sections.hpp"
#include "scene/types.hpp"

namespace clca::scene {

namespace {

constexpr char kEmptyPixel = '.';
constexpr std::size_t kMaxParts = 26;               // letters
constexpr std::size_t kMaxPartWeights = 2'000'000;  // parts by species, of all fills

bool is_part_letter(char pixel) {
  return pixel >= grains::Mixture::kFirstPart && pixel <= 'Z';
}

using Weights = std::vector<std::uint32_t>;

/// The name of a species, or weights by species.
Type<Weights> part_type() {
  return or_map("", R"({"type": "string"})", weights_type(), [](const PlacedValue& place) {
    Weights weights(place.scene.species.size(), 0);
    weights[read_species(place)] = 1;
    return weights;
  });
}

char letter(std::size_t part) {
  return static_cast<char>(grains::Mixture::kFirstPart + static_cast<char>(part));
}

/// The nearest colour, of which white is empty; of equally near ones the first.
char pixel_of(image::Rgb color, const std::vector<image::Rgb>& colors) {
  const auto distance = [&](const image::Rgb& other) {
    const int red = color.red - other.red;
    const int green = color.green - other.green;
    const int blue = color.blue - other.blue;
    return red * red + green * green + blue * blue;
  };
  char pixel = kEmptyPixel;
  int nearest = distance({255, 255, 255});
  for (std::size_t part = 0; part < colors.size(); ++part) {
    if (distance(colors[part]) < nearest) {
      nearest = distance(colors[part]);
      pixel = letter(part);
    }
  }
  return pixel;
}

/// Reads `file` and `colors`, which stand for `rows` and `pixels`.
void read_file(const PlacedValue& fields, FillPicture& picture) {
  constexpr std::array<std::string_view, 2> kSources = {"file", "rows"};
  if (fields.only_key(kSources) != "file") {
    return;
  }
  const PlacedValue place = fields.at("colors");
  const std::vector<Entry>& entries = read_map(place);
  if (entries.empty() || entries.size() > kMaxParts) {
    fail(place, "expected 1 to {} colours, found {}", kMaxParts, entries.size());
  }
  std::vector<image::Rgb> colors;
  for (const Entry& entry : entries) {
    picture.weights_by_letter[letter(colors.size())] = part_type().read(place.at(entry));
    const Value color = Value::scalar(entry.key, entry.location);
    colors.push_back(color_type().read({color, place.path, place.scene}));
  }
  read_rows(fields.at("file"), picture.rows,
            [&](image::Rgb color) { return pixel_of(color, colors); });
}

/// Read with the file.
Key<FillPicture> colors_key() {
  return custom_key<FillPicture>(
             "colors",
             {.allowed = "map of colours",
              .schema = with(object_schema(part_type().schema, "^#[0-9A-Fa-f]{6}$"),
                             fmt::format(R"("minProperties": 1, "maxProperties": {})", kMaxParts))},
             "of a file: by colour, such as `\"#d55e00\"`, a species or weights by species; a "
             "pixel has the nearest of these colours, or is white and stays empty")
      .with_condition("goes with `file`");
}

using Parts = std::map<char, Weights>;

Type<Parts> pixels_type() {
  const Type<Weights> part = part_type();
  return custom_type<Parts>(
      "map of letters", with(object_schema(part.schema, "^[A-Z]$"), R"("minProperties": 1)"),
      [=](const PlacedValue& place) {
        Parts weights;
        for (const Entry& entry : read_map(place)) {
          if (entry.key.size() != 1 || !is_part_letter(entry.key.front())) {
            fail(entry.location, "{}: expected a letter from A to Z, found {}", place.path,
                 text::quoted(entry.key));
          }
          weights[entry.key.front()] = part.read(place.at(entry));
        }
        return weights;
      },
      [=](const Parts& weights, const Scene& scene) {
        Value map = Value::map();
        for (const auto& [pixel, weights_of_pixel] : weights) {
          map.add(std::string(1, pixel), part.text(weights_of_pixel, scene));
        }
        return map;
      });
}

void check_part_weights(const PlacedValue& fields) {
  std::size_t parts = 0;
  for (const Stage& stage : fields.scene.stages) {
    parts += stage.fill && stage.fill->picture ? stage.fill->picture->weights_by_letter.size() : 0;
  }
  if (parts * fields.scene.species.size() > kMaxPartWeights) {
    const char* key = fields.find("file") != nullptr ? "colors" : "pixels";
    fail(fields.at(key),
         "the pictures of all fills have more than {} weights, one for each part and species",
         kMaxPartWeights);
  }
}

void check_picture(const PlacedValue& fields, FillPicture& picture) {
  const bool file = fields.find("file") != nullptr;
  const char* foreign = file ? "pixels" : "colors";
  if (fields.find(foreign) != nullptr) {
    fail(fields.at(foreign), "goes with '{}'", file ? "rows" : "file");
  }
  if (!file) {
    fields.at("pixels");
  }
  check_part_weights(fields);
  for (const std::string& row : picture.rows) {
    for (const char pixel : row) {
      if (pixel != kEmptyPixel && !picture.weights_by_letter.contains(pixel)) {
        fail(fields.at("pixels"), "no species for the pixels {}", pixel);
      }
    }
  }
}

Type<FillPicture> picture() {
  const auto allowed = [](char pixel) { return pixel == kEmptyPixel || is_part_letter(pixel); };
  return type_of<FillPicture>(
      {.keys = {picture_file_key(read_file), colors_key(),
                key("rows", &FillPicture::rows,
                    rows_type(allowed, "the letters A to Z and .", "^[A-Z.]+$"),
                    "the same as text, from the top: a letter for each part, `.` for what stays "
                    "empty")
                    .with_condition("this or `file`"),
                key("pixels", &FillPicture::weights_by_letter, pixels_type(),
                    "of rows: by letter, a species or weights by species")
                    .with_condition("goes with `rows`")},
       .check = check_picture,
       .schema_members =
           R"("oneOf": [{"required": ["file", "colors"]}, {"required": ["rows", "pixels"]}])"});
}

void check_keys_of_fill(const PlacedValue& fields, Fill& fill) {
  fill.location = location_text(fields);
  if (!fill.level) {
    return;
  }
  const PlacedValue level = fields.at("level");
  if (fill.species_weights.empty() || fill.method != FillMethod::deposition) {
    fail(level, "needs a mix and 'method: deposition'");
  }
  if (*fill.level > fill.region.top || *fill.level <= fill.region.bottom) {
    fail(level, "expected a height in the region, above {} and up to {}, found {}",
         fill.region.bottom, fill.region.top, *fill.level);
  }
}

}  // namespace

Type<Fill> fill_type() {
  return type_of<Fill>(
      {.keys = {key("method", &Fill::method, choice_type(kFillMethodNames),
                    "a rain that falls in the steps that follow, or a packing at rest"),
                required_key("region", &Fill::region, region_type(),
                             "where: no particle sticks out of it"),
                list_key("counts", &Fill::species_counts, counts_type(kMaxParticles),
                         "number of particles; 0 for species that are not named")
                    .with_condition("one of these three"),
                list_key("mix", &Fill::species_weights, weights_type(),
                         "weights by species: fills the region until the next particle has no room")
                    .with_condition("one of these three"),
                key("picture", &Fill::picture, picture(),
                    "covers the region and says where which species are; each part is filled until "
                    "the next particle has no room")
                    .with_condition("one of these three"),
                key("level", &Fill::level, length_type(number_type(0, kMaxBoxHeight)),
                    "of a `mix` with `method: deposition`: mean height of its surface where the "
                    "filling ends")
                    .defaults_to("until the region is full")},
       .one_of = {"counts", "mix", "picture"},
       .check = check_keys_of_fill});
}

std::optional<grains::Mixture> mixture_of(const Fill& fill) {
  if (!fill.species_counts.empty()) {
    return std::nullopt;
  }
  grains::Mixture mixture = {.deposited = fill.method == FillMethod::deposition,
                             .surface_level = fill.level};
  if (!fill.picture) {
    mixture.part_weights = {fill.species_weights};
    return mixture;
  }
  mixture.picture_rows = fill.picture->rows;
  std::map<char, char> renamed;
  for (const auto& [pixel, weights] : fill.picture->weights_by_letter) {
    renamed[pixel] = letter(mixture.part_weights.size());
    mixture.part_weights.push_back(weights);
  }
  for (std::string& row : mixture.picture_rows) {
    for (char& pixel : row) {
      pixel = renamed.contains(pixel) ? renamed[pixel] : pixel;
    }
  }
  return mixture;
}

bool places_species(const Fill& fill, std::size_t species) {
  if (fill.picture) {
    return std::ranges::any_of(fill.picture->weights_by_letter,
                               [&](const auto& part) { return part.second[species] > 0; });
  }
  return fill.species_counts.empty() ? fill.species_weights[species] > 0
                                     : fill.species_counts[species] > 0;
}

}  // namespace clca::scene
