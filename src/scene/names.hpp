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
inline constexpr std::array<Named<contact::Rolling>, 3> kRollingNames = {
    {{"none", contact::Rolling::none},
     {"resistance", contact::Rolling::resistance},
     {"free", contact::Rolling::free}}};
/// A unit of length and how many of it make a metre.
inline constexpr std::array<Named<double>, 4> kLengthUnits = {
    {{"m", 1}, {"cm", 1e2}, {"mm", 1e3}, {"um", 1e6}}};
inline constexpr std::array<Named<automaton::Candidates>, 2> kCandidateNames = {
    {{"downward", automaton::Candidates::downward}, {"all", automaton::Candidates::all}}};
inline constexpr std::array<Named<lattice::Direction>, 6> kDirectionNames = {
    {{"down", lattice::Direction::down},
     {"up", lattice::Direction::up},
     {"up_right", lattice::Direction::up_right},
     {"down_right", lattice::Direction::down_right},
     {"down_left", lattice::Direction::down_left},
     {"up_left", lattice::Direction::up_left}}};
inline constexpr std::array<Named<automaton::UpdateClass>, 3> kUpdateClassNames = {
    {{"rest", automaton::UpdateClass::rest},
     {"inertia", automaton::UpdateClass::inertia},
     {"gravity", automaton::UpdateClass::gravity}}};
inline constexpr std::array<Named<FillMethod>, 2> kFillMethodNames = {
    {{"random", FillMethod::random}, {"deposition", FillMethod::deposition}}};
inline constexpr std::array<Named<automaton::Ties>, 2> kTiesNames = {
    {{"particle", automaton::Ties::particle}, {"direction", automaton::Ties::direction}}};
inline constexpr std::array<Named<grains::Waveform>, 2> kWaveformNames = {
    {{"sine", grains::Waveform::sine}, {"triangle", grains::Waveform::triangle}}};
/// Whether a vessel is shaken sideways.
inline constexpr std::array<Named<bool>, 2> kShakeDirectionNames = {
    {{"vertical", false}, {"horizontal", true}}};
inline constexpr std::array<Named<grains::Passive>, 2> kPassiveNames = {
    {{"rigid", grains::Passive::rigid}, {"overlap", grains::Passive::overlap}}};
inline constexpr std::array<Named<Measure>, 13> kMeasureNames = {
    {{"profile", Measure::profile},
     {"repose", Measure::repose},
     {"runout", Measure::runout},
     {"packing", Measure::packing},
     {"moved", Measure::moved},
     {"outflow", Measure::outflow},
     {"force", Measure::force},
     {"segregation", Measure::segregation},
     {"intruder", Measure::intruder},
     {"convection", Measure::convection},
     {"axis_order", Measure::axis_order},
     {"mixing", Measure::mixing},
     {"weight_paths", Measure::weight_paths}}};
inline constexpr std::array<Named<ColorBy>, 10> kColorByNames = {
    {{"species", ColorBy::species},
     {"stage_layer", ColorBy::stage_layer},
     {"displacement", ColorBy::displacement},
     {"speed", ColorBy::speed},
     {"spin", ColorBy::spin},
     {"coordination", ColorBy::coordination},
     {"id", ColorBy::id},
     {"axis", ColorBy::axis},
     {"force", ColorBy::force},
     {"pressure", ColorBy::pressure}}};
inline constexpr std::array<Named<Drawing>, 3> kDrawingNames = {
    {{"auto", Drawing::automatic}, {"polygons", Drawing::polygons}, {"lookup", Drawing::lookup}}};
inline constexpr std::array<Named<Overlay>, 8> kOverlayNames = {
    {{"none", Overlay::none},
     {"forces", Overlay::forces},
     {"arrows", Overlay::arrows},
     {"velocity", Overlay::velocity},
     {"weight_inner", Overlay::weight_inner},
     {"weight_outer", Overlay::weight_outer},
     {"weight_pair", Overlay::weight_pair},
     {"weight_q", Overlay::weight_q}}};
inline constexpr std::array<Named<PictureStyle>, 2> kPictureStyleNames = {
    {{"screen", PictureStyle::screen}, {"print", PictureStyle::print}}};

inline constexpr std::array<Named<boltzmann::Initial>, 2> kInitialNames = {
    {{"gaussian", boltzmann::Initial::gaussian},
     {"equal_energy", boltzmann::Initial::equal_energy}}};
/// Whether draws are quasi-random.
inline constexpr std::array<Named<bool>, 2> kSamplingNames = {{{"random", false}, {"quasi", true}}};
/// By index in boltzmann::Scheme.
inline constexpr std::array<Named<std::size_t>, 2> kSchemeNames = {
    {{"majorant", 0}, {"ogawa-kato", 1}}};

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
