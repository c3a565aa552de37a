#include "tools/proof/simulator/random/poses.h"

#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "core/base/units.h"
#include "tools/proof/simulator/random/draw.h"

namespace dhcal::concealed {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kSecondsStanding = 20, kSecondsStreaming = 0.5;

MatrixXd AnywhereInRange(const Arm& arm, int poses, Rng* rng) {
  MatrixXd q(poses, arm.num_joints());
  for (Index k = 0; k < q.rows(); ++k) {
    for (Index j = 0; j < q.cols(); ++j) {
      q(k, j) = arm.middle[j] + arm.wide[j] * rng->Uniform(-1, 1);
    }
  }
  return q;
}

/// Every joint at a few angles, in combinations drawn from all.
MatrixXd OnGrid(const Arm& arm, int poses, Rng* rng) {
  MatrixXd q(poses, arm.num_joints());
  for (Index j = 0; j < q.cols(); ++j) {
    const int levels = 5 + DrawInt(4, rng);
    for (Index k = 0; k < q.rows(); ++k) {
      q(k, j) = arm.middle[j] + arm.wide[j] * (-1 + 2.0 * DrawInt(levels, rng) / (levels - 1));
    }
  }
  return q;
}

/// A smooth path: two oscillations per joint, with its speeds.
void Stream(const Arm& arm, Motion* motion, Rng* rng) {
  const Index poses = motion->q.rows();
  const double duration = kSecondsStreaming * static_cast<double>(poses);
  for (Index j = 0; j < motion->q.cols(); ++j) {
    const double slow = rng->Uniform(1.5, 6), fast = slow * rng->Uniform(1.5, 3);
    const double phase = rng->Uniform(-kPi, kPi), other = rng->Uniform(-kPi, kPi);
    for (Index k = 0; k < poses; ++k) {
      const double u = 2 * kPi * static_cast<double>(k) / static_cast<double>(poses);
      motion->q(k, j) = arm.middle[j] + arm.wide[j] * (0.7 * std::sin(slow * u + phase) +
                                                       0.3 * std::sin(fast * u + other));
      motion->speed(k, j) =
          arm.wide[j] * (2 * kPi / duration) *
          (0.7 * slow * std::cos(slow * u + phase) + 0.3 * fast * std::cos(fast * u + other));
    }
  }
}

void TakePoses(const Settings& settings, const Arm& arm, Motion* motion, Rng* rng) {
  const int poses = settings.rows / settings.repeats;
  if (settings.order == Order::kStreamed) {
    motion->q.resize(poses, arm.num_joints());
    motion->speed.resize(poses, arm.num_joints());
    Stream(arm, motion, rng);
    return;
  }
  motion->q =
      settings.order == Order::kGrid ? OnGrid(arm, poses, rng) : AnywhereInRange(arm, poses, rng);
}

void Repeat(int repeats, Motion* motion) {
  if (repeats == 1) return;
  const MatrixXd once = motion->q;
  motion->q.resize(once.rows() * repeats, once.cols());
  for (Index k = 0; k < motion->q.rows(); ++k) motion->q.row(k) = once.row(k / repeats);
}

/// Runs one after the other; targets in turn, pose by pose; test rows pose by pose, of differences
/// run by run.
void Label(const Settings& settings, Motion* motion) {
  constexpr int kTestStride = 5;
  const auto rows = static_cast<int>(motion->q.rows());
  for (int row = 0; row < rows; ++row) {
    const int pose = row / settings.repeats, poses = rows / settings.repeats;
    const int run = 1 + pose * settings.runs / poses;
    motion->run.push_back(run);
    if (settings.targets > 1) motion->target.push_back(pose % settings.targets);
    const bool test = settings.kind == Kind::kAdjacent ? settings.runs > 2 && run == settings.runs
                                                       : pose % kTestStride == kTestStride - 1;
    motion->test.push_back(settings.test_rows && test);
  }
}

}  // namespace

Motion DrawMotion(const Settings& settings, const Arm& arm, Rng* rng) {
  Motion motion;
  TakePoses(settings, arm, &motion, rng);
  if (settings.order == Order::kSorted) SortByFirstJoint(&motion);
  Repeat(settings.repeats, &motion);
  Label(settings, &motion);
  const bool streamed = settings.order == Order::kStreamed;
  const double step = streamed ? kSecondsStreaming : kSecondsStanding;
  motion.time = VectorXd::LinSpaced(
      motion.num_poses(), 0, step * static_cast<double>(motion.num_poses() - 1));
  motion.payload = VectorXd::Constant(motion.num_poses(), arm.payload);
  motion.payload_varies = settings.payload_varies;
  for (Index k = 0; settings.payload_varies && k < motion.payload.size();) {
    const double load = Chance(0.5, rng) ? arm.payload : 0;
    for (int r = 0; r < settings.repeats && k < motion.payload.size(); ++r) {
      motion.payload[k++] = load;
    }
  }
  return motion;
}

VectorXd ReadOutQuanta(const Settings& settings, const Arm& arm) {
  VectorXd quanta(arm.num_joints());
  for (Index j = 0; j < quanta.size(); ++j) {
    const bool slides = arm.links[static_cast<std::size_t>(j)].slides;
    quanta[j] = std::pow(10.0, -settings.decimals) * (slides ? kMillimetre : kDegree);
  }
  return quanta;
}

Eigen::MatrixXi Directions(const Motion& motion) {
  Eigen::MatrixXi directions = Eigen::MatrixXi::Zero(motion.q.rows(), motion.q.cols());
  for (Index k = 1; k < motion.q.rows(); ++k) {
    const auto i = static_cast<std::size_t>(k);
    if (motion.run[i] != motion.run[i - 1]) continue;
    for (Index j = 0; j < motion.q.cols(); ++j) {
      const double travel = motion.q(k, j) - motion.q(k - 1, j);
      directions(k, j) = travel > 0 ? 1 : travel < 0 ? -1 : directions(k - 1, j);
    }
  }
  return directions;
}

std::vector<int> RowsBefore(const Motion& motion) {
  std::vector<int> before;
  std::map<std::pair<int, int>, int> last;
  for (int row = 0; row < motion.num_poses(); ++row) {
    const auto i = static_cast<std::size_t>(row);
    const std::pair<int, int> series(motion.run[i], motion.target.empty() ? 0 : motion.target[i]);
    const auto [found, is_new] = last.emplace(series, row);
    before.push_back(is_new ? -1 : found->second);
    found->second = row;
  }
  return before;
}

}  // namespace dhcal::concealed
