#pragma once
// Wrong scenes: each a right one but for a part, with the line that refuses it.

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "clca/scene/scene.hpp"

namespace clca::scene::testing {

/// Who can know that the scene is wrong: the schema too, or only the parser and check_walls.
enum class Judge { schema, parser };

struct BadScene {
  std::string_view what;
  std::string_view part;  ///< takes the place of the key it begins with, see scene_with
  std::string_view message;
  Judge judge = Judge::schema;
};

std::span<const BadScene> bad_basics();
std::span<const BadScene> bad_species();
std::span<const BadScene> bad_geometry();
std::span<const BadScene> bad_motion();
std::span<const BadScene> bad_stages();
std::span<const BadScene> bad_journeys();
/// To be put into small_contact().
std::span<const BadScene> bad_contacts();
/// Of the Boltzmann equation: to be put into small_gas().
std::span<const BadScene> bad_gases();
std::span<const BadScene> bad_gas_outputs();

/// One of them as a whole.
struct BadText {
  std::string_view what;
  std::string text;
  std::string_view message;
  Judge judge = Judge::schema;
};

/// All of them, of every kind.
std::vector<BadText> bad_scenes();

/// A small scene that is right, with one line for each key: `clca` on line 1, `title` 2, `seed` 3,
/// `box` 4, `species` 5, `rules` 6, `walls` 7, `sources` 8, `outlets` 9, `stages` 10, `measure` 11,
/// `output` 12.
std::string small_scene();

/// The same by the contact model: `model` is on line 6, where `rules` was.
std::string small_contact();

/// A small scene of the Boltzmann equation that is right: `clca` on line 1, `title` 2, `seed` 3,
/// `boltzmann` 4, `output` 5.
std::string small_gas();

/// small_scene() with other lines for the keys at the start of the lines of `part`; what is no key
/// of the scene comes last. Indented lines belong to the key above them.
std::string scene_with(std::string_view part);
/// The same with small_contact() and with small_gas().
std::string contact_with(std::string_view part);
std::string gas_with(std::string_view part);

/// What the scene says once it has been written and read again.
std::string reparsed(const Scene& scene);

}  // namespace clca::scene::testing
