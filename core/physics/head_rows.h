// Errors of a measuring head's readings, as effects.
//
// An effect moves slots, and a reading of a head moves with the pose of its tool. So an error of
// the three numbers (ruler, height1, height2) is written as a motion of the tool that changes them
// by as much, a perturbation of the base in the row's edge frame (core/NOTATION.md): for the
// heights the smallest climb and tilt,
//   (z, l rx, l ry) of least norm with  d heights = -(z + rx y_k - ry x_k) / u_k.z
// at the lasers' spots (x_k, y_k) from Q; then the shift along x that the ruler lacks. Exact for
// the ruler alone, else to first order: the second is below a hundredth of errors up to 0.3 mm. The
// robot itself does not move (EffectDescription::of_instrument). PHYSICS.md, "The measuring head".
#ifndef DHCAL_CORE_PHYSICS_HEAD_ROWS_H_
#define DHCAL_CORE_PHYSICS_HEAD_ROWS_H_

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "core/kinematics/head_sight.h"
#include "core/physics/context.h"
#include "core/physics/effect.h"

namespace dhcal {

/// What a head sees at the rows of a recording along edges, as the context has the robot.
class HeadRows {
 public:
  explicit HeadRows(const PhysicsContext& context);

  /// Why there are no readings of a head; empty where there are.
  static std::string Missing(const PhysicsContext& context);

  /// Null where a row reads no edge, or sees none from where the context has the robot.
  const HeadSights* sights(int row_idx) const {
    const std::optional<HeadSights>& found = sights_[static_cast<std::size_t>(row_idx)];
    return found ? &*found : nullptr;
  }
  /// Mean of a sensor's number n over the rows of a row's edge, and over all rows [m].
  double MeanOfEdge(int row_idx, int number) const;
  double Mean(int number) const { return mean_[number]; }

  /// A parameter whose unit changes a row's three numbers by `error` [m].
  EffectColumn Column(
      const std::string& parameter,
      const std::string& unit,
      double typical,
      const std::function<Eigen::Vector3d(int row_idx, const HeadSights& sights)>& error) const;

 private:
  const PhysicsContext& context_;
  std::vector<std::optional<HeadSights>> sights_;
  Eigen::Matrix3Xd mean_of_edge_;
  Eigen::Vector3d mean_ = Eigen::Vector3d::Zero();
};

/// What is the same for all effects of a head: where they can be seen, and that the robot does not
/// move by them.
class EffectOfHead : public Effect {
 public:
  EffectDescription Describe() const final;
  std::string NotTestable(const PhysicsContext& context,
                          const EffectRequest& request) const override;

 private:
  /// The words of the description; what follows from being of a head is added to them.
  virtual EffectDescription Words() const = 0;
};

/// An effect of one laser, which the setting `laser` names.
class EffectOfLaser : public EffectOfHead {
 public:
  std::string NotTestable(const PhysicsContext& context, const EffectRequest& request) const final;
  std::vector<EffectRequest> Candidates(const PhysicsContext& context) const final;
};

/// 0 or 1 from the setting `laser`, which counts from 1.
int LaserIndex(const EffectRequest& request);

}  // namespace dhcal

#endif  // DHCAL_CORE_PHYSICS_HEAD_ROWS_H_
