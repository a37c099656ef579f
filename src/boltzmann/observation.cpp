#include "clca/boltzmann/observation.hpp"

#include <algorithm>
#include <stdexcept>

namespace clca::boltzmann {

namespace {

using Eigen::Index;

/// Sums over particles: of v^2, w^2, v^4, w^4, v^2 w^2, (v w)^2, v_x^2, v_y^2 and v_x v_y.
using Sums = Eigen::Array<double, 9, 1>;

/// Added up by blocks of the gas so that rounding stays far below the noise of a million particles.
Sums sums(const Motions& motions) {
  constexpr Index kPiece = 1024;
  Sums all = Sums::Zero();
  for (Index begin = 0; begin < motions.cols(); begin += kPiece) {
    Sums piece = Sums::Zero();
    for (Index i = begin; i < std::min(begin + kPiece, motions.cols()); ++i) {
      const Eigen::Vector3d v = motions.col(i).head<3>().matrix();
      const Eigen::Vector3d w = motions.col(i).tail<3>().matrix();
      const double v2 = v.squaredNorm();
      const double w2 = w.squaredNorm();
      const double vw = v.dot(w);
      piece += (Sums() << v2, w2, v2 * v2, w2 * w2, v2 * w2, vw * vw, v.x() * v.x(), v.y() * v.y(),
                v.x() * v.y())
                   .finished();
    }
    all += piece;
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
  const double v2 = sum[0];
  const double w2 = sum[1];
  const auto count = static_cast<double>(motions.cols());
  const double correlation = excess(count * sum[4], v2 * w2);
  const Eigen::Array3d pressure = (v2 > 0 ? 3 / v2 : 1) * sum.tail<3>();
  return {.translational = v2 / count / 3,
          .rotational = w2 / count / 3,
          .a2_translational = excess(3 * count * sum[2], 5 * v2 * v2),
          .a2_rotational = excess(3 * count * sum[3], 5 * w2 * w2),
          .correlation = correlation,
          .alignment = excess(3 * count * sum[5], v2 * w2) - correlation,
          .p_xx = pressure[0],
          .p_yy = pressure[1],
          .p_xy = pressure[2]};
}

EnergyShares energy_shares(const Motions& motions, const Moments& moments,
                           const statistics::Bins& bins) {
  return {
      .translational = statistics::bin_shares(energies(motions, 0, moments.translational), bins),
      .rotational = statistics::bin_shares(energies(motions, 3, moments.rotational), bins)};
}

}  // namespace clca::boltzmann
