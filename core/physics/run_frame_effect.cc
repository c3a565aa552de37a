#include "core/physics/run_frame_effect.h"

#include <cmath>
#include <map>
#include <utility>

#include <fmt/format.h>

#include "core/kinematics/slots.h"
#include "core/physics/columns.h"

namespace dhcal {
namespace {

constexpr int kMostRuns = 12;      // more are not set-ups that somebody made
constexpr double kTypical = 1e-3;  // [m], [rad]

}  // namespace

RunFrameEffect::RunFrameEffect(std::string name, std::string frame)
    : name_(std::move(name)), frame_(std::move(frame)) {}

EffectDescription RunFrameEffect::Describe() const {
  EffectDescription d{
      name_,
      fmt::format("the {} differs between the runs (geometry, not physics)", frame_),
      fmt::format("{} of a run += (x, y, z, rx, ry, rz) of that run", frame_),
      "x_<run>, y_<run>, z_<run> [m], rx_<run>, ry_<run>, rz_<run> [rad]",
      {},
      "the column run",
      "0.1-10 mm [PHYSICS.md X1]"};
  d.has_joint = false;
  return d;
}

std::string RunFrameEffect::NotTestable(const PhysicsContext& c,
                                        const EffectRequest& /*request*/) const {
  const std::size_t runs = c.recording().run_names.size();
  if (is_base() && c.robot().base_per_edge) return kFrameOfEdges;
  if (is_base() ? c.robot().base_per_run : c.robot().tool_per_run) {
    return fmt::format("the {} has a frame for each run already", frame_);
  }
  if (!is_base() && !c.robot().targets.empty()) return "the tool is one of several targets";
  if (runs < 2) return "there is one run only";
  return runs > kMostRuns ? "there are too many runs" : "";
}

std::vector<EffectColumn> RunFrameEffect::Columns(const PhysicsContext& c,
                                                  const EffectRequest& /*request*/) const {
  const Recording& recording = c.recording();
  const bool turns = is_base() || TurnsShow(recording);
  std::vector<EffectColumn> columns;
  for (std::size_t run = 1; run < recording.run_names.size(); ++run) {
    Eigen::VectorXd in_run = Eigen::VectorXd::Zero(c.num_rows());
    for (int row = 0; row < c.num_rows(); ++row) {
      if (recording.run(row) == static_cast<int>(run)) in_run[row] = 1;
    }
    const std::vector<EffectColumn> own =
        FrameColumns(is_base() ? c.slots().base(0) : c.slots().tool(0),
                     turns ? SlotLayout::kPerFrame : 3,
                     kTypical,
                     in_run,
                     "_" + recording.run_names[run]);
    columns.insert(columns.end(), own.begin(), own.end());
  }
  return columns;
}

std::vector<EffectRequest> RunFrameEffect::Candidates(const PhysicsContext& c) const {
  if (c.recording().run_names.size() < 2) return {};
  EffectRequest request;
  request.effect = name_;
  return {request};
}

EffectPlace RunFrameEffect::Place(const PhysicsContext& /*c*/,
                                  const EffectRequest& /*request*/) const {
  return {"geometry", frame_, "run"};
}

std::string RunFrameEffect::Sentence(const PhysicsContext& /*context*/,
                                     const EffectRequest& /*request*/,
                                     const std::vector<EffectValue>& values) const {
  struct Square {
    double value = 0, variance = 0;  // of the length, and of it times the length
  };
  std::map<std::string, Square> squares;  // of each run's displacement
  for (const EffectValue& value : values) {
    if (value.unit != "m") continue;
    Square& square = squares[value.parameter.substr(value.parameter.find('_') + 1)];
    square.value += value.value * value.value;
    square.variance += std::pow(value.value * value.sigma, 2);
  }
  EffectValue largest;
  for (const auto& [run, square] : squares) {
    const double length = std::sqrt(square.value);
    if (length <= largest.value) continue;
    largest.value = length;
    largest.sigma = std::sqrt(square.variance) / length;
  }
  return fmt::format("the {0} differs between the runs by up to {1}: set {0}: {{per_run: true}}",
                     frame_,
                     Quantity(largest, 1e-3, "mm"));
}

WorkedExample RunFrameEffect::Example() const {
  WorkedExample example;
  example.request.effect = name_;
  example.request.values["z_2"] = 2e-3;
  example.row = 2;
  example.slot = frame_ + "_z";
  example.expected = 2e-3;
  return example;
}

}  // namespace dhcal
