// The anonymous blocks: where x what drives it.
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/physics/columns.h"
#include "core/physics/gravity.h"
#include "problems/diagnosis/hypotheses.h"

namespace dhcal {
namespace {

using Eigen::VectorXd;

constexpr int kOwnJointKnots = 24;  // a joint's own angle: fine enough for a damaged tooth
constexpr int kKnots = 6;
constexpr int kMostRuns = 12;
constexpr int kFewRows = 60;  // with fewer rows, curves of fewer knots

/// A driver and the functions of it that are tried.
struct DrivingFunctions {
  std::string name;
  Driver driver;
  VectorXd values;  // empty: several
  std::vector<double> knots;
  Eigen::MatrixXd functions;  // rows x functions
};

/// Knots at quantiles, so that every hat has rows under it.
std::vector<double> Knots(const VectorXd& values, int count) {
  std::vector<double> sorted(values.begin(), values.end());
  std::sort(sorted.begin(), sorted.end());
  std::vector<double> knots;
  for (int k = 0; k < count; ++k) {
    const auto at = static_cast<std::size_t>(
        std::lround(k * static_cast<double>(sorted.size() - 1) / (count - 1)));
    if (knots.empty() || sorted[at] > knots.back() + 1e-12) knots.push_back(sorted[at]);
  }
  return knots;
}

DrivingFunctions Curve(std::string name, Driver of, const VectorXd& values, int knots) {
  DrivingFunctions driver{std::move(name), of, values, Knots(values, knots), {}};
  driver.functions = Hats(values, driver.knots);
  return driver;
}

/// Linear and square of a standardised value: for drivers that take few values.
DrivingFunctions Powers(std::string name, Driver of, const VectorXd& values, int powers) {
  const double mean = values.mean();
  const VectorXd centred = values.array() - mean;
  const double spread = std::max(std::sqrt(centred.array().square().mean()), 1e-300);
  DrivingFunctions driver{std::move(name), of, values, Knots(values, kKnots), {}};
  driver.functions.resize(values.size(), powers);
  for (int k = 0; k < powers; ++k) {
    driver.functions.col(k) = (centred / spread).array().pow(k + 1).matrix();
  }
  return driver;
}

MapBlock OnSlots(const std::string& name,
                 const std::vector<int>& slots,
                 const DrivingFunctions& driver) {
  MapBlock block;
  block.slot = name;
  block.driver_name = driver.name;
  block.driver = driver.driver;
  block.driver_values = driver.values;
  block.knots = driver.knots;
  for (const int slot : slots) {
    for (Eigen::Index k = 0; k < driver.functions.cols(); ++k) {
      block.columns.push_back({{slot, driver.functions.col(k)}});
    }
  }
  return block;
}

/// Drivers that every slot is tried with.
std::vector<DrivingFunctions> CommonDrivers(const PhysicsContext& c) {
  const Recording& rec = c.recording();
  std::vector<DrivingFunctions> drivers;
  const auto add = [&](const std::string& name, DriverKind kind, const VectorXd& values) {
    if (!IsConstant(values)) drivers.push_back(Powers(name, {kind}, values, 2));
  };
  if (!IsConstant(c.clock())) {
    drivers.push_back(Curve(
        c.has_one_clock() ? "time" : "order of the rows", {DriverKind::kTime}, c.clock(), kKnots));
  }
  VectorXd payload(c.num_rows());
  for (int row = 0; row < c.num_rows(); ++row) payload[row] = c.payload(row);
  add("payload", DriverKind::kPayload, payload);
  for (Eigen::Index k = 0; k < rec.temperature.cols(); ++k) {
    add(rec.temperature.cols() == 1 ? "temperature" : fmt::format("temperature {}", k + 1),
        DriverKind::kTemperature,
        rec.temperature.col(k));
  }
  for (const ExtraColumn& column : rec.extra)
    add("column " + column.name, DriverKind::kColumn, column.values);
  return drivers;
}

/// Drivers of one joint's slot only.
std::vector<DrivingFunctions> OwnDrivers(const PhysicsContext& c, int joint, int own_knots) {
  std::vector<DrivingFunctions> drivers;
  const Recording& rec = c.recording();
  const auto of = [&](DriverKind kind) { return Driver{kind, joint + 1}; };
  drivers.push_back(
      Curve(fmt::format("q{}", joint + 1), of(DriverKind::kJointAngle), c.q(joint), own_knots));
  const VectorXd direction = c.direction().col(joint);
  if (!IsConstant(direction))
    drivers.push_back(
        Powers("approach direction", of(DriverKind::kApproachDirection), direction, 1));
  if (rec.speed.rows() > 0 && !IsConstant(rec.speed.col(joint))) {
    drivers.push_back(Powers("joint speed", of(DriverKind::kJointSpeed), rec.speed.col(joint), 2));
  }
  if (rec.torque.rows() > 0 && !IsConstant(rec.torque.col(joint))) {
    drivers.push_back(
        Powers("measured torque", of(DriverKind::kMeasuredTorque), rec.torque.col(joint), 3));
  }
  if (!c.robot().links.empty() && GravityLoads(c, joint)) {
    drivers.push_back(Powers("gravity torque",
                             of(DriverKind::kGravityTorque),
                             GravityTorque(c, MassCases(c, joint).front(), joint),
                             3));
  }
  return drivers;
}

/// All products of two moving joints' angles: interactions that no function of one angle describes.
DrivingFunctions Products(const PhysicsContext& c) {
  DrivingFunctions driver;
  driver.name = "products of joint angles";
  driver.driver = {DriverKind::kProductOfAngles};
  std::vector<int> moving;
  for (int joint = 0; joint < c.num_joints(); ++joint) {
    if (c.moves(joint)) moving.push_back(joint);
  }
  const auto n = static_cast<Eigen::Index>(moving.size());
  driver.functions.resize(c.num_rows(), n * (n - 1) / 2);
  Eigen::Index col = 0;
  for (std::size_t first = 0; first < moving.size(); ++first) {
    for (std::size_t second = first + 1; second < moving.size(); ++second) {
      const int i = moving[first], k = moving[second];
      const VectorXd a = c.q(i).array() - c.q(i).mean(), b = c.q(k).array() - c.q(k).mean();
      driver.functions.col(col++) = a.cwiseProduct(b);
    }
  }
  return driver;
}

/// A smooth warp of the instrument's space: all squares and cubes of the position.
MapBlock Warp(const PhysicsContext& c) {
  constexpr double kFlat = 1e-6;  // of the largest extent
  Eigen::Matrix3Xd p(3, c.num_rows());
  for (int row = 0; row < c.num_rows(); ++row) p.col(row) = c.p_WQ(row);
  p.colwise() -= p.rowwise().mean().eval();
  const Eigen::Vector3d extent = p.cwiseAbs().rowwise().maxCoeff();
  for (int i = 0; i < 3; ++i) {
    if (extent[i] < kFlat * extent.maxCoeff()) p.row(i).setZero();
  }
  DrivingFunctions driver;
  driver.name = "position";
  driver.driver = {DriverKind::kPosition};
  driver.functions.resize(c.num_rows(), 16);
  Eigen::Index col = 0;
  for (int i = 0; i < 3; ++i) {
    for (int j = i; j < 3; ++j) {
      const VectorXd square = p.row(i).cwiseProduct(p.row(j)).transpose();
      driver.functions.col(col++) = square;
      for (int k = j; k < 3; ++k) {
        driver.functions.col(col++) = square.cwiseProduct(p.row(k).transpose());
      }
    }
  }
  return OnSlots("base", {c.slots().base(0), c.slots().base(1), c.slots().base(2)}, driver);
}

/// Runs against each other: each shifts the base.
std::vector<MapBlock> Runs(const PhysicsContext& c,
                           const std::vector<std::pair<std::string, std::vector<int>>>& frames) {
  const auto num_runs = static_cast<int>(c.recording().run_names.size());
  if (num_runs < 2 || num_runs > kMostRuns) return {};
  DrivingFunctions driver;
  driver.name = "run";
  driver.driver = {DriverKind::kRun};
  driver.functions.setZero(c.num_rows(), num_runs - 1);
  for (int row = 0; row < c.num_rows(); ++row) {
    const int run = c.recording().run(row);
    if (run > 0) driver.functions(row, run - 1) = 1;
  }
  std::vector<MapBlock> blocks;
  for (const auto& [name, slots] : frames) blocks.push_back(OnSlots(name, slots, driver));
  return blocks;
}

}  // namespace

Eigen::MatrixXd Hats(const VectorXd& values, const std::vector<double>& knots) {
  Eigen::MatrixXd hats =
      Eigen::MatrixXd::Zero(values.size(), static_cast<Eigen::Index>(knots.size()));
  for (Eigen::Index row = 0; row < values.size(); ++row) {
    const auto above = std::upper_bound(knots.begin(), knots.end(), values[row]);
    const auto right = std::clamp<Eigen::Index>(
        above - knots.begin(), 1, std::max<Eigen::Index>(1, hats.cols() - 1));
    if (hats.cols() == 1) {
      hats(row, 0) = 1;
      continue;
    }
    const double low = knots[static_cast<std::size_t>(right - 1)];
    const double high = knots[static_cast<std::size_t>(right)];
    const double part = std::clamp((values[row] - low) / (high - low), 0.0, 1.0);
    hats(row, right - 1) = 1 - part;
    hats(row, right) = part;
  }
  return hats;
}

std::vector<MapBlock> MapBlocks(const PhysicsContext& c) {
  const SlotLayout& slots = c.slots();
  const std::vector<std::pair<std::string, std::vector<int>>> frames = {
      {"base", {slots.base(0), slots.base(1), slots.base(2)}},
      {"tool", {slots.tool(0), slots.tool(1), slots.tool(2)}}};
  const int own_knots = c.num_rows() < kFewRows ? 8 : kOwnJointKnots;
  const std::vector<DrivingFunctions> common = CommonDrivers(c);
  const DrivingFunctions products = Products(c);
  std::vector<DrivingFunctions> angles;
  for (int joint = 0; joint < c.num_joints(); ++joint) {
    if (!c.moves(joint)) continue;
    angles.push_back(Curve(
        fmt::format("q{}", joint + 1), {DriverKind::kJointAngle, joint + 1}, c.q(joint), kKnots));
  }
  std::vector<MapBlock> blocks;
  for (int joint = 0; joint < c.num_joints(); ++joint) {
    const int slot = c.joint_slot(joint);
    const std::string name = slots.Name(slot);
    const std::size_t first = blocks.size();
    if (c.moves(joint)) {
      for (const DrivingFunctions& driver : OwnDrivers(c, joint, own_knots)) {
        blocks.push_back(OnSlots(name, {slot}, driver));
      }
    }
    for (const DrivingFunctions& driver : angles) {
      if (driver.driver.joint != joint + 1) blocks.push_back(OnSlots(name, {slot}, driver));
    }
    for (const DrivingFunctions& driver : common) blocks.push_back(OnSlots(name, {slot}, driver));
    if (products.functions.cols() > 0) blocks.push_back(OnSlots(name, {slot}, products));
    if (!c.revolute(joint)) continue;
    for (std::size_t k = first; k < blocks.size(); ++k) blocks[k].slot_joint = joint + 1;
  }
  for (const auto& [name, frame_slots] : frames) {
    for (const DrivingFunctions& driver : angles)
      blocks.push_back(OnSlots(name, frame_slots, driver));
    for (const DrivingFunctions& driver : common)
      blocks.push_back(OnSlots(name, frame_slots, driver));
  }
  blocks.push_back(Warp(c));
  for (MapBlock& block : Runs(c, frames)) blocks.push_back(std::move(block));
  return blocks;
}

}  // namespace dhcal
