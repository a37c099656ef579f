// Wrong species.

#include <array>

#include "bad_scenes.hpp"

namespace clca::scene::testing {

namespace {

constexpr auto kBadSpecies = std::to_array<BadScene>({
    {"no species", "species: {}", "scene.yaml:5:10: error: species: expected at least one"},
    {"a list of species", "species: [small, large]",
     "scene.yaml:5:10: error: species: expected a map, found a list"},
    {"a species without a shape", R"(species: {small: {color: "#ffffff"}})",
     "scene.yaml:5:18: error: species.small: expected exactly one of shape, sizes, found none"},
    {"a species with nothing",
     "species:\n"
     "  small:\n"
     "  large: {shape: {hexagon: 2}}",
     "scene.yaml:6:3: error: species.small: expected a map (allowed: shape, sizes, orientations, "
     "color, sieve), found nothing"},
    {"a name with a space", "species: {small one: {shape: {hexagon: 1}}}",
     "scene.yaml:5:11: error: species: a name has 1 to 64 of the characters A-Z a-z 0-9 _ -, "
     "found 'small one'"},
    {"a species as wide as a periodic box",
     "box: {width: 30, height: 100, periodic: true}\n"
     "species: {small: {shape: {hexagon: 20}}}",
     "scene.yaml:5:18: error: species.small: 41 columns wide at 0 degrees, too wide for a periodic "
     "box of 36 columns",
     Judge::parser},
    {"a species with a shape and sizes",
     "species: {small: {shape: {hexagon: 1}, sizes: {law: uniform, mean: 3, sd: 1}}}",
     "scene.yaml:5:18: error: species.small: expected exactly one of shape, sizes, found shape and "
     "sizes"},
    {"a rectangle without height", "species: {small: {shape: {rectangle: [3, 0]}}}",
     "scene.yaml:5:42: error: species.small.shape.rectangle: expected a number above 0 and up "
     "to 1000, found '0'"},
    {"an outline without a site in it",
     "species: {small: {shape: {outline: [[0.2, 0.2], [0.3, 0.2], [0.3, 0.3]]}}}",
     "scene.yaml:5:26: error: species.small.shape: a shape has at least one site", Judge::parser},
    {"an outline of two parts",
     "species: {small: {shape: {outline: [[0, 0], [0, 1], [9, 0.6], [9, 0.4]]}}}",
     "scene.yaml:5:26: error: species.small.shape: the sites of the shape do not connect",
     Judge::parser},
    {"sizes by an unknown law", "species: {small: {sizes: {law: normal, mean: 3, sd: 1}}}",
     "scene.yaml:5:32: error: species.small.sizes.law: expected one of uniform, lognormal, list, "
     "found 'normal'; did you mean 'lognormal'?"},
    {"sizes without a spread", "species: {small: {sizes: {law: uniform, mean: 3}}}",
     "scene.yaml:5:26: error: species.small.sizes: key 'sd' is missing", Judge::parser},
    {"sizes below zero", "species: {small: {sizes: {law: uniform, mean: 3, sd: 2}}}",
     "scene.yaml:5:54: error: species.small.sizes.sd: expected less than 1.732, so that all "
     "diameters are above 0, found 2",
     Judge::parser},
    {"fewer particles than kinds",
     "species: {small: {sizes: {law: list, diameters: [1, 3, 5], shares: [1, 1, 1]}}, large: "
     "{shape: {hexagon: 2}}}\n"
     "sources: {}\nstages: [{name: a, fill: {region: [0, 0, 100, 50], counts: {small: 2}}}]",
     "scene.yaml:10:68: error: stages.a.fill.counts.small: expected at least 3, one of each kind, "
     "found 2",
     Judge::parser},
    {"sizes below that of a single site",
     "species: {small: {sizes: {law: uniform, mean: 1, sd: 0.1}}}",
     "scene.yaml:5:47: error: species.small.sizes.mean: expected at least 1.05, the diameter of a "
     "single site, found 1",
     Judge::parser},
    {"sizes with a tail of giants", "species: {small: {sizes: {law: lognormal, mean: 90, sd: 90}}}",
     "scene.yaml:5:57: error: species.small.sizes.sd: expected less, so that all diameters are up "
     "to "
     "100; the largest would be 650.8",
     Judge::parser},
    {"a list of sizes with a mean",
     "species: {small: {sizes: {law: list, diameters: [2], shares: [1], mean: 2}}}",
     "scene.yaml:5:73: error: species.small.sizes.mean: goes with 'law: uniform' or 'law: "
     "lognormal'",
     Judge::parser},
    {"a list of sizes with a share too few",
     "species: {small: {sizes: {law: list, diameters: [2, 3], shares: [1]}}}",
     "scene.yaml:5:65: error: species.small.sizes.shares: expected a share for each of the 2 "
     "diameters, found 1",
     Judge::parser},
    {"a kind with the name of a species",
     "species: {small: {sizes: {law: uniform, mean: 3, sd: 1}}, small-1: {shape: {hexagon: 1}}}",
     "scene.yaml:5:11: error: species.small-1: a kind of a species with sizes has this name",
     Judge::parser},
    {"an unknown key of a species", R"(species: {small: {shape: {hexagon: 1}, colour: "#ffffff"}})",
     "scene.yaml:5:40: error: unknown key 'colour' in species.small (allowed: shape, sizes, "
     "orientations, color, sieve); did you mean 'color'?"},
    {"an unknown shape", "species: {small: {shape: {hexagn: 1}}}",
     "scene.yaml:5:27: error: unknown key 'hexagn' in species.small.shape (allowed: hexagon, "
     "disc, rectangle, outline, sites, polygon, rod); did you mean 'hexagon'?"},
    {"a shape in two ways", "species: {small: {shape: {hexagon: 1, rod: {radius: 1, length: 2}}}}",
     "scene.yaml:5:26: error: species.small.shape: expected exactly one of hexagon, disc, "
     "rectangle, outline, sites, polygon, rod, found hexagon and rod"},
    {"a shape in no way", "species: {small: {shape: {}}}",
     "scene.yaml:5:26: error: species.small.shape: expected exactly one of hexagon, disc, "
     "rectangle, outline, sites, polygon, rod, found none"},
    {"a hexagon too large", "species: {small: {shape: {hexagon: 101}}}",
     "scene.yaml:5:36: error: species.small.shape.hexagon: expected a whole number from 0 to "
     "100, found '101'"},
    {"a hexagon of half a spacing", "species: {small: {shape: {hexagon: 0.5}}}",
     "scene.yaml:5:36: error: species.small.shape.hexagon: expected a whole number from 0 to "
     "100, found '0.5'"},
    {"a shape without sites", "species: {small: {shape: {sites: []}}}",
     "scene.yaml:5:34: error: species.small.shape.sites: expected 1 to 100000 items, found 0"},
    {"a site with three numbers", "species: {small: {shape: {sites: [[0, 0, 0]]}}}",
     "scene.yaml:5:35: error: species.small.shape.sites: expected 2 items, found 3"},
    {"a site far away", "species: {small: {shape: {sites: [[0, 0], [0, 1001]]}}}",
     "scene.yaml:5:47: error: species.small.shape.sites: expected a whole number from -1000 "
     "to 1000, found '1001'"},
    {"a site twice", "species: {small: {shape: {sites: [[0, 0], [0, 1], [0, 0]]}}}",
     "scene.yaml:5:51: error: species.small.shape.sites: [0, 0] is named twice"},
    {"sites that do not connect", "species: {small: {shape: {sites: [[0, 0], [0, 2]]}}}",
     "scene.yaml:5:26: error: species.small.shape: the sites of the shape do not connect",
     Judge::parser},
    {"a ring of sites",
     "species: {small: {shape: {sites: [[0, 1], [1, 0], [1, -1], [0, -1], [-1, 0], [-1, 1]]}}}",
     "scene.yaml:5:26: error: species.small.shape: the shape encloses a hole", Judge::parser},
    {"a polygon of two corners", "species: {small: {shape: {polygon: [[0, 0], [0, 1]]}}}",
     "scene.yaml:5:36: error: species.small.shape.polygon: expected 3 to 1000 items, found 2"},
    {"a polygon of too many sites",
     "species: {small: {shape: {polygon: [[-500, -500], [500, -500], [500, 500], [-500, "
     "500]]}}}",
     "scene.yaml:5:26: error: species.small.shape: expected a shape of at most 100000 sites",
     Judge::parser},
    {"a rod without length", "species: {small: {shape: {rod: {radius: 1}}}}",
     "scene.yaml:5:32: error: species.small.shape.rod: key 'length' is missing"},
    {"a rod of length 0", "species: {small: {shape: {rod: {radius: 1, length: 0}}}}",
     "scene.yaml:5:52: error: species.small.shape.rod.length: expected a whole number from 1 "
     "to 1000, found '0'"},
    {"an orientation off the lattice",
     "species: {small: {shape: {hexagon: 1}, orientations: [0, 90]}}",
     "scene.yaml:5:58: error: species.small.orientations: expected a multiple of 60, found 90"},
    {"an orientation twice", "species: {small: {shape: {hexagon: 1}, orientations: [60, 60]}}",
     "scene.yaml:5:59: error: species.small.orientations: 60 is named twice"},
    {"a full turn", "species: {small: {shape: {hexagon: 1}, orientations: [360]}}",
     "scene.yaml:5:55: error: species.small.orientations: expected a whole number from 0 to "
     "300, found '360'"},
    {"a misspelt any", "species: {small: {shape: {hexagon: 1}, orientations: eny}}",
     "scene.yaml:5:54: error: species.small.orientations: expected any or a list of angles, "
     "found 'eny'"},
    {"a colour by name", "species: {small: {shape: {hexagon: 1}, color: red}}",
     R"(scene.yaml:5:47: error: species.small.color: expected a colour like "#3a6ea5", in )"
     "quotes, found 'red'"},
    {"a colour without quotes, which YAML takes for a comment",
     "species:\n"
     "  small:\n"
     "    shape: {hexagon: 1}\n"
     "    color: #ff0000",
     R"(scene.yaml:8:5: error: species.small.color: expected a colour like "#3a6ea5", in )"
     "quotes, found nothing"},
    {"a species that appears nowhere",
     "species: {small: {shape: {hexagon: 1}}, large: {shape: {hexagon: 2}}}\n"
     "sources: {spout: {at: [20, 40], rate: 0.5, count: 9, species: {small: 1}}}",
     "scene.yaml:5:41: error: species.large is not used; give it a count in a fill, or a "
     "source",
     Judge::parser},
});

}  // namespace

std::span<const BadScene> bad_species() {
  return kBadSpecies;
}

}  // namespace clca::scene::testing
