#pragma once
// The ranges that the format allows, for the parser and its messages.

#include <cstddef>
#include <cstdint>
#include <limits>

namespace clca::scene {

inline constexpr std::uint64_t kVersion = 1;
inline constexpr std::size_t kLongestTitle = 200;
inline constexpr std::size_t kLongestName = 64;
/// Of species, walls, parts of a wall, sources, outlets and stages, each.
inline constexpr std::size_t kMostThings = 1000;

inline constexpr double kWidest = 866'025;  ///< at most 1,000,000 columns
inline constexpr double kHighest = 1'000'000;
inline constexpr double kFarthest = 1'000'000;  ///< of a coordinate in lattice spacings
inline constexpr double kThickest = 100;
inline constexpr double kThinnestRing = 1;  ///< a thinner one would let sites through
inline constexpr double kFarthestAngle = 360;

inline constexpr int kLargestRadius = 100;
inline constexpr int kLongestRod = 1000;
inline constexpr int kFarthestSite = 1000;  ///< of a coordinate of a shape
inline constexpr std::size_t kMostSites = 100'000;
inline constexpr std::size_t kMostCorners = 1000;

inline constexpr std::uint64_t kMostParticles = std::numeric_limits<std::int32_t>::max();
inline constexpr std::uint64_t kHeaviest = 1'000'000;  ///< weight of a species in a source
inline constexpr double kLeastRate = 1e-6;
inline constexpr double kGreatestRate = 1000;
inline constexpr std::uint64_t kMostSteps = 1'000'000'000'000;

inline constexpr int kFarthestOffset = 1'000'000;  ///< of a moving wall from home
/// The sine of a motion takes 4 x amplitude x period squared in 64 bits.
inline constexpr int kWidestWave = 10'000;
inline constexpr std::uint64_t kLongestWave = 10'000'000;
inline constexpr std::uint64_t kSineSteps = 7;  ///< of a period, for each site of amplitude
inline constexpr std::uint64_t kTriangleSteps = 4;
inline constexpr std::uint64_t kSlowestShake = 1'000'000;  ///< steps for each site
inline constexpr std::size_t kMostPoints = 100'000;        ///< of a path

inline constexpr int kLeastPixels = 16;
inline constexpr int kMostPixels = 65'536;
inline constexpr int kMostLayers = 256;
inline constexpr int kMostSupersampling = 4;
inline constexpr double kLargestCell = 1000;
inline constexpr double kGreatestForceScale = 1e9;  ///< grain weights
inline constexpr double kLongestWait = 1e9;         ///< seconds

// Of the contact model.
inline constexpr double kGreatestContactFriction = 1e9;  ///< of rolling, too
inline constexpr double kGreatestContactRestitution = 0.99;
inline constexpr int kFewestSweeps = 2;
inline constexpr int kMostSweeps = 64;
inline constexpr double kFinestResolution = 0.01;
inline constexpr double kCoarsestResolution = 1;
inline constexpr double kHighestFall = 1e6;
inline constexpr double kGreatestTilt = 180;        ///< degrees
inline constexpr double kGreatestVesselRate = 1e6;  ///< per unit of time
inline constexpr double kGreatestGamma = 1000;
inline constexpr double kWidestShake = 1000;       ///< in lattice spacings
inline constexpr double kLeastSpacing = 1e-9;      ///< metres
inline constexpr double kGreatestSpacing = 1e3;    ///< metres
inline constexpr double kLeastRealGravity = 1e-6;  ///< metres per second squared
inline constexpr double kMostRealGravity = 1e6;

// Of scenes of the Boltzmann equation.
inline constexpr std::uint64_t kFewestInGas = 2;
inline constexpr std::uint64_t kMostInGas = 100'000'000;
inline constexpr std::size_t kMostRestitutions = 64;
inline constexpr double kGreatestFriction = 1000;
inline constexpr double kGreatestEnergyRatio = 1e6;
inline constexpr double kLongestTimeStep = 1;
inline constexpr int kMostPartners = 1000;
inline constexpr double kGreatestShearRate = 100;
inline constexpr double kLongestTime = 1e9;
inline constexpr std::uint64_t kLargestEnsemble = 10'000;
inline constexpr double kMostRows = 1'000'000;  ///< of a series
inline constexpr std::size_t kMostHistograms = 1000;
inline constexpr int kFewestQuantiles = 2;
inline constexpr int kMostQuantiles = 1000;
inline constexpr double kMostUniformBins = 10'000;
inline constexpr double kGreatestEnergy = 1e6;  ///< where uniform bins end at the most

}  // namespace clca::scene
