// All that a diagnosis tries: the named effects of the library, and anonymous ones (a smooth
// function of any driver on any slot), as blocks of columns over the same rows.
#ifndef DHCAL_PROBLEMS_DIAGNOSIS_HYPOTHESES_H_
#define DHCAL_PROBLEMS_DIAGNOSIS_HYPOTHESES_H_

#include <string>
#include <vector>

#include <Eigen/Core>

#include "core/analysis/block_tests.h"
#include "core/model/diagnosis.h"
#include "core/model/effect_request.h"
#include "core/physics/effect.h"
#include "problems/diagnosis/design_rows.h"

namespace dhcal {

/// One block of columns.
struct Hypothesis {
  bool named = false;
  const Effect* effect = nullptr;  // named
  EffectRequest request;           // named
  EffectPlace place;               // named
  int shape_block = -1;            // named: nuisance block of its shape errors, or -1
  std::string slot, driver_name;   // anonymous: "theta3", "q2"
  int slot_joint = 0;              // anonymous: whose angle the slot is, from 1; 0 = none's
  Driver driver;                   // of either kind
  Eigen::VectorXd driver_values;   // anonymous, per recording row; empty = several drivers
  std::vector<double> knots;       // anonymous, of a curve
  ColumnRange columns;
  double prior_variance = 0;  // of a coefficient in units of its column; 0 = none
  bool in_maximum = true;
  /// Step instants, orders, time constants of one family differ only in settings.
  std::string family;

  /// A free curve of many coefficients that a prior holds.
  bool is_curve() const { return prior_variance > 0; }
};

/// True for a name that is a function of its own joint's angle.
inline bool IsOfOwnAngle(const Hypothesis& h) {
  return h.named && h.driver == Driver{DriverKind::kJointAngle, h.request.joint};
}

/// Columns of an anonymous block before they become rows.
struct MapBlock {
  std::string slot, driver_name;
  int slot_joint = 0;
  Driver driver;
  Eigen::VectorXd driver_values;
  std::vector<double> knots;
  std::vector<std::vector<SlotWeights>> columns;
};

/// The slots and drivers that any recording has, and those that this one adds.
std::vector<MapBlock> MapBlocks(const PhysicsContext& context);

/// Piecewise linear functions that are 1 at one knot and 0 at the others, per value.
Eigen::MatrixXd Hats(const Eigen::VectorXd& values, const std::vector<double>& knots);

/// The growing set of blocks with its Gram matrix. Keeps the projected columns, so that one more
/// block costs one pass over the rows.
class HypothesisSpace {
 public:
  /// `U`: basis of the geometry; `y`: rows projected off it. All must outlive the space.
  HypothesisSpace(const PhysicsContext& context,
                  const DesignRows& rows,
                  const Eigen::MatrixXd& U,
                  const Eigen::VectorXd& y);

  /// Adds an effect of the library with its shape errors; returns its index.
  int AddEffect(const EffectRequest& request, bool in_maximum = true);
  int AddMap(const MapBlock& block);

  const std::vector<Hypothesis>& all() const { return all_; }
  const PhysicsContext& context() const { return context_; }
  const DesignRows& rows() const { return rows_; }
  const Eigen::MatrixXd& U() const { return U_; }
  const Eigen::VectorXd& y() const { return y_; }
  /// Projected columns of a block.
  auto Projected(int idx) const {
    const ColumnRange& range = all_[static_cast<std::size_t>(idx)].columns;
    return X_.middleCols(range.first, range.size);
  }

  /// Orthonormal basis of several blocks' projected columns.
  Eigen::MatrixXd BasisOf(const std::vector<int>& blocks) const;

  /// `before`: the tests before blocks were added that are not in the maximum; may be null.
  BlockTests Tests(double nu,
                   bool sigma_known,
                   int draws,
                   std::uint64_t seed,
                   const BlockTests* before = nullptr) const;

  /// The score of an effect that is no member (a setting being refined), beside the basis `extra`
  /// of what is already in the model: squares removed.
  double Removes(const EffectRequest& request, const Eigen::MatrixXd& extra) const;

 private:
  void CompleteGram() const;
  ColumnRange AddColumns(const Eigen::MatrixXd& raw);
  Eigen::MatrixXd Raw(const std::vector<EffectColumn>& columns) const;

  const PhysicsContext& context_;
  const DesignRows& rows_;
  const Eigen::MatrixXd& U_;
  const Eigen::VectorXd& y_;
  std::vector<Hypothesis> all_;
  Eigen::MatrixXd X_;  // num_rows x columns reserved
  int num_columns_ = 0;
  std::vector<double> norm2_;
  mutable Eigen::MatrixXd S_;  // Gram matrix of the first columns, completed when asked for
};

}  // namespace dhcal

#endif  // DHCAL_PROBLEMS_DIAGNOSIS_HYPOTHESES_H_
