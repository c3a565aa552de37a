#include "problems/setup/orientations.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/base/units.h"
#include "problems/start.h"

namespace dhcal {
namespace {

constexpr std::size_t kFewest = 4;  // orientations
constexpr std::size_t kMost = 200;  // that are looked at
constexpr int kTurns = 30;          // of the alternation for two unknown frames

using Rotations = std::vector<Eigen::Matrix3d>;

Eigen::Matrix3d RotationOf(const Eigen::RowVector4d& q) {
  return Eigen::Quaterniond(q[0], q[1], q[2], q[3]).normalized().toRotationMatrix();
}

double Rms(const Rotations& measured,
           const Rotations& arm,
           const Eigen::Matrix3d& left,
           const Eigen::Matrix3d& right) {
  double squares = 0;
  for (std::size_t k = 0; k < arm.size(); ++k) {
    const Eigen::AngleAxisd off((left * arm[k] * right).transpose() * measured[k]);
    squares += off.angle() * off.angle();
  }
  return std::sqrt(squares / static_cast<double>(arm.size()));
}

/// Of L A R = M with L known.
Eigen::Matrix3d RightOf(const Rotations& measured,
                        const Rotations& arm,
                        const Eigen::Matrix3d& left) {
  Rotations right;
  for (std::size_t k = 0; k < arm.size(); ++k) {
    right.push_back((left * arm[k]).transpose() * measured[k]);
  }
  return MeanRotation(right);
}

/// The misfit of L A R = M with both unknown: one after the other from a start.
double MisfitOfBoth(const Rotations& measured, const Rotations& arm, Eigen::Matrix3d left) {
  Eigen::Matrix3d right = RightOf(measured, arm, left);
  for (int turn = 0; turn < kTurns; ++turn) {
    Rotations of_left;
    for (std::size_t k = 0; k < arm.size(); ++k) {
      of_left.push_back(measured[k] * (arm[k] * right).transpose());
    }
    left = MeanRotation(of_left);
    right = RightOf(measured, arm, left);
  }
  return Rms(measured, arm, left, right);
}

/// Starts for an unknown turn: the quarter turns about the axes.
Rotations Starts(const Eigen::Matrix3d& left) {
  Rotations starts;
  for (const Eigen::Vector3d& axis : {Eigen::Vector3d::UnitX().eval(),
                                      Eigen::Vector3d::UnitY().eval(),
                                      Eigen::Vector3d::UnitZ().eval()}) {
    for (int quarter = 0; quarter < 4; ++quarter) {
      starts.emplace_back(Eigen::AngleAxisd(quarter * kPi / 2, axis) * left);
    }
  }
  return starts;
}

}  // namespace

Eigen::MatrixXd InForm(const Eigen::MatrixXd& quaternions, const QuaternionForm& form) {
  Eigen::MatrixXd read(quaternions.rows(), 4);
  for (int k = 0; k < 4; ++k) {
    const double sign = form.inverse && k > 0 ? -1 : 1;
    read.col(k) = sign * quaternions.col(form.order[static_cast<std::size_t>(k)]);
  }
  return read;
}

std::optional<OrientationForms> JudgeOrientations(const Calibration& c) {
  const Recording& recording = c.recording;
  const Eigen::VectorXd zero =
      Eigen::VectorXd::Zero(static_cast<Eigen::Index>(c.parameters.size()));
  if (recording.quaternion.rows() == 0) return std::nullopt;
  std::vector<int> rows;
  for (const Reading& reading : c.readings.fitted) {
    const int row = reading.row_idx, first = rows.empty() ? row : rows.front();
    const bool alike =
        recording.run(row) == recording.run(first) && c.Target(row) == c.Target(first);
    if (alike && recording.quaternion.row(row).allFinite()) rows.push_back(row);
  }
  if (rows.size() < kFewest) return std::nullopt;
  const std::size_t step = (rows.size() + kMost - 1) / kMost;
  Rotations arm;
  Eigen::MatrixXd quaternions(0, 4);
  Eigen::Matrix3d left = Eigen::Matrix3d::Identity();
  for (std::size_t k = 0; k < rows.size(); k += step) {
    const int row = rows[k];
    const Eigen::Matrix3d tool = c.frames.tool(c.Labels(row)).linear();
    left = c.frames.base(c.Labels(row)).linear();
    arm.emplace_back(left.transpose() * c.Pose(zero, row).linear() * tool.transpose());
    quaternions.conservativeResize(quaternions.rows() + 1, 4);
    quaternions.bottomRows<1>() = recording.quaternion.row(row);
  }
  const auto in_form = [&](const QuaternionForm& form) {
    Rotations rotations;
    const Eigen::MatrixXd read = InForm(quaternions, form);
    for (Eigen::Index k = 0; k < read.rows(); ++k) rotations.push_back(RotationOf(read.row(k)));
    return rotations;
  };
  OrientationForms forms;
  const auto judge = [&](QuaternionForm form) {
    const Rotations measured = in_form(form);
    form.misfit = Rms(measured, arm, left, RightOf(measured, arm, left));
    return form;
  };
  forms.as_written = forms.best = judge({});
  std::array<int, 4> order = {0, 1, 2, 3};
  do {
    for (const bool inverse : {false, true}) {
      const QuaternionForm form = judge({order, inverse, false, 0});
      if (form.misfit < forms.best.misfit) forms.best = form;
    }
  } while (std::next_permutation(order.begin(), order.end()));
  if (forms.best.misfit < kFollowsRobot) return forms;
  for (const bool inverse : {false, true}) {
    QuaternionForm form{{0, 1, 2, 3}, inverse, true, 0};
    const Rotations measured = in_form(form);
    for (const Eigen::Matrix3d& start : Starts(left)) {
      form.misfit = MisfitOfBoth(measured, arm, start);
      if (form.misfit < forms.best.misfit) forms.best = form;
    }
  }
  return forms;
}

}  // namespace dhcal
