// Resolves a problem file's `parameters` against its robot and recording.
#ifndef DHCAL_PROBLEMS_PARAMETER_SET_H_
#define DHCAL_PROBLEMS_PARAMETER_SET_H_

#include <string>
#include <vector>

#include "core/model/parameter.h"
#include "core/model/problem_spec.h"
#include "core/model/recording.h"
#include "core/physics/effect.h"

namespace dhcal {

struct ParameterSet {
  std::vector<Parameter> estimated;
  std::vector<Parameter> fixed;  // the robot's DH rows, base and tool that are not estimated
};

/// What manufacture, mastering or set-up leaves open, one sigma [rad or m]. It scales columns and
/// decides which directions are worth estimating; it does not pull estimates (a prior does).
double DefaultTolerance(ParameterGroup group, Unit unit);

/// A correction beyond this [rad or m] is no calibration; infinite for the base.
double CorrectionLimit(const Parameter& parameter);

/// Parameters in the paper's order: theta, alpha, a, d, then beta, base, tool. Base and tool have
/// one set per run, target or edge, where the robot says so ("base_x.run2", "tool_z.A").
ParameterSet ResolveParameters(const ProblemSpec& spec, const Recording& recording);

/// The unknown of an effect's column; tolerance = several times the typical size.
Parameter EffectParameter(const EffectRequest& request, const EffectColumn& column, int column_idx);

/// Joints (from 0) whose beta completes the geometry: where the next axis is nominally parallel
/// and plain DH has no parameter for its tilt (Hayati 1983).
std::vector<int> JointsThatNeedBeta(const RobotModel& robot);

}  // namespace dhcal

#endif  // DHCAL_PROBLEMS_PARAMETER_SET_H_
