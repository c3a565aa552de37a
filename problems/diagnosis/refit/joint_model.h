// Geometry, effects and masses as one model, linearised at one state: the only place at which the
// diagnosis meets the calibration's own types. Residuals, loads and derivatives all come from the
// same state: mixing states (loads of the nominal arm, residuals of the bent one) loses right
// names.
#ifndef DHCAL_PROBLEMS_DIAGNOSIS_REFIT_JOINT_MODEL_H_
#define DHCAL_PROBLEMS_DIAGNOSIS_REFIT_JOINT_MODEL_H_

#include <memory>
#include <vector>

#include <Eigen/Core>

#include "core/model/problem_spec.h"
#include "core/physics/context.h"
#include "problems/calibration.h"
#include "problems/diagnosis/design_rows.h"
#include "problems/diagnosis/hypotheses/item.h"

namespace dhcal {

/// An effect or a cell in the model, with its parameters [SI].
struct Member {
  Item item;
  Eigen::VectorXd value;
  bool given = false;          // switched on in the problem file: always in the model, never judged
  bool whatever_size = false;  // beyond all usual sizes, and nothing else does instead
};

struct JointState {
  Eigen::VectorXd geometry;  // corrections of the calibration's unknowns [rad or m]
  Eigen::VectorXd masses;    // errors of each link's mass and centre (x, y, z), in their priors
  std::vector<Member> members;
  Eigen::MatrixXd deltas;  // slots x rows: what all of it added to the chain when last evaluated
};

/// Which rows are used and how they are weighed.
struct RowChoice {
  std::vector<Reading> readings;
  RowWeights weights;
};

/// The model's rows at a state: residual = y - A dgeometry - X dvalue - N dmass, whitened.
struct JointRows {
  JointState state;
  std::shared_ptr<const RobotModel> robot;  // with the state's masses
  std::shared_ptr<const PhysicsContext> context;
  std::shared_ptr<const DesignRows> rows;
  std::vector<int> free;      // geometric unknowns that are fitted
  Eigen::MatrixXd A;          // of all geometric unknowns
  Eigen::MatrixXd X;          // of the members' parameters, in their order
  Eigen::VectorXd value;      // of these parameters
  Eigen::VectorXd precision;  // of their priors, 1 / spread; 0 = none
  Eigen::MatrixXd N;          // of the masses that the members' loads rest on
  std::vector<int> mass_idx;  // of each column of N, into the state's masses
  double phi = 1;             // chi-square per row, at least 1: the priors grow with its root
  std::shared_ptr<const RowChoice> choice;

  const Eigen::VectorXd& y() const { return rows->y(); }
  /// Columns of a member in X.
  int FirstColumn(std::size_t member) const;
  /// A of the free unknowns.
  Eigen::MatrixXd FreeColumns() const { return A(Eigen::all, free); }
};

/// Not copyable: the calibration refers to the specification.
class JointModel {
 public:
  /// Every geometric freedom is an unknown; base and tool start at their alignment where the user's
  /// file estimates them. Without stated masses, usual ones are assumed and little is made of them.
  JointModel(const ProblemSpec& user, const Recording& recording);
  JointModel(const JointModel&) = delete;
  JointModel& operator=(const JointModel&) = delete;

  const Calibration& calibration() const { return *calibration_; }
  const ProblemSpec& spec() const { return spec_; }
  bool masses_given() const { return masses_given_; }
  /// One standard deviation of what is open of each geometric unknown.
  const Eigen::VectorXd& prior() const { return prior_; }
  /// All geometric unknowns.
  std::vector<int> AllUnknowns() const;

  /// No corrections; the members that the problem file switches on.
  JointState Start() const;
  JointRows At(JointState state, const RowChoice& choice, const std::vector<int>& free) const;
  /// y of these rows alone.
  Eigen::VectorXd ResidualsAt(JointState state, const RowChoice& choice) const;

 private:
  /// The robot under its loads, and what the members' parameters add to the slots there.
  struct Bent {
    std::shared_ptr<const RobotModel> robot;
    std::shared_ptr<const PhysicsContext> context;
    std::vector<SlotColumns> columns;
    bool elastic = false;
  };
  /// Fills the state's deltas.
  Bent Bend(JointState* state) const;
  RobotModel WithMasses(const Eigen::VectorXd& errors) const;
  Eigen::MatrixXd GeometryDeltas(const Eigen::VectorXd& geometry) const;
  void AddMassColumns(JointRows* joint) const;

  ProblemSpec spec_;
  bool masses_given_;
  std::unique_ptr<Calibration> calibration_;
  std::vector<EffectRequest> given_;
  Eigen::VectorXd prior_;
};

}  // namespace dhcal

#endif  // DHCAL_PROBLEMS_DIAGNOSIS_REFIT_JOINT_MODEL_H_
