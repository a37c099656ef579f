#include "scene/kind.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "clca/text/message.hpp"
#include "scene/sections.hpp"

namespace clca::scene {

namespace {

bool contains(const std::vector<std::string_view>& words, std::string_view word) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

/// A misspelt `boltzmann` makes no scene of grains.
bool stands_for_boltzmann(const Entry& entry) {
  constexpr std::array<std::string_view, 1> kBlock = {"boltzmann"};
  return text::nearest(entry.key, kBlock).has_value();
}

}  // namespace

Kind kind_of(const Value& root) {
  const std::vector<std::string_view> automaton_keys = names_of(*scene_type().keys);
  const std::vector<std::string_view> boltzmann_keys = names_of(*boltzmann_type().keys);
  const Entry* automaton = nullptr;
  const Entry* boltzmann = nullptr;
  for (const Entry& entry : root.entries) {
    const bool in_automaton = contains(automaton_keys, entry.key);
    const bool in_boltzmann = contains(boltzmann_keys, entry.key);
    if (in_automaton && !in_boltzmann && automaton == nullptr) {
      automaton = &entry;
    } else if (in_boltzmann && !in_automaton) {
      boltzmann = &entry;
    }
    if (automaton != nullptr && boltzmann != nullptr) {
      const Entry& other = automaton == &entry ? *boltzmann : *automaton;
      fail(entry.location,
           fmt::format("'{}' does not go with '{}': a scene of the Boltzmann equation has the keys "
                       "{}; one of grains has {}",
                       entry.key, other.key, fmt::join(boltzmann_keys, ", "),
                       fmt::join(automaton_keys, ", ")));
    }
  }
  const bool misspelt = automaton == nullptr &&
                        std::any_of(root.entries.begin(), root.entries.end(), stands_for_boltzmann);
  return boltzmann != nullptr || misspelt ? Kind::boltzmann : Kind::automaton;
}

}  // namespace clca::scene
