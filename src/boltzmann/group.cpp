#include "boltzmann/group.hpp"

#include <algorithm>
#include <cmath>

namespace clca::boltzmann {

namespace {

/// 0 to count - 1, from 32 uniform bits.
std::uint32_t one_of(std::uint32_t bits, std::uint32_t count) {
  return static_cast<std::uint32_t>((std::uint64_t{bits} * count) >> 32U);
}

}  // namespace

void Group::resize(Eigen::Index particles) {
  if (motions_.cols() < particles) {
    motions_.resize(Eigen::NoChange, particles);
    touched_.assign(static_cast<std::size_t>(particles), 0);
  }
  speeds_.resize(particles);
}

void Group::measure_speeds() {
  speeds_ = motions_.topLeftCorner(3, particles()).square().colwise().sum().sqrt();
  fastest_ = speeds_.maxCoeff();
}

Group::Candidates Group::draw_firsts(const GroupKey& key, std::uint32_t batch,
                                     std::size_t count) const {
  constexpr std::size_t kWords = std::tuple_size_v<random::Words>;
  const auto size = static_cast<std::uint64_t>(particles());
  Candidates firsts;
  firsts.count = count;
  for (std::size_t i = 0; i < count; i += kWords) {
    const auto item = static_cast<std::uint32_t>((batch * kBatch + i) / kWords);
    const random::Words words =
        random::words(key.seed, {key.step, key.group, item}, random::Purpose::candidate);
    for (std::size_t k = 0; k < kWords; ++k) {
      // The whole part says which particle, what is left over is its chance.
      const std::uint64_t product = words[k] * size;
      firsts.all[i + k].number = static_cast<std::uint32_t>(i + k);
      firsts.all[i + k].first = static_cast<std::uint32_t>(product >> 32U);
      firsts.all[i + k].chance = static_cast<std::uint32_t>(product);
    }
  }
  return firsts;
}

void Group::draw_second(const GroupKey& key, std::uint32_t batch, Candidate& candidate) const {
  const auto item = static_cast<std::uint32_t>(batch * kBatch + candidate.number);
  candidate.words = random::words(key.seed, {key.step, key.group, item}, random::Purpose::normal);
  candidate.second = one_of(candidate.words[0], static_cast<std::uint32_t>(particles() - 1));
  candidate.second += candidate.second >= candidate.first ? 1 : 0;
}

bool Group::goes_on(const Candidate& candidate) const {
  return open_unit32(candidate.chance) * fastest_ < speeds_[candidate.first];
}

bool Group::meets(const Candidate& candidate) const {
  const double speeds = speeds_[candidate.first] + speeds_[candidate.second];
  const double square =
      (motions_.col(candidate.first).head<3>() - motions_.col(candidate.second).head<3>())
          .square()
          .sum();
  const double bound = open_unit32(candidate.words[1]) * speeds;
  return bound * bound < square;
}

template <int kWidth>
void Group::load(Collisions<kWidth>& collisions, int lane, const Candidate& pair) const {
  collisions.first.row(lane) = motions_.col(pair.first).head<6>();
  collisions.second.row(lane) = motions_.col(pair.second).head<6>();
  collisions.height[lane] = open_unit32(pair.words[2]);
  collisions.turn[lane] = open_unit32(pair.words[3]);
}

template <int kWidth>
void Group::store(const Collisions<kWidth>& collisions, int lane, const Candidate& pair) {
  motion(pair.first) = collisions.first.row(lane);
  motion(pair.second) = collisions.second.row(lane);
  speeds_[pair.first] = collisions.first_speed[lane];
  speeds_[pair.second] = collisions.second_speed[lane];
  ++collisions_;
}

bool Group::share_particles(const Candidates& firsts, const Candidates& seconds,
                            const Candidates& pairs) {
  unsigned repeated = 0;
  for (const Candidate& pair : pairs) {
    repeated += touched_[pair.first];
    touched_[pair.first] = 1;
    repeated += touched_[pair.second];
    touched_[pair.second] = 1;
  }
  // Each pair meets itself once among the firsts and once among the seconds.
  std::size_t met = 0;
  for (const Candidate& candidate : firsts) {
    met += touched_[candidate.first];
  }
  for (const Candidate& candidate : seconds) {
    met += touched_[candidate.second];
  }
  for (const Candidate& pair : pairs) {
    touched_[pair.first] = 0;
    touched_[pair.second] = 0;
  }
  return repeated > 0 || met > 2 * pairs.count;
}

bool Group::collide_at_once(const Law& law, const Candidates& pairs) {
  std::array<Collisions<kLanes>, kBatch / kLanes> chunks;
  double fastest = 0;
  for (std::size_t begin = 0; begin < pairs.count; begin += kLanes) {
    Collisions<kLanes>& chunk = chunks[begin / kLanes];
    for (std::size_t lane = 0; lane < kLanes; ++lane) {  // what is over repeats the last
      load(chunk, static_cast<int>(lane), pairs.all[std::min(begin + lane, pairs.count - 1)]);
    }
    chunk.compute(law);
    fastest = std::max(fastest, chunk.first_speed.max(chunk.second_speed).maxCoeff());
  }
  if (fastest > fastest_) {
    return false;
  }
  for (std::size_t i = 0; i < pairs.count; ++i) {
    store(chunks[i / kLanes], static_cast<int>(i % kLanes), pairs.all[i]);
  }
  return true;
}

bool Group::decide_at_once(const Law& law, const GroupKey& key, std::uint32_t batch,
                           const Candidates& firsts) {
  Candidates seconds;
  for (const Candidate& candidate : firsts) {
    seconds.push(candidate, goes_on(candidate));
  }
  Candidates pairs;
  for (std::size_t i = 0; i < seconds.count; ++i) {
    draw_second(key, batch, seconds.all[i]);
    pairs.push(seconds.all[i], meets(seconds.all[i]));
  }
  return !share_particles(firsts, seconds, pairs) && collide_at_once(law, pairs);
}

std::size_t Group::decide_one_by_one(const Law& law, const GroupKey& key, std::uint32_t batch,
                                     const Candidates& firsts) {
  for (Candidate candidate : firsts) {
    if (!goes_on(candidate)) {
      continue;
    }
    draw_second(key, batch, candidate);
    if (!meets(candidate)) {
      continue;
    }
    Collisions<1> collision;
    load(collision, 0, candidate);
    collision.compute(law);
    store(collision, 0, candidate);
    if (std::max(collision.first_speed[0], collision.second_speed[0]) > fastest_) {
      return candidate.number + 1;
    }
  }
  return firsts.count;
}

std::uint64_t Group::collide(const Law& law, const GroupKey& key, double duration) {
  collisions_ = 0;
  measure_speeds();
  // What is left at the end, less than a candidate, counts as one as often as it is large.
  const double share = open_unit32(
      random::words(key.seed, {key.step, key.group, 0}, random::Purpose::last_candidate)[0]);
  double left = duration;
  std::size_t since_measured = 0;
  for (std::uint32_t batch = 0; fastest_ > 0; ++batch) {
    const double waiting = 1 / (static_cast<double>(particles()) * fastest_);
    const double candidates = std::floor(left / waiting + share);
    if (candidates < 1) {
      break;
    }
    const Candidates firsts =
        draw_firsts(key, batch, static_cast<std::size_t>(std::min<double>(candidates, kBatch)));
    const std::size_t decided = decide_at_once(law, key, batch, firsts)
                                    ? firsts.count
                                    : decide_one_by_one(law, key, batch, firsts);
    left -= static_cast<double>(decided) * waiting;
    since_measured += decided;
    if (decided < firsts.count || since_measured >= static_cast<std::size_t>(particles())) {
      fastest_ = speeds_.maxCoeff();
      since_measured = 0;
    }
  }
  return collisions_;
}

}  // namespace clca::boltzmann
