#include "problems/diagnosis/hypotheses/cells.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "problems/diagnosis/hypotheses/hats.h"

namespace dhcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kAngleKnots = 8;
constexpr int kTimeKnots = 8;
constexpr int kFrameKnots = 5;
constexpr int kMostRunsOfACell = 12;
constexpr char kRun[] = "run";

/// A driver and the functions of it that are tried.
struct CellDriver {
  std::string name;
  MatrixXd functions;       // rows x functions
  VectorXd values;          // empty: several drivers
  std::vector<int> joints;  // whose angles drive it, from 1
};

bool Moves(const VectorXd& values) {
  constexpr double kLeast = 1e-9;  // of the largest value
  return values.size() > 0 && values.allFinite() &&
         values.maxCoeff() - values.minCoeff() >
             kLeast * std::max(1.0, values.cwiseAbs().maxCoeff());
}

/// Hats on even knots without the first: a constant is the geometry's.
CellDriver Smooth(const std::string& name, const VectorXd& values, int knots) {
  std::vector<double> at;
  for (int k = 0; k < knots; ++k) {
    at.push_back(values.minCoeff() + (values.maxCoeff() - values.minCoeff()) * k / (knots - 1.0));
  }
  return {name, Hats(values, at).rightCols(knots - 1), values, {}};
}

CellDriver AngleOf(const PhysicsContext& c, int joint, int knots) {
  CellDriver driver = Smooth(fmt::format("q{}", joint + 1), c.q(joint), knots);
  driver.joints = {joint + 1};
  return driver;
}

CellDriver PowersOf(const std::string& name, const VectorXd& values, int powers) {
  const VectorXd centred = values.array() - values.mean();
  const double spread = std::max(std::sqrt(centred.array().square().mean()), 1e-300);
  CellDriver driver{name, MatrixXd(values.size(), powers), values, {}};
  for (int k = 0; k < powers; ++k) {
    driver.functions.col(k) = (centred / spread).array().pow(k + 1).matrix();
  }
  return driver;
}

Item CellOf(const std::string& slot, const std::vector<int>& slots, const CellDriver& driver) {
  auto columns = std::make_shared<SlotColumns>();
  for (const int k : slots) {
    for (Eigen::Index f = 0; f < driver.functions.cols(); ++f) {
      columns->push_back({{k, driver.functions.col(f)}});
    }
  }
  Item item;
  item.kind = ItemKind::kCell;
  item.slot = slot;
  item.driver = driver.name;
  item.id = slot + " x " + driver.name;
  item.size = static_cast<int>(columns->size());
  item.positive.assign(columns->size(), false);
  item.typical = VectorXd::Ones(item.size);
  item.precision = VectorXd::Zero(item.size);
  item.cell = std::move(columns);
  item.driver_values = driver.values;
  item.driven_by = driver.joints;
  return item;
}

/// What any place may depend on besides joint angles.
std::vector<CellDriver> CircumstanceDrivers(const PhysicsContext& c) {
  std::vector<CellDriver> drivers;
  const Recording& rec = c.recording();
  if (Moves(c.clock())) {
    drivers.push_back(
        Smooth(c.has_one_clock() ? kTimeDriver : kOrderDriver, c.clock(), kTimeKnots));
  }
  VectorXd payload(c.num_rows());
  for (int row = 0; row < c.num_rows(); ++row) payload[row] = c.payload(row);
  if (Moves(payload)) drivers.push_back(PowersOf("payload", payload, 2));
  for (Eigen::Index k = 0; k < rec.temperature.cols(); ++k) {
    const std::string name =
        rec.temperature.cols() == 1 ? "temperature" : fmt::format("temperature {}", k + 1);
    if (Moves(rec.temperature.col(k))) {
      drivers.push_back(PowersOf(name, rec.temperature.col(k), 2));
    }
  }
  for (const ExtraColumn& column : rec.extra) {
    if (Moves(column.values)) {
      drivers.push_back(PowersOf("column " + column.name, column.values, 2));
    }
  }
  const auto runs = static_cast<int>(rec.run_names.size());
  if (runs > 1 && runs <= kMostRunsOfACell) {
    CellDriver driver{kRun, MatrixXd::Zero(c.num_rows(), runs - 1), {}, {}};
    for (int row = 0; row < c.num_rows(); ++row) {
      if (rec.run(row) > 0) driver.functions(row, rec.run(row) - 1) = 1;
    }
    drivers.push_back(driver);
  }
  return drivers;
}

/// Of one joint's own slot.
std::vector<CellDriver> OwnCellDrivers(const PhysicsContext& c, int joint) {
  std::vector<CellDriver> drivers;
  const Recording& rec = c.recording();
  const VectorXd direction = c.direction().col(joint);
  if (Moves(direction) && c.moves(joint)) {
    CellDriver driver{"approach direction", MatrixXd(c.num_rows(), 5), {}, {}};
    const Eigen::ArrayXd q = c.q(joint).array();
    driver.functions.col(0) = direction;
    driver.functions.col(1) = direction.array() * q.sin();
    driver.functions.col(2) = direction.array() * q.cos();
    driver.functions.col(3) = direction.array() * (2 * q).sin();
    driver.functions.col(4) = direction.array() * (2 * q).cos();
    drivers.push_back(driver);
  }
  if (rec.speed.rows() > 0 && Moves(rec.speed.col(joint))) {
    drivers.push_back(PowersOf("joint speed", rec.speed.col(joint), 2));
  }
  if (rec.torque.rows() > 0 && Moves(rec.torque.col(joint))) {
    drivers.push_back(PowersOf("measured torque", rec.torque.col(joint), 3));
  }
  return drivers;
}

/// The product of two angles with its two linear terms, which choose where its zero is.
CellDriver ProductOf(const PhysicsContext& c, int one, int other) {
  const VectorXd a = c.q(one).array() - c.q(one).mean();
  const VectorXd b = c.q(other).array() - c.q(other).mean();
  CellDriver driver{
      fmt::format("q{} times q{}", one + 1, other + 1), MatrixXd(c.num_rows(), 3), {}, {}};
  driver.functions << a.cwiseProduct(b), a, b;
  driver.joints = {one + 1, other + 1};
  return driver;
}

}  // namespace

std::vector<Item> CellItems(const PhysicsContext& c) {
  const SlotLayout& slots = c.slots();
  const std::vector<std::pair<std::string, std::vector<int>>> frames = {
      {"base", {slots.base(0), slots.base(1), slots.base(2)}},
      {"base tilt", {slots.base(3), slots.base(4), slots.base(5)}},
      {"tool", {slots.tool(0), slots.tool(1), slots.tool(2)}}};
  const std::vector<CellDriver> circumstances = CircumstanceDrivers(c);
  std::vector<int> moving;
  for (int joint = 0; joint < c.num_joints(); ++joint) {
    if (c.moves(joint)) moving.push_back(joint);
  }
  std::vector<Item> items;
  for (int joint = 0; joint < c.num_joints(); ++joint) {
    const int slot = c.joint_slot(joint);
    const std::string name = slots.Name(slot);
    const auto add = [&](const CellDriver& driver, int variants) {
      items.push_back(CellOf(name, {slot}, driver));
      items.back().variants = variants;
    };
    for (const int other : moving) {
      if (other != joint) {
        add(AngleOf(c, other, kAngleKnots), 1);
      } else if (!c.revolute(joint)) {
        add(AngleOf(c, joint, kAngleKnots), 1);
      }
    }
    for (const CellDriver& driver : OwnCellDrivers(c, joint)) add(driver, 1);
    for (const CellDriver& driver : circumstances) add(driver, 1);
    const int products = static_cast<int>(moving.size() * (moving.size() - 1) / 2);
    for (std::size_t i = 0; i < moving.size(); ++i) {
      for (std::size_t k = i + 1; k < moving.size(); ++k) {
        add(ProductOf(c, moving[i], moving[k]), products);
      }
    }
  }
  for (const auto& [name, frame] : frames) {
    for (const int joint : moving) {
      items.push_back(CellOf(name, frame, AngleOf(c, joint, kFrameKnots)));
    }
    for (const CellDriver& driver : circumstances) {
      // Frames that differ between runs have names of their own.
      if (driver.name != kRun) items.push_back(CellOf(name, frame, driver));
    }
  }
  return items;
}

}  // namespace dhcal
