#pragma once
// Limits that several keys have, or that need a reason; others stand in the declaration of their
// key.

#include <cstddef>
#include <cstdint>
#include <limits>

namespace clca::scene {

inline constexpr std::uint64_t kVersion = 1;
inline constexpr std::size_t kMaxTitleLength = 200;
inline constexpr std::size_t kMaxPathLength = 4096;
inline constexpr const char* kNamePattern = "^[A-Za-z0-9_-]{1,64}$";
/// Of what expressions can name.
inline constexpr const char* kExpressionNamePattern = "^[A-Za-z_][A-Za-z0-9_]*$";
inline constexpr std::size_t kMaxExpressionLength = 1000;
inline constexpr std::size_t kMaxDerived = 100;
/// Of species, walls, parts of a wall, sources, outlets and stages, each.
inline constexpr std::size_t kMaxItems = 1000;

inline constexpr double kMaxBoxWidth = 866'025;  ///< at most 1,000,000 columns
inline constexpr double kMaxBoxHeight = 1'000'000;
inline constexpr double kMaxCoordinate = 1'000'000;  ///< of a coordinate in lattice spacings
inline constexpr double kMaxThickness = 100;         ///< of a wall, lattice spacings
inline constexpr double kMinRingThickness = 1;       ///< a thinner one would let sites through

inline constexpr std::size_t kMaxPicturePixels = 1'000'000;  ///< of a wall
inline constexpr double kMaxPictureFileBytes = 1 << 24;
inline constexpr double kMaxAllPictureBytes = 4 * kMaxPictureFileBytes;  ///< of all of a scene

inline constexpr int kMaxRadius = 100;
inline constexpr double kMaxDiameter = 100;  ///< of a distribution of sizes
inline constexpr std::size_t kMaxKinds = 64;
inline constexpr std::uint64_t kMaxWeightBesideSizes = 1000;  ///< where a species has sizes
inline constexpr std::size_t kMaxSites = 100'000;             ///< of a shape
inline constexpr std::size_t kMaxAllSites = 2'000'000;        ///< of the shapes of all species
inline constexpr std::size_t kMaxCorners = 1000;
inline constexpr double kMaxLength = 1000;  ///< spacings, of a shape

inline constexpr std::uint64_t kMaxParticles = std::numeric_limits<std::int32_t>::max();
inline constexpr std::uint64_t kMaxSpeciesWeight = 1'000'000;  ///< weight of a species in a source

inline constexpr int kMaxOffset = 1'000'000;  ///< of a moving wall from home
/// The sine of a motion takes 4 x amplitude x period squared in 64 bits.
inline constexpr int kMaxWaveAmplitude = 10'000;
inline constexpr std::uint64_t kMaxWavePeriod = 10'000'000;
inline constexpr std::size_t kMaxPoints = 100'000;  ///< of a path

inline constexpr double kMaxCellSide = 1000;
inline constexpr double kMinLineLength = 1;  ///< lattice spacings

// Of the contact model.
inline constexpr double kMaxFallHeight = 1e6;
inline constexpr double kMaxVesselRate = 1e6;  ///< degrees of a tilt, or turns, per unit of time
inline constexpr double kMinSpacing = 1e-9;    ///< metres
inline constexpr double kMaxSpacing = 1e3;     ///< metres

// Of scenes of the Boltzmann equation.
inline constexpr std::size_t kMaxRestitutions = 64;
inline constexpr double kMaxFriction = 1000;
inline constexpr double kMaxTime = 1e9;
inline constexpr double kMaxRows = 1'000'000;  ///< of a series
inline constexpr std::size_t kMaxHistograms = 1000;
inline constexpr int kMinQuantiles = 2;
inline constexpr int kMaxQuantiles = 1000;
inline constexpr double kMaxUniformBins = 10'000;
inline constexpr double kMaxEnergy = 1e6;  ///< where uniform bins end at the most

}  // namespace clca::scene
