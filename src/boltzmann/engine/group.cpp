#include "boltzmann/engine/group.hpp"

#include <algorithm>
#include <cmath>

namespace clca::boltzmann {

namespace {

/// 0 to count - 1, from 32 uniform bits.
std::uint32_t below32(std::uint32_t bits, std::uint32_t count) {
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
  speeds_ = motions_.topLeftCorner(3, particle_count()).square().colwise().sum().sqrt();
  fastest_ = speeds_.maxCoeff();
}

void Group::draw_firsts(const GroupKey& key, std::uint32_t batch, std::size_t count) {
  constexpr std::size_t kWords = std::tuple_size_v<random::Words>;
  const auto size = static_cast<std::uint64_t>(particle_count());
  candidate_count_ = count;
  for (std::size_t i = 0; i < count; i += kWords) {
    const auto item = static_cast<std::uint32_t>((batch * kBatch + i) / kWords);
    const random::Words words =
        random::drawn_words(key.seed, {key.step, key.group, item}, random::Purpose::candidate);
    for (std::size_t k = 0; k < kWords; ++k) {
      // The integer part selects the particle; the fraction is its acceptance draw.
      const std::uint64_t product = words[k] * size;
      candidates_[i + k].first = static_cast<std::uint32_t>(product >> 32U);
      candidates_[i + k].chance = static_cast<std::uint32_t>(product);
    }
  }
}

void Group::draw_second(const GroupKey& key, std::uint32_t batch, std::size_t number) {
  Candidate& candidate = candidates_[number];
  const auto item = static_cast<std::uint32_t>(batch * kBatch + number);
  candidate.words =
      random::drawn_words(key.seed, {key.step, key.group, item}, random::Purpose::normal);
  candidate.second = below32(candidate.words[0], static_cast<std::uint32_t>(particle_count() - 1));
  candidate.second += candidate.second >= candidate.first ? 1 : 0;
}

bool Group::passes_speed_test(const Candidate& candidate) const {
  return open_uniform32(candidate.chance) * fastest_ < speeds_[candidate.first];
}

bool Group::collides(const Candidate& candidate) const {
  const double speeds = speeds_[candidate.first] + speeds_[candidate.second];
  const double square =
      (motions_.col(candidate.first).head<3>() - motions_.col(candidate.second).head<3>())
          .square()
          .sum();
  const double bound = open_uniform32(candidate.words[1]) * speeds;
  return bound * bound < square;
}

template <int kWidth>
void Group::load(Collisions<kWidth>& collisions, int lane, const Candidate& pair) const {
  collisions.first.row(lane) = motions_.col(pair.first).head<6>();
  collisions.second.row(lane) = motions_.col(pair.second).head<6>();
  collisions.height[lane] = open_uniform32(pair.words[2]);
  collisions.azimuth[lane] = open_uniform32(pair.words[3]);
}

template <int kWidth>
void Group::store(const Collisions<kWidth>& collisions, int lane, const Candidate& pair) {
  motion(pair.first) = collisions.first.row(lane);
  motion(pair.second) = collisions.second.row(lane);
  speeds_[pair.first] = collisions.first_speed[lane];
  speeds_[pair.second] = collisions.second_speed[lane];
  ++collisions_;
}

bool Group::pairs_share_particle() {
  unsigned repeated = 0;
  for (const std::size_t pair : colliding_) {
    repeated += touched_[candidates_[pair].first];
    touched_[candidates_[pair].first] = 1;
    repeated += touched_[candidates_[pair].second];
    touched_[candidates_[pair].second] = 1;
  }
  // Every pair finds itself once among the first and once among the second particles.
  std::size_t met = 0;
  for (std::size_t i = 0; i < candidate_count_; ++i) {
    met += touched_[candidates_[i].first];
  }
  for (const std::size_t number : accepted_) {
    met += touched_[candidates_[number].second];
  }
  for (const std::size_t pair : colliding_) {
    touched_[candidates_[pair].first] = 0;
    touched_[candidates_[pair].second] = 0;
  }
  return repeated > 0 || met > 2 * colliding_.count;
}

bool Group::collide_at_once(const Law& law) {
  const std::size_t chunks = (colliding_.count + kLanes - 1) / kLanes;
  for (std::size_t i = 0; i < chunks * kLanes; ++i) {  // filled up with the last pair
    const std::size_t pair = colliding_.numbers[std::min(i, colliding_.count - 1)];
    load(chunks_[i / kLanes], static_cast<int>(i % kLanes), candidates_[pair]);
  }
  double fastest = 0;
  for (std::size_t i = 0; i < chunks; ++i) {
    chunks_[i].compute(law);
    fastest = std::max(fastest, chunks_[i].first_speed.max(chunks_[i].second_speed).maxCoeff());
  }
  if (fastest > fastest_) {
    return false;
  }
  for (std::size_t i = 0; i < colliding_.count; ++i) {
    store(chunks_[i / kLanes], static_cast<int>(i % kLanes), candidates_[colliding_.numbers[i]]);
  }
  return true;
}

bool Group::decide_at_once(const Law& law, const GroupKey& key, std::uint32_t batch) {
  accepted_.count = 0;
  colliding_.count = 0;
  for (std::size_t i = 0; i < candidate_count_; ++i) {
    accepted_.append(i, passes_speed_test(candidates_[i]));
  }
  for (const std::size_t number : accepted_) {
    draw_second(key, batch, number);
    colliding_.append(number, collides(candidates_[number]));
  }
  return !pairs_share_particle() && collide_at_once(law);
}

std::size_t Group::decide_one_by_one(const Law& law, const GroupKey& key, std::uint32_t batch) {
  for (std::size_t i = 0; i < candidate_count_; ++i) {
    const Candidate& candidate = candidates_[i];
    if (!passes_speed_test(candidate)) {
      continue;
    }
    draw_second(key, batch, i);
    if (!collides(candidate)) {
      continue;
    }
    Collisions<1> collision;
    load(collision, 0, candidate);
    collision.compute(law);
    store(collision, 0, candidate);
    if (std::max(collision.first_speed[0], collision.second_speed[0]) > fastest_) {
      return i + 1;
    }
  }
  return candidate_count_;
}

std::uint64_t Group::collide(const Law& law, const GroupKey& key, double duration) {
  collisions_ = 0;
  measure_speeds();
  // The remaining fraction of a candidate becomes a whole one with that probability.
  const double share = open_uniform32(
      random::drawn_words(key.seed, {key.step, key.group, 0}, random::Purpose::last_candidate)[0]);
  double left = duration;
  std::size_t since_measured = 0;
  for (std::uint32_t batch = 0; fastest_ > 0; ++batch) {
    const double waiting = 1 / (static_cast<double>(particle_count()) * fastest_);
    const double candidates = std::floor(left / waiting + share);
    if (candidates < 1) {
      break;
    }
    draw_firsts(key, batch, static_cast<std::size_t>(std::min<double>(candidates, kBatch)));
    const std::size_t decided =
        decide_at_once(law, key, batch) ? candidate_count_ : decide_one_by_one(law, key, batch);
    left -= static_cast<double>(decided) * waiting;
    since_measured += decided;
    if (decided < candidate_count_ ||
        since_measured >= static_cast<std::size_t>(particle_count())) {
      fastest_ = speeds_.maxCoeff();
      since_measured = 0;
    }
  }
  return collisions_;
}

}  // namespace clca::boltzmann
