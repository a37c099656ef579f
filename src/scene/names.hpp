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

/// A word for each value from the first enumerator, false or 0 up to `kLast`, in order.
template <auto kLast, class... Words>
constexpr auto in_order(Words... words) {
  using T = decltype(kLast);
  static_assert(sizeof...(words) == static_cast<std::size_t>(kLast) + 1);
  std::size_t index = 0;
  return std::array{Named<T>{words, static_cast<T>(index++)}...};
}

inline constexpr auto kModelNames =
    in_order<Model::baxter>("automaton", "contact", "voids", "baxter");
inline constexpr auto kRollingNames =
    in_order<contact::Rolling::free>("none", "resistance", "free");
/// A unit of length and how many of it make a metre.
inline constexpr std::array<Named<double>, 4> kLengthUnits = {
    {{"m", 1}, {"cm", 1e2}, {"mm", 1e3}, {"um", 1e6}}};
inline constexpr auto kCandidateNames =
    in_order<automaton::CandidateDirections::all>("downward", "all");
inline constexpr std::array<Named<lattice::Direction>, 6> kDirectionNames = {
    {{"down", lattice::Direction::down},
     {"up", lattice::Direction::up},
     {"up_right", lattice::Direction::up_right},
     {"down_right", lattice::Direction::down_right},
     {"down_left", lattice::Direction::down_left},
     {"up_left", lattice::Direction::up_left}}};
inline constexpr auto kUpdateClassNames =
    in_order<automaton::UpdateClass::gravity>("rest", "inertia", "gravity");
inline constexpr auto kFillMethodNames = in_order<FillMethod::deposition>("random", "deposition");
inline constexpr auto kTiesNames =
    in_order<automaton::TieBreaking::direction>("particle", "direction");
inline constexpr auto kWaveformNames = in_order<grains::Waveform::triangle>("sine", "triangle");
/// Whether a vessel is shaken sideways.
inline constexpr auto kShakeDirectionNames = in_order<true>("vertical", "horizontal");
inline constexpr auto kPassiveNames = in_order<grains::PassiveRule::overlap>("rigid", "overlap");
inline constexpr auto kMeasureNames = in_order<Measure::weight_paths>(
    "profile", "repose", "runout", "packing", "moved", "outflow", "force", "segregation",
    "intruder", "convection", "axis_order", "mixing", "weight_paths");
inline constexpr auto kColorByNames =
    in_order<ColorBy::pressure>("species", "stage_layer", "displacement", "speed", "spin",
                                "coordination", "id", "axis", "force", "pressure");
inline constexpr auto kDrawingNames = in_order<DrawingMethod::lookup>("auto", "polygons", "lookup");
inline constexpr auto kOverlayNames =
    in_order<Overlay::weight_q>("none", "forces", "arrows", "velocity", "weight_inner",
                                "weight_outer", "weight_pair", "weight_q");
inline constexpr auto kPictureStyleNames = in_order<PictureStyle::print>("screen", "print");

inline constexpr auto kInitialNames =
    in_order<boltzmann::InitialDistribution::equal_energy>("gaussian", "equal_energy");
/// Whether draws are quasi-random.
inline constexpr auto kSamplingNames = in_order<true>("random", "quasi");
/// By index in boltzmann::Scheme.
inline constexpr auto kSchemeNames = in_order<std::size_t{1}>("majorant", "ogawa-kato");

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
