#include "boltzmann/engine/grouping.hpp"

#include <algorithm>

#include "clca/random/draw.hpp"

namespace clca::boltzmann {

namespace {

bool is_prime(std::uint64_t number) {
  for (std::uint64_t divisor = 2; divisor * divisor <= number; ++divisor) {
    if (number % divisor == 0) {
      return false;
    }
  }
  return number >= 2;
}

std::uint64_t prime_from(std::uint64_t number) {
  while (!is_prime(number)) {
    ++number;
  }
  return number;
}

std::uint64_t draw(std::uint64_t seed, std::uint64_t step, std::uint32_t item) {
  return random::draw(seed, step, item, random::Purpose::regroup);
}

}  // namespace

StridedPermutation::StridedPermutation(std::uint64_t count)
    : count_(count), modulus_(prime_from(count)) {}

void StridedPermutation::shuffle(std::uint64_t start_bits, std::uint64_t stride_bits) {
  start_ = random::uniform_below(start_bits, modulus_);
  stride_ = 1 + random::uniform_below(stride_bits, modulus_ - 1);
}

Grouping::Grouping(Eigen::Index particles, Eigen::Index group_size)
    : particles_(particles),
      groups_(std::max<Eigen::Index>(1, particles / group_size)),
      block_order_(static_cast<std::uint64_t>((particles + kBlockSize - 1) / kBlockSize)) {}

void Grouping::shuffle(std::uint64_t seed, std::uint64_t step) {
  seed_ = seed;
  step_ = step;
  block_order_.shuffle(draw(seed, step, 0), draw(seed, step, 1));
}

void Grouping::members(Eigen::Index group, std::vector<Eigen::Index>& sources,
                       std::vector<Eigen::Index>& targets) const {
  sources.clear();
  const auto add_block = [&](std::uint64_t block) {
    const auto begin = static_cast<Eigen::Index>(block) * kBlockSize;
    for (Eigen::Index i = begin; i < std::min(begin + kBlockSize, particles_); ++i) {
      sources.push_back(i);
    }
  };
  block_order_.visit_part(static_cast<std::uint64_t>(group), static_cast<std::uint64_t>(groups_),
                          add_block);
  StridedPermutation order(sources.size());
  const auto item = 2 * static_cast<std::uint32_t>(group) + 2;
  order.shuffle(draw(seed_, step_, item), draw(seed_, step_, item + 1));
  targets.clear();
  order.visit_part(0, 1, [&](std::uint64_t number) { targets.push_back(sources[number]); });
}

}  // namespace clca::boltzmann
