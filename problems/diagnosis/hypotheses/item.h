// One thing that a recording may show: a named effect with its settings, a completion of the
// geometry, or an anonymous cell (any smooth function of a driver at a place).
#ifndef DHCAL_PROBLEMS_DIAGNOSIS_HYPOTHESES_ITEM_H_
#define DHCAL_PROBLEMS_DIAGNOSIS_HYPOTHESES_ITEM_H_

#include <memory>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "core/model/effect_request.h"
#include "core/physics/context.h"
#include "core/physics/effect.h"

namespace dhcal {

/// What one unit of a parameter adds to the slots, per recording row.
using SlotColumns = std::vector<std::vector<SlotWeights>>;

enum class ItemKind { kEffect, kCompletion, kCell };

struct Item {
  ItemKind kind = ItemKind::kEffect;
  /// Name and place ("joint_compliance.2"). Variants that differ only in settings (an instant, an
  /// order, a time constant) share it.
  std::string id;
  /// The id but for what `variants` pays for: names that one is chosen from are counted by it.
  std::string counted_as;
  EffectRequest request;       // effect or completion
  std::string slot, driver;    // cell: "theta3", "q2"
  int size = 0;                // parameters
  int variants = 1;            // forms of the id that are tried: the price of the choice
  std::vector<bool> positive;  // per parameter: a negative value is no such mechanism
  Eigen::VectorXd typical;     // per parameter, SI: its usual size
  /// Per parameter, SI: 1 / spread that a prior gives it, where only a prior keeps what the rows do
  /// not determine from running away (a free curve); 0 = none.
  Eigen::VectorXd precision;
  std::string taken_for;                    // effect: class of those that it is easily taken for
  bool elastic = false;                     // its shape rests on the masses
  bool own_angle = false;                   // an error of a joint's angle that the angle drives
  std::vector<int> unknowns;                // completion: the geometric unknowns that it frees
  std::shared_ptr<const SlotColumns> cell;  // cell: its columns
  Eigen::VectorXd driver_values;            // cell: per recording row; empty = several drivers
  std::vector<int> driven_by;               // cell: joints whose angles drive it, from 1

  bool is_name() const { return kind != ItemKind::kCell; }
  /// Same item with the same settings.
  bool SameAs(const Item& other) const {
    return kind == other.kind && id == other.id && request.SameAs(other.request);
  }
};

/// Columns of an effect or a cell in the circumstances of `context`; none of a completion.
SlotColumns ColumnsOf(const Item& item, const PhysicsContext& context);

/// Drivers of cells that go by the clock: that of the recording, or where it has none its rows.
constexpr char kTimeDriver[] = "time";
constexpr char kOrderDriver[] = "order of the rows";
/// True for a function of either.
bool IsByTheClock(const Item& item, const PhysicsContext& context);

/// An effect's request with the values of its parameters.
EffectRequest WithValues(const Item& item,
                         const PhysicsContext& context,
                         const Eigen::VectorXd& value);

/// Root mean square over the parameters of value / usual size; nothing is unusual about a cell or
/// a frame.
double UsualSizes(const Item& item, const Eigen::VectorXd& value);

}  // namespace dhcal

#endif  // DHCAL_PROBLEMS_DIAGNOSIS_HYPOTHESES_ITEM_H_
