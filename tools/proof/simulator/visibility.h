// What of an effect can be seen in a recording at all, and what it does elsewhere: answers that the
// scorer holds against the diagnosis. From the true positions alone.
#ifndef DHCAL_TOOLS_PROOF_SIMULATOR_VISIBILITY_H_
#define DHCAL_TOOLS_PROOF_SIMULATOR_VISIBILITY_H_

#include <functional>
#include <vector>

#include <Eigen/Core>

#include "tools/proof/simulator/arm.h"
#include "tools/proof/simulator/motion.h"

namespace dhcal::concealed {

/// Positions (poses x 3) as one column, pose by pose.
Eigen::VectorXd Stacked(const Eigen::MatrixXd& positions);

/// d position / d every geometric freedom of the arm (DH rows, Hayati's angles where the drawing's
/// axes are parallel, base, tool), by central differences; 3 poses x freedoms.
Eigen::MatrixXd GeometrySignatures(const Arm& drawing, const Arm& built, const Motion& motion);

/// The same of what `read` says that an arm reads (poses x 3).
Eigen::MatrixXd GeometrySignatures(const Arm& drawing,
                                   const Arm& built,
                                   const Motion& motion,
                                   const std::function<Eigen::MatrixXd(const Arm&)>& read);

/// As differences of successive poses within runs, for recordings that hold those.
Eigen::MatrixXd Differences(const Eigen::MatrixXd& rows, const Motion& motion);

struct Visibility {
  double raw_rms = 0;      // [m] per coordinate, of the effect alone
  double visible_rms = 0;  // [m] what geometry (and the other effects) cannot take of it
  double lambda = 0;       // non-centrality: sum of squares of that over the noise
  double power = 0;        // of a test that knows the effect, against 200 others
};

/// What of a signal no combination of the columns of `known` makes.
Eigen::VectorXd WithoutKnown(const Eigen::VectorXd& signal, const Eigen::MatrixXd& known);

/// `signal`, `known`: 3 poses x 1 and x k (geometry, other effects); `parameters` of the effect.
Visibility VisibilityOf(const Eigen::VectorXd& signal,
                        const Eigen::MatrixXd& known,
                        double noise,
                        int parameters);

/// Largest and RMS (3-D) error at `elsewhere` of the geometry that fits `signal` best at the
/// recorded poses. Directions that the recording sees less than a manufacturing tolerance moves
/// them are left out, as a sensible fit does.
struct Elsewhere {
  double rms = 0, largest = 0;  // [m]
};
Elsewhere ErrorElsewhere(const Eigen::MatrixXd& geometry_here,
                         const Eigen::VectorXd& signal_here,
                         const Eigen::MatrixXd& geometry_there,
                         const Eigen::VectorXd& signal_there,
                         double noise);

}  // namespace dhcal::concealed

#endif  // DHCAL_TOOLS_PROOF_SIMULATOR_VISIBILITY_H_
