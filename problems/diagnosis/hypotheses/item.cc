#include "problems/diagnosis/hypotheses/item.h"

#include <cmath>
#include <utility>

#include "core/physics/registry.h"

namespace dhcal {

SlotColumns ColumnsOf(const Item& item, const PhysicsContext& context) {
  if (item.kind == ItemKind::kCell) return *item.cell;
  SlotColumns columns;
  if (item.kind == ItemKind::kCompletion) return columns;
  for (EffectColumn& column : EffectColumns(context, item.request)) {
    columns.push_back(std::move(column.slots));
  }
  return columns;
}

double UsualSizes(const Item& item, const Eigen::VectorXd& value) {
  if (item.kind != ItemKind::kEffect || value.size() == 0) return 0;
  return std::sqrt(value.cwiseQuotient(item.typical).squaredNorm() /
                   static_cast<double>(value.size()));
}

}  // namespace dhcal
