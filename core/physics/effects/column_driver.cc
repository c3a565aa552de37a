// A numeric column of the recording that the program does not know, acting on one slot.
//
//   d slot = c (x - x of the first row)              c [rad or m per unit of the column]
//
// A motor's temperature, a cabinet's humidity, a supply pressure: whoever recorded it suspected it.
// Of what such a column is a measure nobody says, so its law is the plainest, a straight line, and
// its usual size what the column's whole course does. A diagnosis tries those columns only that are
// a quantity with a course of its own: one that repeats the clock, the joints or another known
// column is told by the names that go by these, and one that repeats a reading would hold the
// residual, and explain it.
// Typical: 0.1 mrad or 0.1 mm over the course of the column. Source: PHYSICS.md U1.
// Worked number: c = 0.01 mrad per unit at theta3, 10 units up: +0.1 mrad.
#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include <Eigen/QR>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/base/text.h"
#include "core/kinematics/dh_chain.h"
#include "core/kinematics/slots.h"
#include "core/physics/columns.h"

namespace dhcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kUsual = 1e-4;           // [rad or m] over the course of the column
constexpr double kLeastSpread = 1e-9;     // of its largest value; below, it is constant
constexpr std::size_t kFewestValues = 5;  // fewer distinct ones are labels, not a quantity
constexpr double kMostOfOneRow = 0.25;    // of the column's squares; a peak looks like an outlier
constexpr double kCourseOfItsOwn = 0.01;  // of its deviation, beside what is known

const ExtraColumn* ColumnNamed(const PhysicsContext& c, const std::string& name) {
  const auto& extra = c.recording().extra;
  const auto found = std::find_if(
      extra.begin(), extra.end(), [&](const ExtraColumn& column) { return column.name == name; });
  return found == extra.end() ? nullptr : &*found;
}

/// Slot of a name such as "theta3" or "tool_x".
std::optional<int> SlotNamed(const SlotLayout& slots, const std::string& name) {
  for (int slot = 0; slot < slots.size(); ++slot) {
    if (slots.Name(slot) == name) return slot;
  }
  return std::nullopt;
}

double Deviation(const VectorXd& values) {
  return std::sqrt((values.array() - values.mean()).square().mean());
}

VectorXd Standardised(const VectorXd& values) {
  return (values.array() - values.mean()) / Deviation(values);
}

bool StandsStill(const VectorXd& values) {
  return values.size() == 0 ||
         !(values.maxCoeff() - values.minCoeff() > kLeastSpread * values.cwiseAbs().maxCoeff());
}

bool IsQuantity(const VectorXd& values) {
  if (std::set<double>(values.begin(), values.end()).size() < kFewestValues) return false;
  const VectorXd squares = (values.array() - values.mean()).square();
  return squares.maxCoeff() < kMostOfOneRow * squares.sum();
}

/// Centred, of unit deviation; what is absent, blank or constant says nothing.
void Append(const MatrixXd& columns, MatrixXd* known) {
  for (Eigen::Index k = 0; k < columns.cols(); ++k) {
    const VectorXd column = columns.col(k);
    if (!column.allFinite() || StandsStill(column)) continue;
    known->conservativeResize(Eigen::NoChange, known->cols() + 1);
    known->rightCols(1) = Standardised(column);
  }
}

/// The circumstances that other names go by.
MatrixXd KnownDrivers(const PhysicsContext& c) {
  const Recording& recording = c.recording();
  MatrixXd known(c.num_rows(), 0);
  VectorXd payload(c.num_rows());
  for (int row = 0; row < c.num_rows(); ++row) payload[row] = c.payload(row);
  Append(VectorXd::LinSpaced(c.num_rows(), 0, 1), &known);
  Append(c.clock(), &known);
  Append(c.drift_clock(), &known);
  Append(recording.q, &known);
  Append(recording.temperature, &known);
  Append(payload, &known);
  Append(recording.speed, &known);
  Append(recording.torque, &known);
  return known;
}

MatrixXd Readings(const Recording& recording) {
  MatrixXd known(recording.num_rows(), 0);
  Append(recording.p_WQ, &known);
  Append(recording.displacement, &known);
  Append(recording.distance, &known);
  return known;
}

/// True if a straight-line combination of known columns is all that a column says.
bool Repeats(const VectorXd& values, const MatrixXd& known) {
  // As many columns as rows say anything.
  if (known.cols() == 0 || 2 * known.cols() >= known.rows()) return false;
  const VectorXd course = Standardised(values);
  const VectorXd rest = course - known * known.colPivHouseholderQr().solve(course);
  return Deviation(rest) < kCourseOfItsOwn;
}

/// Columns that a diagnosis tries.
std::vector<std::string> DriversOfTheirOwn(const PhysicsContext& c) {
  std::vector<std::string> names;
  if (c.recording().extra.empty()) return names;
  const MatrixXd known = KnownDrivers(c), readings = Readings(c.recording());
  for (const ExtraColumn& column : c.recording().extra) {
    const VectorXd& x = column.values;
    if (!x.allFinite() || StandsStill(x) || !IsQuantity(x)) continue;
    if (!Repeats(x, known) && !Repeats(x, readings)) names.push_back(column.name);
  }
  return names;
}

/// How each slot moves the point [m per rad or m], of some rows one below the other; turns count
/// where they are read.
MatrixXd MotionsOfSlots(const PhysicsContext& c) {
  constexpr int kMostRows = 60;
  constexpr double kLever = 0.5;  // [m] that makes a turn a length
  const DhChain chain(c.robot());
  const VectorXd zero = VectorXd::Zero(c.slots().size());
  const bool turns = TurnsShow(c.recording());
  const int rows = std::min(c.num_rows(), kMostRows), height = turns ? 6 : 3;
  MatrixXd motions(height * rows, c.slots().size());
  PoseWithDerivatives pose;
  for (int k = 0; k < rows; ++k) {
    const int row = k * c.num_rows() / rows;
    const Eigen::Isometry3d X_WT = c.X_WB(row) * c.X_BL(row, c.num_joints() - 1);
    EndFrames ends{c.X_WB(row), Eigen::Isometry3d::Identity()};
    ends.X_TQ.translation() = X_WT.inverse() * c.p_WQ(row);
    chain.PoseAndDerivatives(c.recording().q.row(row).transpose(), zero, ends, &pose);
    motions.middleRows<3>(height * k) = pose.J_p;
    if (turns) motions.middleRows<3>(height * k + 3) = kLever * pose.J_w;
  }
  return motions;
}

bool MoveAlike(const VectorXd& a, const VectorXd& b) {
  constexpr double kAlike = 1e-4;  // of the squares
  const double along = a.dot(b);
  return along * along > (1 - kAlike) * a.squaredNorm() * b.squaredNorm();
}

/// Slots that a diagnosis tries. Many move the point alike (the height of row 1 and that of the
/// base, the last row's length and the tool's): of those the joint's own, else the frame's.
std::vector<int> SlotsTried(const PhysicsContext& c) {
  constexpr double kMoves = 1e-3;  // [m] per rad or m
  std::vector<int> order;
  for (int joint = 0; joint < c.num_joints(); ++joint) order.push_back(c.joint_slot(joint));
  for (int slot = c.slots().base(0); slot < c.slots().size(); ++slot) order.push_back(slot);
  for (int slot = 0; slot < c.slots().base(0); ++slot) {
    if (SlotLayout::NumberAt(slot) != JointSlot::kBeta) order.push_back(slot);
  }
  const MatrixXd motions = MotionsOfSlots(c);
  std::vector<int> tried;
  for (const int slot : order) {
    const VectorXd own = motions.col(slot);
    if (own.norm() < kMoves * std::sqrt(static_cast<double>(own.size()))) continue;
    const bool known = std::any_of(
        tried.begin(), tried.end(), [&](int other) { return MoveAlike(own, motions.col(other)); });
    if (!known) tried.push_back(slot);
  }
  return tried;
}

class ColumnDriverEffect final : public Effect {
 public:
  EffectDescription Describe() const override {
    EffectDescription d{"column_driver",
                        "something moves in step with a column that the program does not know",
                        "d slot = c (x - x of the first row)",
                        "<slot> [rad or m per unit of the column]",
                        {{"column", "name of the column"}, {"slot", "theta3, base_x, tool_z ..."}},
                        "a numeric column that stands for nothing else",
                        "0.1 mrad or 0.1 mm over the column's course [PHYSICS.md U1]"};
    d.has_joint = false;
    d.needs_whole_model = true;
    d.zero_unknown = true;
    return d;
  }

  std::string NotTestable(const PhysicsContext& c, const EffectRequest& request) const override {
    if (request.word("column").empty()) return "needs the setting column, the name of a column";
    const ExtraColumn* const column = ColumnNamed(c, request.word("column"));
    if (column == nullptr) return NoSuchColumn(c, request.word("column"));
    if (!column->values.allFinite()) return "the column has blank cells";
    if (StandsStill(column->values)) return "the column is constant";
    if (SlotNamed(c.slots(), request.word("slot"))) return "";
    return fmt::format(
        "needs the setting slot, one of theta1, d1, a1, alpha1, beta1 ... beta{}, "
        "base_x ... base_rz, tool_x ... tool_rz",
        c.num_joints());
  }

  std::vector<EffectColumn> Columns(const PhysicsContext& c,
                                    const EffectRequest& request) const override {
    const VectorXd& x = ColumnNamed(c, request.word("column"))->values;
    const int slot = *SlotNamed(c.slots(), request.word("slot"));
    return {SlotColumn(request.word("slot"),
                       c.slots().is_angle(slot) ? "rad per unit" : "m per unit",
                       kUsual / Deviation(x),
                       slot,
                       x.array() - x[0])};
  }

  std::vector<EffectRequest> Candidates(const PhysicsContext& c) const override {
    std::vector<EffectRequest> requests;
    for (const std::string& column : DriversOfTheirOwn(c)) {
      for (const int slot : SlotsTried(c)) {
        EffectRequest request;
        request.effect = "column_driver";
        request.words = {{"column", column}, {"slot", c.slots().Name(slot)}};
        requests.push_back(request);
      }
    }
    return requests;
  }

  EffectPlace Place(const PhysicsContext& c, const EffectRequest& request) const override {
    return {"column", Location(c, request.word("slot")), "column " + request.word("column")};
  }

  std::vector<EffectRequest> Twins(const PhysicsContext& c,
                                   const EffectRequest& request) const override {
    const MatrixXd motions = MotionsOfSlots(c);
    const int own = *SlotNamed(c.slots(), request.word("slot"));
    std::vector<EffectRequest> twins;
    for (int slot = 0; slot < c.slots().size(); ++slot) {
      const bool beta = c.slots().is_joint(slot) && SlotLayout::NumberAt(slot) == JointSlot::kBeta;
      if (slot == own || beta || !MoveAlike(motions.col(own), motions.col(slot))) continue;
      EffectRequest twin = request;
      twin.words["slot"] = c.slots().Name(slot);
      twins.push_back(twin);
    }
    return twins;
  }

  std::string Sentence(const PhysicsContext& /*context*/,
                       const EffectRequest& request,
                       const std::vector<EffectValue>& values) const override {
    const EffectValue rate = Find(values, request.word("slot"));
    const std::string unit = rate.unit.substr(0, rate.unit.find(' '));
    // Nobody knows the column's numbers beforehand: as small a unit as the rate asks for.
    constexpr double kWorthItsUnit = 0.01;
    double size = 1e-3;
    std::string prefix = "m";
    for (const char* const smaller : {"u", "n"}) {
      if (std::abs(rate.value) >= kWorthItsUnit * size) break;
      size /= 1e3;
      prefix = smaller;
    }
    return fmt::format("{} follows the column '{}': {}",
                       request.word("slot"),
                       Printable(request.word("column")),
                       Quantity(rate, size, prefix + unit + " per unit of it"));
  }

  WorkedExample Example() const override {
    WorkedExample example;
    example.request.effect = "column_driver";
    example.request.words = {{"column", "motor_temp"}, {"slot", "theta3"}};
    example.request.values["theta3"] = 1e-5;
    example.row = 1;
    example.slot = "theta3";
    example.expected = 1e-4;
    return example;
  }

 private:
  static std::string NoSuchColumn(const PhysicsContext& c, const std::string& name) {
    std::vector<std::string> names;
    for (const ExtraColumn& column : c.recording().extra) {
      names.push_back(Printable(column.name));
    }
    return fmt::format("the recording has no column '{}' that stands for nothing else; {}",
                       Printable(name),
                       names.empty() ? "all its columns are known"
                                     : fmt::format("it has {}", fmt::join(names, ", ")));
  }

  static std::string Location(const PhysicsContext& c, const std::string& name) {
    const std::optional<int> slot = SlotNamed(c.slots(), name);
    if (!slot) return "any slot";
    if (!c.slots().is_joint(*slot)) return c.slots().is_base(*slot) ? "base" : "tool";
    const int joint = SlotLayout::JointOf(*slot);
    return *slot == c.joint_slot(joint) ? JointName(joint + 1) : fmt::format("link {}", joint + 1);
  }
};

}  // namespace

const Effect& ColumnDriver() {
  static const ColumnDriverEffect effect;
  return effect;
}

}  // namespace dhcal
