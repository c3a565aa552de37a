// The measuring head over straight edges, written apart from the product: planes and lines in the
// base frame, analytic in the scalar, so that it also runs with std::complex<double>.
#ifndef DHCAL_TESTS_SUPPORT_EDGE_HEAD_H_
#define DHCAL_TESTS_SUPPORT_EDGE_HEAD_H_

#include <cstdint>
#include <functional>
#include <map>
#include <string>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "core/model/problem_spec.h"
#include "core/model/recording.h"
#include "tests/support/independent_kinematics.h"

namespace dhcal::independent {

/// Ruler, height1, height2 of a head at X_BQ over an edge at X_BE [m]: each sight is a line that
/// meets the plane through a point of the face with the edge's normal.
template <typename T>
Eigen::Matrix<T, 3, 1> HeadNumbers(const HeadSpec& head,
                                   const Matrix4<T>& X_BQ,
                                   const Matrix4<T>& X_BE) {
  using Vector3T = Eigen::Matrix<T, 3, 1>;
  // Not Eigen's dot, which conjugates complex numbers.
  const auto dot = [](const Vector3T& a, const Vector3T& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  };
  const Matrix3<T> R = X_BQ.template topLeftCorner<3, 3>();
  const Vector3T x = X_BE.template block<3, 1>(0, 0), n = X_BE.template block<3, 1>(0, 2);
  const Vector3T on_face = X_BE.template block<3, 1>(0, 3);
  const auto sight = [&](const HeadSensor& sensor, const Vector3T& on_plane, Vector3T* spot) {
    const Vector3T from = X_BQ.template block<3, 1>(0, 3) + R * sensor.p_QS.cast<T>();
    const Vector3T along = R * sensor.axis.cast<T>();
    const T length = dot(n, on_plane - from) / dot(n, along);
    *spot = from + along * length;
    return length;
  };
  Vector3T spot;
  sight(head.camera, on_face + n * T(head.ruler_height), &spot);
  Eigen::Matrix<T, 3, 1> numbers;
  numbers[0] = dot(x, spot - on_face);
  numbers[1] = sight(head.lasers[0], on_face, &spot);
  numbers[2] = sight(head.lasers[1], on_face, &spot);
  return numbers;
}

/// A robot and edges that differ from the nominal ones.
struct HeadTruth {
  Eigen::VectorXd delta;                           // slot errors; of the base none
  std::map<std::string, Eigen::Isometry3d> edges;  // X_BE by name
};

/// Errors of usual sizes on rows (beta only where `complete` has one) and tool, and edges that
/// stand elsewhere by centimetres and degrees.
HeadTruth MakeHeadTruth(const ProblemSpec& spec, std::uint64_t seed);

/// X_BQ of a row.
Matrix4<double> PoseOfRow(const ProblemSpec& spec,
                          const HeadTruth& truth,
                          const Recording& rows,
                          int row_idx);

/// The numbers that a head reads at a row.
Eigen::Vector3d NumbersOfRow(const ProblemSpec& spec,
                             const HeadTruth& truth,
                             const Recording& rows,
                             int row_idx);

/// `rows` with head readings of these numbers [m], each sensor with its noise times `noise`.
Recording RecordNumbers(const ProblemSpec& spec,
                        const Recording& rows,
                        double noise,
                        std::uint64_t seed,
                        const std::function<Eigen::Vector3d(int row_idx)>& numbers);

/// `rows` with head readings of the true robot, each sensor with its noise times `noise` [m].
Recording RecordHead(const ProblemSpec& spec,
                     const HeadTruth& truth,
                     const Recording& rows,
                     double noise,
                     std::uint64_t seed);

/// Differences of adjacent rows of the fitted set by every slot of rows and tool that `complete`
/// has, and by the six freedoms of each edge about its own origin: complex step. Columns are per
/// 3 mrad, 0.5 mm and so on, so that their sizes compare.
Eigen::MatrixXd HeadJacobian(const ProblemSpec& spec,
                             const HeadTruth& truth,
                             const Recording& rows);

}  // namespace dhcal::independent

#endif  // DHCAL_TESTS_SUPPORT_EDGE_HEAD_H_
