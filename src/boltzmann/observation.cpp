#include "clca/boltzmann/observation.hpp"

#include <algorithm>
#include <stdexcept>

namespace clca::boltzmann {

namespace {

using Eigen::Index;

/// Sums over particles, added up by blocks of the gas so that rounding stays far below the noise of
/// a million particles.
struct Sums {
  double v2 = 0;
  double w2 = 0;
  double v4 = 0;
  double w4 = 0;
  double v2w2 = 0;
  double vw_squared = 0;
  Eigen::Array3d products = Eigen::Array3d::Zero();  // of v: x x, y y, x y

  void add(const Eigen::Vector3d& v, const Eigen::Vector3d& w) {
    const double v_squared = v.squaredNorm();
    const double w_squared = w.squaredNorm();
    const double v_dot_w = v.dot(w);
    v2 += v_squared;
    w2 += w_squared;
    v4 += v_squared * v_squared;
    w4 += w_squared * w_squared;
    v2w2 += v_squared * w_squared;
    vw_squared += v_dot_w * v_dot_w;
    products += Eigen::Array3d(v.x() * v.x(), v.y() * v.y(), v.x() * v.y());
  }
  void add(const Sums& other) {
    v2 += other.v2;
    w2 += other.w2;
    v4 += other.v4;
    w4 += other.w4;
    v2w2 += other.v2w2;
    vw_squared += other.vw_squared;
    products += other.products;
  }
};

Sums sums(const Motions& motions) {
  constexpr Index kPiece = 1024;
  Sums all;
  for (Index begin = 0; begin < motions.cols(); begin += kPiece) {
    Sums piece;
    for (Index i = begin; i < std::min(begin + kPiece, motions.cols()); ++i) {
      piece.add(motions.col(i).head<3>().matrix(), motions.col(i).tail<3>().matrix());
    }
    all.add(piece);
  }
  return all;
}

/// numerator / denominator - 1, or 0 if the denominator is 0.
double excess(double numerator, double denominator) {
  return denominator > 0 ? numerator / denominator - 1 : 0;
}

/// Squared norm of three rows from `row` on, divided by `scale`; none if the scale is 0.
std::vector<double> energies(const Motions& motions, Index row, double scale) {
  std::vector<double> result;
  if (scale > 0) {
    result.resize(static_cast<std::size_t>(motions.cols()));
    for (Index i = 0; i < motions.cols(); ++i) {
      result[static_cast<std::size_t>(i)] =
          motions.col(i).segment<3>(row).matrix().squaredNorm() / scale;
    }
  }
  return result;
}

}  // namespace

Moments moments(const Motions& motions) {
  if (motions.cols() == 0) {
    throw std::invalid_argument("a gas without particles has no moments");
  }
  const Sums sum = sums(motions);
  const auto count = static_cast<double>(motions.cols());
  const double correlation = excess(count * sum.v2w2, sum.v2 * sum.w2);
  const Eigen::Array3d pressure = sum.v2 > 0 ? 3 / sum.v2 * sum.products : sum.products;
  return {.translational = sum.v2 / count / 3,
          .rotational = sum.w2 / count / 3,
          .a2_translational = excess(3 * count * sum.v4, 5 * sum.v2 * sum.v2),
          .a2_rotational = excess(3 * count * sum.w4, 5 * sum.w2 * sum.w2),
          .correlation = correlation,
          .alignment = excess(3 * count * sum.vw_squared, sum.v2 * sum.w2) - correlation,
          .p_xx = pressure[0],
          .p_yy = pressure[1],
          .p_xy = pressure[2]};
}

EnergyShares energy_shares(const Motions& motions, const Moments& moments,
                           const statistics::Bins& bins) {
  return {.translational = statistics::shares(energies(motions, 0, moments.translational), bins),
          .rotational = statistics::shares(energies(motions, 3, moments.rotational), bins)};
}

}  // namespace clca::boltzmann
