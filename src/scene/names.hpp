#pragma once
// The words of the format: names of each choice.

#include <array>
#include <string_view>

#include "clca/scene/boltzmann.hpp"
#include "clca/scene/scene.hpp"

namespace clca::scene {

/// A word of the format and what it stands for.
template <class T>
struct Named {
  std::string_view name;
  T value;
};

inline constexpr std::array<Named<Model>, 4> kModelNames = {{{"automaton", Model::automaton},
                                                             {"contact", Model::contact},
                                                             {"voids", Model::voids},
                                                             {"baxter", Model::baxter}}};

/// A word for each enumerator, in their order; of false and true, or 0 and 1, likewise.
template <class T, class... Words>
constexpr std::array<Named<T>, sizeof...(Words)> in_order(Words... words) {
  std::size_t index = 0;
  return {Named<T>{words, static_cast<T>(index++)}...};
}

inline constexpr auto kRollingNames = in_order<contact::Rolling>("none", "resistance", "free");
static_assert(kRollingNames.back().value == contact::Rolling::free);
/// A unit of length and how many of it make a metre.
inline constexpr std::array<Named<double>, 4> kLengthUnits = {
    {{"m", 1}, {"cm", 1e2}, {"mm", 1e3}, {"um", 1e6}}};
inline constexpr auto kCandidateNames = in_order<automaton::Candidates>("downward", "all");
static_assert(kCandidateNames.back().value == automaton::Candidates::all);
inline constexpr std::array<Named<lattice::Direction>, 6> kDirectionNames = {
    {{"down", lattice::Direction::down},
     {"up", lattice::Direction::up},
     {"up_right", lattice::Direction::up_right},
     {"down_right", lattice::Direction::down_right},
     {"down_left", lattice::Direction::down_left},
     {"up_left", lattice::Direction::up_left}}};
inline constexpr auto kUpdateClassNames =
    in_order<automaton::UpdateClass>("rest", "inertia", "gravity");
static_assert(kUpdateClassNames.back().value == automaton::UpdateClass::gravity);
inline constexpr auto kFillMethodNames = in_order<FillMethod>("random", "deposition");
static_assert(kFillMethodNames.back().value == FillMethod::deposition);
inline constexpr auto kTiesNames = in_order<automaton::Ties>("particle", "direction");
static_assert(kTiesNames.back().value == automaton::Ties::direction);
inline constexpr auto kWaveformNames = in_order<grains::Waveform>("sine", "triangle");
static_assert(kWaveformNames.back().value == grains::Waveform::triangle);
/// Whether a vessel is shaken sideways.
inline constexpr auto kShakeDirectionNames = in_order<bool>("vertical", "horizontal");
inline constexpr auto kPassiveNames = in_order<grains::Passive>("rigid", "overlap");
static_assert(kPassiveNames.back().value == grains::Passive::overlap);
inline constexpr auto kMeasureNames = in_order<Measure>(
    "profile", "repose", "runout", "packing", "moved", "outflow", "force", "segregation",
    "intruder", "convection", "axis_order", "mixing", "weight_paths");
static_assert(kMeasureNames.back().value == Measure::weight_paths);
inline constexpr auto kColorByNames =
    in_order<ColorBy>("species", "stage_layer", "displacement", "speed", "spin", "coordination",
                      "id", "axis", "force", "pressure");
static_assert(kColorByNames.back().value == ColorBy::pressure);
inline constexpr auto kDrawingNames = in_order<Drawing>("auto", "polygons", "lookup");
static_assert(kDrawingNames.back().value == Drawing::lookup);
inline constexpr auto kOverlayNames =
    in_order<Overlay>("none", "forces", "arrows", "velocity", "weight_inner", "weight_outer",
                      "weight_pair", "weight_q");
static_assert(kOverlayNames.back().value == Overlay::weight_q);
inline constexpr auto kPictureStyleNames = in_order<PictureStyle>("screen", "print");
static_assert(kPictureStyleNames.back().value == PictureStyle::print);

inline constexpr auto kInitialNames = in_order<boltzmann::Initial>("gaussian", "equal_energy");
static_assert(kInitialNames.back().value == boltzmann::Initial::equal_energy);
/// Whether draws are quasi-random.
inline constexpr auto kSamplingNames = in_order<bool>("random", "quasi");
/// By index in boltzmann::Scheme.
inline constexpr auto kSchemeNames = in_order<std::size_t>("majorant", "ogawa-kato");

template <class T, std::size_t kCount>
constexpr std::string_view name_of(const std::array<Named<T>, kCount>& names, T value) {
  for (const Named<T>& named : names) {
    if (named.value == value) {
      return named.name;
    }
  }
  return {};
}

template <class T, std::size_t kCount>
constexpr std::array<std::string_view, kCount> words(const std::array<Named<T>, kCount>& names) {
  std::array<std::string_view, kCount> result;
  for (std::size_t i = 0; i < kCount; ++i) {
    result[i] = names[i].name;
  }
  return result;
}

}  // namespace clca::scene
