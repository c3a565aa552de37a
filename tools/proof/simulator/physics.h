// What the built arm does beside rigid motion: mechanisms by their own laws, not by the formulas of
// the effect library. Zero everywhere = a rigid arm.
#ifndef DHCAL_TOOLS_PROOF_SIMULATOR_PHYSICS_H_
#define DHCAL_TOOLS_PROOF_SIMULATOR_PHYSICS_H_

#include <array>
#include <functional>
#include <vector>

#include <Eigen/Core>

namespace dhcal::concealed {

struct Arm;

/// One joint's drive, from the motor's encoder to the link.
struct Drive {
  double compliance = 0;        // [rad/(N m)] of the gear under load
  double soft_torque = 0;       // [N m] below it the gear is softer (three-region law, first two)
  double soft_ratio = 1;        // by this factor
  double play = 0;              // [rad] gap between the flanks
  double preload = 1e9;         // [N m] gravity beyond this keeps the gear on one flank
  double windup = 0;            // [rad] left by friction after a long travel
  double windup_travel = 1e-3;  // [rad] of travel after a reversal that builds it up
  std::function<double(double q)> windup_form;  // [1] times windup: friction that depends on angle
  double gain = 0;                              // [rad/rad] wrong ratio
  std::function<double(double q)> form;         // [rad] any other error as a function of the angle
};

/// A gear's error once (or `order` times) per turn; at the motor's side the order is its ratio.
struct GearLine {
  int joint = 0;  // from 0
  double order = 1;
  double amplitude = 0;  // [rad]
  double phase = 0;      // [rad]
};

/// A bearing that tilts its axis `order` times per turn.
struct Wobble {
  int joint = 0;  // from 0
  double order = 2;
  double amplitude = 0;  // [rad]
  double phase = 0;      // [rad]
};

struct Coupling {
  int joint = 0, driver = 0;  // from 0
  double ratio = 0;           // [rad/rad]
};

/// A spring between the column and link 2: acts on joint 2 alone.
struct Balancer {
  double stiffness = 0;                          // [N/m]; 0 = none
  double rest = 0.3, column = 0.6, link = 0.15;  // [m] free length and lever arms
  double phase = 0.3;                            // [rad]
};

/// Lumped heat: a source warms the first body, which warms the second, and so on; each grows.
struct ThermalBody {
  int link = 0;       // from 1
  double strain = 0;  // at the end of the warm-up
  double lag = 0;     // [s] of this body behind the one before
};

/// A zero or the base that moves as something warms up, by one exponential.
struct Drift {
  int joint = -1;                                    // from 0; -1 = the base moves
  double angle = 0;                                  // [rad] of the joint in the end
  Eigen::Vector3d motion = Eigen::Vector3d::Zero();  // [m] of the base in the end
  double lag = 1;                                    // [s]
};

/// A frame moved in the measurement frame: shifted, and turned about its own origin.
struct Move {
  Eigen::Vector3d shift = Eigen::Vector3d::Zero(), turn = Eigen::Vector3d::Zero();  // [m], [rad]
};

struct Step {
  int joint = 0;  // from 0; -1 = the tool moves, -2 = the base
  int at_row = 0;
  double angle = 0;                                 // [rad]
  Eigen::Vector3d shift = Eigen::Vector3d::Zero();  // [m] of the tool in the flange frame
  Move base;
};

/// A dimension of the arm that moves in step with something that is recorded beside the readings.
struct Follower {
  std::function<void(Arm*, double)> move;  // by so much [rad or m]
  Eigen::VectorXd amount;                  // [rad or m] at each row
};

/// What is wrong with the instrument itself.
struct Instrument {
  double length_offset = 0;  // [m] of one that reads distances
  double growth = 0;         // [1] of its unit of length as it warms up, in the end
  double lag = 1;            // [s] of that, one exponential
};

/// What is wrong with a measuring head and its straight edge.
struct HeadFaults {
  double bow = 0, vertex = 0.03;  // [1/m] curvature of both faces, deepest (highest) at x [m]
  double climb = 0;               // [rad] of the ruled face against the flat one
  double ruled_height = 0;        // [m] of it above where the file has it
  double pixel = 0;               // share by which offsets in the image are read too long
  double ruler_scale = 0;         // share by which the ruler's lengths are too long
  std::array<Eigen::Vector2d, 2> slant = {Eigen::Vector2d::Zero(),
                                          Eigen::Vector2d::Zero()};  // [rad]
  /// [1/m], [1/m^2]: square and cube of the distance from a laser's middle.
  std::array<Eigen::Vector2d, 2> bent = {Eigen::Vector2d::Zero(), Eigen::Vector2d::Zero()};
};

struct Physics {
  std::vector<Drive> drives;  // one per joint
  std::vector<GearLine> lines;
  std::vector<Coupling> couplings;
  Balancer balancer;
  std::vector<double> link_flexibility;                       // [1/(N m^2)] 1/EI, one per link
  Eigen::Vector2d base_compliance = Eigen::Vector2d::Zero();  // [rad/(N m)] about x and y
  std::vector<ThermalBody> thermal;                           // in the order of the heat
  std::vector<Drift> drifts;
  std::vector<Step> steps;
  std::vector<Wobble> wobbles;
  std::vector<Follower> followers;
  std::vector<Move> base_of_run;  // of run 1, 2, ...; empty = it stays
  double settling = 0;            // share of the last move that is still missing
  Instrument instrument;
  HeadFaults head;
  double latency = 0;                              // [s]
  Eigen::Vector3d sway = Eigen::Vector3d::Zero();  // [m] the floor swings
  double sway_period = 900;                        // [s]
  /// [rad] what other joints' angles do to a joint, beyond couplings.
  std::function<double(int joint, const Eigen::VectorXd& q)> cross;

  explicit Physics(int num_joints = 0)
      : drives(static_cast<std::size_t>(num_joints)),
        link_flexibility(static_cast<std::size_t>(num_joints), 0.0) {}
};

}  // namespace dhcal::concealed

#endif  // DHCAL_TOOLS_PROOF_SIMULATOR_PHYSICS_H_
