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

bool IsByTheClock(const Item& item, const PhysicsContext& context) {
  const std::string driver =
      item.kind == ItemKind::kEffect
          ? FindEffect(item.request.effect)->Place(context, item.request).driver
          : item.driver;
  return driver == kTimeDriver || driver == kOrderDriver;
}

EffectRequest WithValues(const Item& item,
                         const PhysicsContext& context,
                         const Eigen::VectorXd& value) {
  EffectRequest request = item.request;
  const std::vector<EffectColumn> columns = EffectColumns(context, request);
  for (std::size_t k = 0; k < columns.size(); ++k) {
    request.values[columns[k].parameter] = value[static_cast<Eigen::Index>(k)];
  }
  return request;
}

double UsualSizes(const Item& item, const Eigen::VectorXd& value) {
  if (item.kind != ItemKind::kEffect || value.size() == 0) return 0;
  return std::sqrt(value.cwiseQuotient(item.typical).squaredNorm() /
                   static_cast<double>(value.size()));
}

}  // namespace dhcal
