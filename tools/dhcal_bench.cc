// Measures the inner loops of a linearisation: nanoseconds of one processor per pose.
//
//   dhcal_bench [POSES [REPEATS]]       default 100000 poses, 7 repeats
//
// A six-joint robot, 24 parameters (theta, d, a, alpha), random poses, positions. Each figure is
// the median of the repeats, in processor time, so that a busy machine disturbs it less. The bare
// kernel (tools/bench/bare_kernel.h) is what the arithmetic alone costs; `scalar` is a pose at a
// time with Householder.
#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <functional>
#include <vector>

#include <fmt/format.h>

#include "core/base/rng.h"
#include "core/base/units.h"
#include "core/kinematics/dh_chain.h"
#include "core/kinematics/pose_tile.h"
#include "core/math/row_reduction.h"
#include "core/math/tsqr.h"
#include "core/simd/aligned.h"
#include "core/simd/level.h"
#include "tools/bench/bare_kernel.h"

namespace dhcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kSigma = 1e-5;  // [m]
constexpr int kPoses = PoseTile::kPoses;

/// Robot of a KR 15's size.
RobotModel MakeRobot() {
  const double d[] = {0.675, 0, 0, 0.6, 0, 0.14};
  const double a[] = {0.3, 0.65, 0.155, 0, 0, 0};
  const double alpha_deg[] = {-90, 0, 90, -90, 90, 0};
  RobotModel robot;
  for (int i = 0; i < kBareJoints; ++i) {
    JointRow row;
    row.d = d[i];
    row.a = a[i];
    row.alpha = alpha_deg[i] * kDegree;
    robot.joints.push_back(row);
  }
  return robot;
}

struct Readings {
  MatrixXd q;     // joints x poses
  MatrixXd p_WQ;  // 3 x poses
};

Readings MakeReadings(const RobotModel& robot, int num_poses) {
  Rng rng(1);
  Readings readings{MatrixXd(robot.num_joints(), num_poses), MatrixXd(3, num_poses)};
  for (double& angle : readings.q.reshaped()) angle = rng.Uniform(-2.5, 2.5);
  const DhChain chain(robot);
  const VectorXd delta = VectorXd::Zero(chain.slots().size());
  for (int k = 0; k < num_poses; ++k) {
    readings.p_WQ.col(k) = chain.Pose<double>(readings.q.col(k), delta, {}).translation();
    for (int row = 0; row < 3; ++row) readings.p_WQ(row, k) += kSigma * rng.Normal();
  }
  return readings;
}

/// Median processor time of a run [s].
double SecondsOf(int repeats, const std::function<void()>& run) {
  std::vector<double> seconds;
  for (int k = 0; k < repeats; ++k) {
    const std::clock_t start = std::clock();
    run();
    seconds.push_back(static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
  }
  std::nth_element(seconds.begin(), seconds.begin() + repeats / 2, seconds.end());
  return seconds[static_cast<std::size_t>(repeats / 2)];
}

std::vector<int> Slots(const SlotLayout& layout) {
  std::vector<int> slots;
  for (int joint = 0; joint < layout.num_joints(); ++joint) {
    for (const JointSlot kind :
         {JointSlot::kTheta, JointSlot::kD, JointSlot::kA, JointSlot::kAlpha}) {
      slots.push_back(layout.joint(joint, kind));
    }
  }
  slots.push_back(-1);  // of -r
  return slots;
}

/// The linearisation of all readings at one SIMD level, and its stages.
class TiledRun {
 public:
  TiledRun(const RobotModel& robot, const Readings& readings, const simd::Kernels& kernels)
      : kernels_(kernels),
        positions_(robot, {}, false, kernels),
        columns_(robot, Slots(SlotLayout(robot.num_joints())), false, kernels),
        num_tiles_(static_cast<int>(readings.q.cols()) / kPoses),
        coordinates_(Size(num_tiles_ * columns_.num_coordinates())),
        measured_(Size(num_tiles_ * PoseTile::kRows)),
        weight_(Size(PoseTile::kRows), 1 / kSigma),
        scope_(columns_.Prepare({}, VectorXd::Zero(SlotLayout(robot.num_joints()).size()))) {
    for (int tile = 0; tile < num_tiles_; ++tile) {
      columns_.FillCoordinates(readings.q.middleCols(tile * kPoses, kPoses),
                               coordinates_.data() + tile * columns_.num_coordinates());
      MatrixXd::Map(measured_.data() + tile * PoseTile::kRows, kPoses, 3) =
          readings.p_WQ.middleCols(tile * kPoses, kPoses).transpose();
    }
  }

  void Positions() const {
    PoseTile tile = positions_.MakeTile();
    for (int k = 0; k < num_tiles_; ++k) positions_.Evaluate(Input(k), &tile);
  }
  void Columns() const {
    PoseTile tile = columns_.MakeTile();
    for (int k = 0; k < num_tiles_; ++k) columns_.Evaluate(Input(k), &tile);
  }
  /// The rows of one tile over and over.
  void Reduction() const {
    PoseTile tile = columns_.MakeTile();
    Fill(0, &tile);
    RowReduction reduction(kBareColumns, kernels_);
    for (int k = 0; k < num_tiles_; ++k) AddTo(tile, &reduction);
    reduction.R();
  }
  MatrixXd Linearize() const {
    const auto add = [&](int first, int last, RowReduction* part) {
      PoseTile tile = columns_.MakeTile();
      for (int k = first; k < last; ++k) {
        Fill(k, &tile);
        AddTo(tile, part);
      }
    };
    return ReduceTiles(kBareColumns, num_tiles_, 1, add, kernels_).R();
  }

 private:
  static std::size_t Size(int count) { return static_cast<std::size_t>(count); }

  PoseTileInput Input(int tile) const {
    return {&scope_, coordinates_.data() + tile * columns_.num_coordinates(), {}};
  }
  void Fill(int k, PoseTile* tile) const {
    columns_.Evaluate(Input(k), tile);
    tile->J().col(kBareColumns - 1) =
        VectorXd::Map(measured_.data() + k * PoseTile::kRows, PoseTile::kRows) -
        tile->p_WQ().reshaped();
  }
  void AddTo(const PoseTile& tile, RowReduction* reduction) const {
    reduction->Add({tile.J().data(), PoseTile::kRows, PoseTile::kRows, weight_.data()});
  }

  const simd::Kernels& kernels_;
  PoseTileKernel positions_, columns_;
  int num_tiles_;
  simd::AlignedDoubles coordinates_, measured_, weight_;
  PoseTileScope scope_;
};

/// Joint angles and positions as the bare kernel reads them.
simd::AlignedDoubles BareReadings(const Readings& readings) {
  simd::AlignedDoubles bare;
  for (Eigen::Index first = 0; first < readings.q.cols(); first += simd::kLanes) {
    for (const MatrixXd* part : {&readings.q, &readings.p_WQ}) {
      for (Eigen::Index row = 0; row < part->rows(); ++row) {
        for (int lane = 0; lane < simd::kLanes; ++lane) {
          bare.push_back((*part)(row, first + lane));
        }
      }
    }
  }
  return bare;
}

double BareSeconds(const RobotModel& robot, const Readings& readings, int repeats) {
  BareRobot bare{};
  for (std::size_t i = 0; i < kBareJoints; ++i) {
    bare.d[i] = robot.joints[i].d;
    bare.a[i] = robot.joints[i].a;
    bare.alpha[i] = robot.joints[i].alpha;
  }
  const simd::AlignedDoubles packed = BareReadings(readings);
  constexpr int kBlocks = (kBareColumns + simd::kGramBlock - 1) / simd::kGramBlock;
  simd::AlignedDoubles sums(kBlocks * (kBlocks + 1) / 2 * simd::kGramBlock * simd::kGramBlock *
                            simd::kLanes);
  const int num_packs = static_cast<int>(readings.q.cols()) / simd::kLanes;
  return SecondsOf(repeats, [&] { BareNormalMatrix(bare, packed.data(), num_packs, sums.data()); });
}

/// A pose at a time, and Householder, for the first poses.
double ScalarSecondsPerPose(const RobotModel& robot, const Readings& readings) {
  const Eigen::Index count = std::min<Eigen::Index>(2048, readings.q.cols());
  const DhChain chain(robot);
  const std::vector<int> slots = Slots(chain.slots());
  const VectorXd delta = VectorXd::Zero(chain.slots().size());
  const double seconds = SecondsOf(5, [&] {
    Tsqr tsqr(kBareColumns);
    PoseWithDerivatives pose;
    MatrixXd rows(3, kBareColumns);
    for (Eigen::Index k = 0; k < count; ++k) {
      chain.PoseAndDerivatives(readings.q.col(k), delta, {}, &pose);
      for (int col = 0; col + 1 < kBareColumns; ++col) {
        rows.col(col) = pose.J_p.col(slots[static_cast<std::size_t>(col)]) / kSigma;
      }
      rows.col(kBareColumns - 1) = (readings.p_WQ.col(k) - pose.p_WQ) / kSigma;
      tsqr.Add(rows);
    }
    tsqr.R();
  });
  return seconds / static_cast<double>(count);
}

void Run(int num_poses, int repeats) {
  constexpr double kNano = 1e9;
  const RobotModel robot = MakeRobot();
  const Readings readings = MakeReadings(robot, num_poses);
  const double per_pose = kNano / num_poses;
  fmt::print("{} poses, median of {} runs, ns of processor time per pose\n", num_poses, repeats);
  fmt::print("{:10}{:>11}{:>10}{:>11}{:>15}{:>13}\n",
             "level",
             "positions",
             "columns",
             "reduction",
             "linearisation",
             "over bare");
  for (const simd::Kernels* kernels : simd::SupportedKernels()) {
    const TiledRun run(robot, readings, *kernels);
    const double bare = BareSeconds(robot, readings, repeats);
    const double all = SecondsOf(repeats, [&] { run.Linearize(); });
    fmt::print("{:10}{:11.1f}{:10.1f}{:11.1f}{:15.1f}{:13.2f}\n",
               kernels->name,
               SecondsOf(repeats, [&] { run.Positions(); }) * per_pose,
               SecondsOf(repeats, [&] { run.Columns(); }) * per_pose,
               SecondsOf(repeats, [&] { run.Reduction(); }) * per_pose,
               all * per_pose,
               all / bare);
  }
  fmt::print("bare kernel {:.1f}, scalar {:.0f}\n",
             BareSeconds(robot, readings, repeats) * per_pose,
             ScalarSecondsPerPose(robot, readings) * kNano);
}

}  // namespace
}  // namespace dhcal

int main(int argc, char** argv) {
  const int poses = argc > 1 ? std::atoi(argv[1]) : 100000;
  const int repeats = argc > 2 ? std::atoi(argv[2]) : 7;
  if (argc > 3 || poses < dhcal::PoseTile::kPoses || repeats < 1) {
    fmt::print("usage: dhcal_bench [POSES [REPEATS]]   at least {} poses, 1 repeat\n",
               dhcal::PoseTile::kPoses);
    return 2;
  }
  // Whole tiles.
  dhcal::Run(poses / dhcal::PoseTile::kPoses * dhcal::PoseTile::kPoses, repeats);
  return 0;
}
