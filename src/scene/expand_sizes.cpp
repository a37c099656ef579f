// Species with sizes, replaced by species with shapes before the keys are read.

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "scene/sections.hpp"
#include "scene/sizes.hpp"
#include "scene/types.hpp"

namespace clca::scene {

namespace {

constexpr std::uint64_t kMaxWeightBesideSizes = 1000;  // where a species has sizes

/// The colour made lighter or darker: `darkness` is from 0 to 1.
std::string shade(const image::Rgb& color, double darkness) {
  constexpr double kLightest = 0.6;  // share of white
  constexpr double kDarkest = 0.5;   // of black
  const double white = std::max(0.0, kLightest * (1 - 2 * darkness));
  const double black = std::max(0.0, kDarkest * (2 * darkness - 1));
  const auto mixed = [&](double part) {
    return static_cast<int>(std::lround((part + (255 - part) * white) * (1 - black)));
  };
  return fmt::format("#{:02x}{:02x}{:02x}", mixed(color.red), mixed(color.green),
                     mixed(color.blue));
}

Value whole(double number, const TextLocation& location) {
  return Value::scalar(fmt::format("{:.0f}", number), location);
}

double amount_in(const Entry& entry, const std::string& path, std::uint64_t most) {
  return static_cast<double>(
      read_number<std::uint64_t>({entry.value, join_path(path, entry.key), Scene()}, 0, most));
}

/// Species with sizes, each replaced by its kinds.
class Expansion {
 public:
  Expansion(Value& species, const Scene& scene) {
    std::vector<Entry> entries;
    for (Entry& entry : species.entries) {
      species_names_.push_back(entry.key);
      const Value* sizes = entry.value.find("sizes");
      if (sizes == nullptr || entry.value.find("shape") != nullptr) {
        entries.push_back(std::move(entry));
        continue;
      }
      add_kinds(entry, *sizes, scene, entries);
    }
    for (const Entry& entry : entries) {
      if (std::ranges::count_if(entries,
                                [&](const Entry& other) { return other.key == entry.key; }) > 1) {
        fail(entry.location, "species.{}: a kind of a species with sizes has this name", entry.key);
      }
    }
    species.entries = std::move(entries);
  }

  bool empty() const { return sized_species_.empty(); }

  /// Divides a count among the kinds in whole numbers, the largest first. What rounding takes from
  /// a kind (by number or area, as the law) goes to the next one: the mean hardly changes.
  void divide_counts(Value& counts, const std::string& path) {
    divide(counts, [&](const Entry& entry, const SizedSpecies& sized) {
      const double all = amount_in(entry, path, kMaxParticles);
      if (all > 0 && all < static_cast<double>(sized.kinds.size())) {
        fail(entry.value.location, "{}: expected at least {}, one of each kind, found {}",
             join_path(path, entry.key), sized.kinds.size(), all);
      }
      std::vector<double> numbers(sized.kinds.size());
      double left = all;
      double carried = 0;
      for (std::size_t i = numbers.size() - 1; i > 0; --i) {
        const SizeClass& kind = sized.kinds[i];
        carried += kind.share * all * kind.weight_in_law;
        numbers[i] = std::clamp(std::round(carried / kind.weight_in_law), 0.0, left);
        carried -= numbers[i] * kind.weight_in_law;
        left -= numbers[i];
      }
      numbers.front() = left;
      return numbers;
    });
  }

  /// Weights are whole numbers; that of a kind is at least 1 if that of its species is. All are
  /// scaled up, so that rounding them changes shares as little as possible.
  void divide_weights(Value& weights, const std::string& path) {
    const auto weight_of = [&](const Entry& entry) {
      return amount_in(entry, path, kMaxWeightBesideSizes);
    };
    double largest = 1;
    for (const Entry& entry : weights.entries) {
      largest = std::max(largest, weight_of(entry));
    }
    const double scale = std::floor(static_cast<double>(kMaxSpeciesWeight) / largest);
    for (Entry& entry : weights.entries) {
      if (!sized_species_.contains(entry.key)) {
        entry.value = whole(scale * weight_of(entry), entry.value.location);
      }
    }
    divide(weights, [&](const Entry& entry, const SizedSpecies& sized) {
      const double weight = weight_of(entry);
      std::vector<double> numbers;
      for (const SizeClass& kind : sized.kinds) {
        numbers.push_back(std::max(std::min(weight, 1.0), std::round(scale * weight * kind.share)));
      }
      return numbers;
    });
  }

  /// Each species with the weight 1.
  Value equal_weights(const TextLocation& location) const {
    Value weights = Value::map(location);
    for (const std::string& name : species_names_) {
      weights.add(name, whole(1, location));
    }
    return weights;
  }

  /// The value of a colour or letter in fill.picture (colors, pixels): a species with sizes, or
  /// weights of species, becomes weights of its kinds.
  void divide_picture_part(Value& part, const std::string& path) {
    if (sized_species_.contains(part.text)) {
      Value weights = Value::map(part.location);
      weights.add(part.text, whole(1, part.location));
      part = weights;
    }
    if (part.is(Value::Kind::map)) {
      divide_weights(part, path);
    }
  }

  /// Of the species that are used, the kinds of which there are none.
  void leave_out_unused(Value& species) const {
    for (const auto& [name, sized] : sized_species_) {
      const auto is_unused = [&](const std::string& kind) { return !used_kinds_.contains(kind); };
      const std::vector<std::string>& kinds = sized.names;
      if (!std::ranges::all_of(kinds, is_unused)) {
        std::erase_if(species.entries, [&](const Entry& entry) {
          return is_unused(entry.key) && std::ranges::find(kinds, entry.key) != kinds.end();
        });
      }
    }
  }

 private:
  /// A species with sizes.
  struct SizedSpecies {
    std::vector<std::string> names;
    std::vector<SizeClass> kinds;
  };

  void add_kinds(const Entry& entry, const Value& sizes, const Scene& scene,
                 std::vector<Entry>& entries) {
    const std::string path = join_path("species", entry.key);
    check_name(entry.key, entry.location, "species");
    SizedSpecies& sized = sized_species_[entry.key];
    const SizeDistribution law = sizes_type().read({sizes, join_path(path, "sizes"), scene});
    sized.kinds = size_classes(law);
    // Blue, vermilion and green of the palette.
    constexpr std::array<image::Rgb, 3> kColors = {{{0, 114, 178}, {213, 94, 0}, {0, 158, 115}}};
    image::Rgb color = kColors[(sized_species_.size() - 1) % kColors.size()];
    if (const Value* own = entry.value.find("color")) {
      color = color_type().read({*own, join_path(path, "color"), Scene()});
    }
    const std::size_t count = sized.kinds.size();
    for (std::size_t i = 0; i < count; ++i) {
      sized.names.push_back(fmt::format("{}-{}", entry.key, i + 1));
      Entry kind = {sized.names.back(), entry.location, entry.value};
      const TextLocation& location = sizes.location;
      std::erase_if(kind.value.entries,
                    [](const Entry& key) { return key.key == "sizes" || key.key == "color"; });
      Value shape = Value::map(location);
      shape.add(law.shape == RoundShape::disc ? "disc" : "hexagon",
                Value::scalar(fmt::format("{}", sized.kinds[i].radius), location));
      kind.value.add("shape", std::move(shape));
      kind.value.add("color",
                     Value::scalar(shade(color, count > 1 ? static_cast<double>(i) /
                                                                static_cast<double>(count - 1)
                                                          : 0.5),
                                   location));
      entries.push_back(std::move(kind));
    }
  }

  /// Replaces each species with sizes by those of its kinds that `numbers_of(entry, sized)` counts.
  template <class Numbers>
  void divide(Value& map, const Numbers& numbers_of) {
    std::vector<Entry> result;
    for (Entry& entry : map.entries) {
      const auto sized = sized_species_.find(entry.key);
      if (sized == sized_species_.end()) {
        result.push_back(std::move(entry));
        continue;
      }
      const std::vector<std::string>& names = sized->second.names;
      const std::vector<double> numbers = numbers_of(entry, sized->second);
      for (std::size_t i = 0; i < numbers.size(); ++i) {
        if (numbers[i] > 0) {
          used_kinds_.insert(names[i]);
          result.push_back({names[i], entry.location, whole(numbers[i], entry.value.location)});
        }
      }
    }
    map.entries = std::move(result);
  }

  std::vector<std::string> species_names_;
  std::map<std::string, SizedSpecies> sized_species_;
  std::set<std::string> used_kinds_;
};

void expand_sizes_of_fill(Expansion& expansion, Value& fill, const std::string& path) {
  if (Value* counts = fill.find("counts")) {
    expansion.divide_counts(*counts, path + ".counts");
  }
  if (Value* mix = fill.find("mix")) {
    expansion.divide_weights(*mix, path + ".mix");
  }
  if (Value* picture = fill.find("picture")) {
    for (const char* key : {"colors", "pixels"}) {
      if (Value* parts = picture->find(key)) {
        for (Entry& part : parts->entries) {
          expansion.divide_picture_part(part.value,
                                        fmt::format("{}.picture.{}.{}", path, key, part.key));
        }
      }
    }
  }
}

}  // namespace

void expand_sizes(Value& root, const Scene& scene) {
  Value* species = root.find("species");
  if (species == nullptr || !species->is(Value::Kind::map)) {
    return;
  }
  Expansion expansion(*species, scene);
  if (expansion.empty()) {
    return;
  }
  if (Value* stages = root.find("stages")) {
    for (std::size_t i = 0; i < stages->items.size(); ++i) {
      if (Value* fill = stages->items[i].find("fill")) {
        expand_sizes_of_fill(expansion, *fill, stage_path(stages->items[i], i) + ".fill");
      }
    }
  }
  if (Value* sources = root.find("sources")) {
    for (Entry& source : sources->entries) {
      if (!source.value.is(Value::Kind::map)) {
        continue;
      }
      if (source.value.find("species") == nullptr) {
        source.value.entries.push_back(
            {"species", source.location, expansion.equal_weights(source.location)});
      }
      expansion.divide_weights(*source.value.find("species"),
                               join_path(join_path("sources", source.key), "species"));
    }
  }
  if (root.find("begin") == nullptr) {  // which may have particles of any kind
    expansion.leave_out_unused(*species);
  }
}

}  // namespace clca::scene
