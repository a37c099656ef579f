#include "clca/grains/motion.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <vector>

namespace clca::grains::motion_test {
namespace {

using Phase = Travel::Phase;

/// Offsets after each of `steps` steps in which nothing stands in the way and no particle moves.
std::vector<std::int32_t> offsets(const WallMotion& motion, int steps) {
  Travel travel{.active = true};
  std::vector<std::int32_t> result;
  for (int step = 0; step < steps; ++step) {
    record_step(motion, travel, desired_step(motion, travel), true,
                static_cast<std::uint64_t>(step));
    end_step(motion, travel, false);
    result.push_back(travel.offset);
  }
  return result;
}

TEST(Drive, GoesOneSiteEveryPeriodUntilItsDistanceIsDone) {
  const WallMotion motion{.program = Drive{.period = 3, .distance = 2}};
  EXPECT_EQ(offsets(motion, 10), (std::vector{0, 0, 1, 1, 1, 2, 2, 2, 2, 2}));
}

TEST(Drive, DoesNotMakeUpForAStallAndIsOverAtItsDistanceOnly) {
  const WallMotion motion{.program = Drive{.period = 2, .distance = 1}};
  Travel travel{.active = true};
  for (std::uint64_t step = 0; step < 4; ++step) {  // due in steps 1 and 3: both fail
    record_step(motion, travel, desired_step(motion, travel), false, step);
  }
  EXPECT_EQ(travel.stalls, 2U);
  EXPECT_EQ(travel.stalled_since, 1U);
  EXPECT_FALSE(is_over(motion, travel));
  EXPECT_EQ(desired_step(motion, travel), 0);
  record_step(motion, travel, 0, false, 4);
  EXPECT_EQ(desired_step(motion, travel), 1);
  record_step(motion, travel, 1, true, 5);
  EXPECT_EQ(travel.offset, 1);
  EXPECT_EQ(travel.stalls, 2U);
  EXPECT_FALSE(travel.stalled_since);
  EXPECT_TRUE(is_over(motion, travel));
}

TEST(Travel, StalledSinceStaysAtTheFirstOfAChainOfStalls) {
  const WallMotion motion{.program = Drive{.period = 1, .distance = 9}};
  Travel travel{.active = true};
  record_step(motion, travel, 1, true, 10);
  record_step(motion, travel, 1, false, 11);
  record_step(motion, travel, 1, false, 12);
  EXPECT_EQ(travel.stalled_since, 11U);
  EXPECT_EQ(travel.offset, 1);
  EXPECT_EQ(travel.clock, 3U);
  record_step(motion, travel, 1, true, 13);
  record_step(motion, travel, 1, false, 14);
  EXPECT_EQ(travel.stalled_since, 14U);
  EXPECT_EQ(travel.stalls, 3U);
}

TEST(Wave, StaysWithinItsAmplitudeReachesItAndGoesOneSiteAStepAtMost) {
  for (const Waveform form : {Waveform::sine, Waveform::triangle}) {
    for (const int amplitude : {1, 2, 3, 7, 20}) {
      for (int period = 7 * amplitude; period < 7 * amplitude + 5; ++period) {
        const Wave wave{form, amplitude, static_cast<std::uint64_t>(period)};
        std::int32_t before = 0;
        std::int32_t low = 0;
        std::int32_t high = 0;
        for (const std::int32_t offset : offsets({.program = wave}, 3 * period)) {
          EXPECT_LE(std::abs(offset - before), 1) << amplitude << ' ' << period;
          low = std::min(low, offset);
          high = std::max(high, offset);
          before = offset;
        }
        EXPECT_EQ(high, amplitude) << period;
        EXPECT_EQ(low, -amplitude) << period;
        EXPECT_EQ(before, 0) << period;  // home again after whole periods
      }
    }
  }
}

TEST(Wave, TheSineInIntegersIsNearTheRealOne) {
  constexpr std::int32_t kAmplitude = 10'000;
  const Wave wave{Waveform::sine, kAmplitude, 1001};
  for (std::uint64_t clock = 0; clock < 2002; ++clock) {
    const double angle = 2 * std::numbers::pi * static_cast<double>(clock) / 1001;
    EXPECT_NEAR(target_offset(wave, clock), kAmplitude * std::sin(angle), 0.002 * kAmplitude);
  }
}

TEST(Wave, NeverEndsAndNeverInsistsAndCountsItsPeriods) {
  const WallMotion motion{.program = Wave{Waveform::triangle, 2, 8}};
  Travel travel{.active = true};
  for (std::uint64_t step = 0; step < 20; ++step) {
    EXPECT_EQ(travel.cycles, step / 8);
    EXPECT_FALSE(is_over(motion, travel));
    EXPECT_EQ(pending_step(motion, travel), 0);
    record_step(motion, travel, desired_step(motion, travel), false, step);
  }
  EXPECT_EQ(travel.offset, 0);  // stalled all the time
}

TEST(Shake, RisesFallsWaitsForItsStepsAndBeginsAnew) {
  // The step of the last drop does not count.
  const WallMotion motion{.program = Shake{.amplitude = 2, .wait = 2}};
  EXPECT_EQ(offsets(motion, 14), (std::vector{1, 2, 1, 0, 0, 0, 1, 2, 1, 0, 0, 0, 1, 2}));
}

TEST(Shake, WithoutAWaitRisesAgainOnlyWhenNoParticleMoves) {
  const WallMotion motion{.program = Shake{.amplitude = 1, .wait = {}}};
  Travel travel{.active = true};
  const auto step = [&](bool particles_move) {
    record_step(motion, travel, desired_step(motion, travel), true, 0);
    end_step(motion, travel, particles_move);
  };
  step(true);
  EXPECT_EQ(travel.phase, Phase::falling);
  step(true);
  for (int i = 0; i < 5; ++i) {
    EXPECT_EQ(travel.phase, Phase::waiting);
    EXPECT_EQ(travel.cycles, 0U);
    EXPECT_EQ(desired_step(motion, travel), 0);
    step(true);
  }
  step(false);
  EXPECT_EQ(travel.phase, Phase::rising);
  EXPECT_EQ(travel.cycles, 1U);
  EXPECT_TRUE(is_cyclic(motion));
  EXPECT_FALSE(is_over(motion, travel));
}

TEST(Shake, OfTheContactModelTakesItsPeriodForEachSite) {
  for (const std::uint64_t period : {1U, 7U, 10U, 100'000U, 700'000U, 1'000'000U}) {
    const WallMotion motion{.program = Shake{.amplitude = 2, .wait = 1, .period = period}};
    Travel travel{.active = true};
    std::int64_t position = 0;
    std::uint64_t steps = 0;
    while (position < 2 * kMotionUnitsPerSpacing) {
      position += next_displacement(motion, travel, position);
      ++steps;
    }
    EXPECT_EQ(steps, 2 * period);
    EXPECT_EQ(position, 2 * kMotionUnitsPerSpacing);
    for (travel.phase = Phase::falling; position > 0; --steps) {
      position += next_displacement(motion, travel, position);
    }
    EXPECT_EQ(steps, 0U);
    EXPECT_EQ(position, 0);
  }
}

TEST(Shake, ThatCannotRiseTriesAgainAndDoesNotTurn) {
  const WallMotion motion{.program = Shake{.amplitude = 2, .wait = 1}};
  Travel travel{.active = true};
  record_step(motion, travel, 1, true, 0);
  record_step(motion, travel, 1, false, 1);
  EXPECT_EQ(travel.phase, Phase::rising);
  EXPECT_EQ(desired_step(motion, travel), 1);
  EXPECT_NE(pending_step(motion, travel), 0);
}

TEST(Path, GoesStraightFromPointToPointAndRoundsHalvesAwayFromZero) {
  const Path path{{{4, 2}, {6, 2}, {10, -2}}};
  std::vector<std::int32_t> targets;
  for (std::uint64_t clock = 0; clock < 13; ++clock) {
    targets.push_back(target_offset(path, clock));
  }
  EXPECT_EQ(targets, (std::vector{0, 1, 1, 2, 2, 2, 2, 1, 0, -1, -2, -2, -2}));
  EXPECT_EQ(offsets({.program = path}, 12), (std::vector{1, 1, 2, 2, 2, 2, 1, 0, -1, -2, -2, -2}));
}

TEST(Path, CatchesUpWhenItHasStalledAndInsistsOnlyAfterItsLastPoint) {
  const WallMotion motion{.program = Path{{{2, 2}}}};
  Travel travel{.active = true};
  record_step(motion, travel, 1, false, 0);
  EXPECT_EQ(pending_step(motion, travel), 0);
  record_step(motion, travel, 1, false, 1);
  EXPECT_NE(pending_step(motion, travel), 0);
  EXPECT_FALSE(is_over(motion, travel));
  record_step(motion, travel, desired_step(motion, travel), true, 2);
  record_step(motion, travel, desired_step(motion, travel), true, 3);
  EXPECT_EQ(travel.offset, 2);
  EXPECT_TRUE(is_over(motion, travel));
}

TEST(Path, WithoutPointsIsOverFromTheStart) {
  EXPECT_TRUE(is_over({.program = Path{}}, {}));
  EXPECT_EQ(target_offset(Path{}, 7), 0);
}

TEST(WallMotion, RangeIsWhatTheOffsetCanReach) {
  const auto range = [](const WallMotion& motion) {
    const OffsetRange found = offset_range(motion);
    return std::pair(found.low, found.high);
  };
  EXPECT_EQ(range({.program = Drive{1, 5}}), std::pair(0, 5));
  EXPECT_EQ(range({.program = Wave{Waveform::sine, 3, 30}}), std::pair(-3, 3));
  EXPECT_EQ(range({.program = Shake{4, {}}}), std::pair(0, 4));
  EXPECT_EQ(range({.program = Path{{{9, 4}, {20, -2}, {30, 1}}}}), std::pair(-2, 4));
  EXPECT_EQ(range({.program = Path{{{9, 4}}}}), std::pair(0, 4));
}

}  // namespace
}  // namespace clca::grains::motion_test
