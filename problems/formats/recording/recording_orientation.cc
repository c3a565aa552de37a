#include "problems/formats/recording/recording_orientation.h"

#include <cmath>
#include <limits>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "core/math/rotation.h"

namespace dhcal {

namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

Eigen::RowVector4d QuaternionOf(const Eigen::Matrix3d& R) {
  const Eigen::Quaterniond q(R);
  return Eigen::RowVector4d(q.w(), q.x(), q.y(), q.z()).normalized();
}

Eigen::MatrixXd ReadQuaternions(const FieldColumns& field, const CellReader& cells) {
  constexpr double kNormTolerance = 0.01;  // what rounding in the file may explain
  Eigen::MatrixXd quaternions = cells.ReadCoordinates(field);
  for (int row = 0; row < quaternions.rows(); ++row) {
    const double norm = quaternions.row(row).norm();
    if (std::isnan(norm)) continue;
    if (std::abs(norm - 1.0) <= kNormTolerance) {
      quaternions.row(row) /= norm;
      continue;
    }
    cells.Error(row,
                field.column[0],
                fmt::format("the quaternion qw, qx, qy, qz has the norm {:.4g}; a norm from 0.99 "
                            "to 1.01 is expected",
                            norm));
  }
  return quaternions;
}

/// The nearest rotation to a matrix that rounding has touched; an error when it is no rotation.
Eigen::MatrixXd ReadMatrices(const FieldColumns& field, const CellReader& cells) {
  constexpr double kTolerance = 0.01;
  const Eigen::MatrixXd numbers = cells.ReadCoordinates(field);
  Eigen::MatrixXd quaternions = Eigen::MatrixXd::Constant(numbers.rows(), 4, kNone);
  for (int row = 0; row < numbers.rows(); ++row) {
    if (!numbers.row(row).allFinite()) continue;
    Eigen::Matrix3d R;
    for (int k = 0; k < 9; ++k) R(k / 3, k % 3) = numbers(row, k);
    const double off = (R * R.transpose() - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
    if (off > kTolerance || R.determinant() < 0) {
      cells.Error(row,
                  field.column[0],
                  fmt::format("the matrix m11 ... m33 is no rotation: R R' is off the unit matrix "
                              "by {:.2g}, its determinant is {:.2g}; expected are rows of length "
                              "1, at right angles, right-handed",
                              off,
                              R.determinant()));
      continue;
    }
    const Eigen::JacobiSVD<Eigen::Matrix3d> svd(R, Eigen::ComputeFullU | Eigen::ComputeFullV);
    quaternions.row(row) = QuaternionOf(svd.matrixU() * svd.matrixV().transpose());
  }
  return quaternions;
}

Eigen::MatrixXd ReadAngles(RecordingField form,
                           const FieldColumns& field,
                           const CellReader& cells) {
  const Eigen::MatrixXd numbers = cells.ReadCoordinates(field);
  Eigen::MatrixXd quaternions = Eigen::MatrixXd::Constant(numbers.rows(), 4, kNone);
  for (int row = 0; row < numbers.rows(); ++row) {
    if (!numbers.row(row).allFinite()) continue;
    quaternions.row(row) = QuaternionOf(RotationOf(form, numbers.row(row).transpose()));
  }
  return quaternions;
}

/// A matrix that was written column by column shows its position in the last row.
void CheckLastRow(const FieldColumns& field, const CellReader& cells) {
  const Eigen::MatrixXd numbers = cells.ReadNumbers(field, kAnyNumber);
  const Eigen::RowVector4d expected(0, 0, 0, 1);
  for (int row = 0; row < numbers.rows(); ++row) {
    for (int k = 0; k < 4; ++k) {
      if (field.column[k] < 0 || std::isnan(numbers(row, k)) || numbers(row, k) == expected[k]) {
        continue;
      }
      cells.Error(row,
                  field.column[k],
                  fmt::format("{} must be {}: the last row of a pose's matrix is 0 0 0 1; was it "
                              "written column by column?",
                              numbers(row, k),
                              expected[k]));
      return;
    }
  }
}

}  // namespace

Eigen::Matrix3d RotationOf(RecordingField form, const Eigen::Vector3d& numbers) {
  switch (form) {
    case RecordingField::kRotationVector:
      return ExpSO3<double>(numbers);
    case RecordingField::kAbc:
      return RotationFromRpy(numbers.reverse());
    case RecordingField::kEulerXyz:
      // Undone, it turns by the opposite angles about the fixed axes in the opposite order.
      return RotationFromRpy(-numbers).transpose();
    default:
      return RotationFromRpy(numbers);
  }
}

Eigen::MatrixXd ReadOrientations(const RecordingLayout& layout, const CellReader& cells) {
  if (layout.Has(RecordingField::kMatrixLastRow)) {
    CheckLastRow(layout.fields.at(RecordingField::kMatrixLastRow), cells);
  }
  for (const RecordingField form : OrientationFields()) {
    if (!layout.Has(form)) continue;
    const FieldColumns& field = layout.fields.at(form);
    if (form == RecordingField::kQuaternion) return ReadQuaternions(field, cells);
    if (form == RecordingField::kMatrix) return ReadMatrices(field, cells);
    return ReadAngles(form, field, cells);
  }
  return {};
}

}  // namespace dhcal
