// A calibration that can be solved: robot, recording, unknowns, readings and where to start.
#ifndef DHCAL_PROBLEMS_CALIBRATION_H_
#define DHCAL_PROBLEMS_CALIBRATION_H_

#include <memory>
#include <vector>

#include <Eigen/Core>

#include "core/kinematics/dh_chain.h"
#include "core/model/parameter.h"
#include "core/model/problem_spec.h"
#include "core/model/reading.h"
#include "core/model/recording.h"
#include "core/physics/effect.h"
#include "problems/frames.h"
#include "residuals/measurement.h"

namespace dhcal {

/// Standard deviations that whiten the readings.
struct Noise {
  double sigma = 1.0;           // [m] one coordinate of a row without its own sigma
  double sigma_rotation = 1.0;  // [rad] one component
};

/// Immutable once built; `spec` and `recording` must outlive it.
struct Calibration {
  Calibration(const ProblemSpec& problem_spec, const Recording& rows);

  const ProblemSpec& spec;
  const Recording& recording;
  std::shared_ptr<const Measurement> measurement;  // what a reading is
  DhChain chain;
  std::vector<Parameter> parameters;  // unknown; state k corrects parameters[k]
  Readings readings;
  Frames frames;                              // where base and tool start (nominal, or aligned)
  std::vector<EffectColumn> effect_columns;   // of the parameters of group effect
  std::vector<std::size_t> effect_of_column;  // of `effects`
  const EffectColumn& ColumnOf(const Parameter& p) const {
    return effect_columns[static_cast<std::size_t>(p.effect_column)];
  }
  const EffectRequest& EffectOf(int column) const {
    return effects[effect_of_column[static_cast<std::size_t>(column)]];
  }

  /// Circumstances of the rows with the base where `frames` has it.
  PhysicsContext Context() const;
  /// Takes these effects (all testable) as unknowns, or at their values where they are held,
  /// instead of the ones there are.
  void SetEffects(const std::vector<EffectRequest>& requests);
  /// What held effects add to slots, whatever the state.
  std::vector<SlotWeights> held;  // weight = amount [rad or m] per row of the recording
  /// Lets the effects load the arm as it stands at a state, bent by the effects themselves, instead
  /// of the nominal one, and computes their weights again. A state keeps its meaning.
  void Bend(const Eigen::VectorXd& state);
  /// Computes the effects' weights again after `frames` has moved.
  void UpdateEffects() { SetEffects(effects); }
  std::vector<EffectRequest> effects;        // switched on
  Eigen::MatrixXd arm;                       // slots x rows: of the arm they load; empty = nominal
  std::vector<Eigen::Isometry3d> arm_bases;  // its bases
  /// Bases X_WB with a state's corrections; of the start where the state is empty.
  std::vector<Eigen::Isometry3d> BasesAt(const Eigen::VectorXd& state) const;

  /// Moves the readings of rows that the recording sets aside out of the others.
  void SetAside();

  /// Target of a row: index into spec.robot.targets, by its name; 0 without targets.
  int Target(int row_idx) const;
  /// What frames and parameters of a row may differ by.
  RowLabels Labels(int row_idx) const;
  /// Slot perturbations of a row at a state.
  Eigen::VectorXd SlotDeltas(const Eigen::VectorXd& state, int row_idx) const;
  /// Standard deviation of a row's coordinates [m].
  double RowSigma(int row_idx, const Noise& noise) const;
  /// True if the row's cell sigma_mm says it.
  bool HasOwnSigma(int row_idx) const;
  /// Pose X_WQ of a row at a state.
  Eigen::Isometry3d Pose(const Eigen::VectorXd& state, int row_idx) const;
};

}  // namespace dhcal

#endif  // DHCAL_PROBLEMS_CALIBRATION_H_
