// A recording whose files say something that is not so: which robot, what was measured, and what
// the files hold before and after the mistakes.
#ifndef DHCAL_TOOLS_PROOF_SIMULATOR_SETUPS_WRONG_FILES_H_
#define DHCAL_TOOLS_PROOF_SIMULATOR_SETUPS_WRONG_FILES_H_

#include <cstdint>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "tools/proof/simulator/arm.h"
#include "tools/proof/simulator/case_files.h"
#include "tools/proof/simulator/random/random_trial.h"

namespace dhcal::concealed {

/// One thing that the files say wrongly.
struct Mistake {
  std::string kind;         // as in result.json
  std::vector<int> joints;  // from 1; empty where none is concerned
};

struct WrongFiles {
  RandomTrial trial;         // what was measured
  Arm table;                 // what the problem file says of the arm
  Eigen::MatrixXd q;         // what the joint columns hold [rad], slides [m], before units
  Eigen::MatrixXd readings;  // of the instrument
  // Units: what a written number is times.
  std::vector<double> joint_unit;         // 1/kDegree as written; 1 where it holds radians
  std::vector<std::string> joint_ending;  // "deg", "rad", "mm"
  double angle_unit = 0;                  // of the table's angles
  double tool_unit = 1;                   // of the tool's lengths, likewise
  double length_unit = 1;                 // of the table's lengths, written as _m
  double reading_unit = 1e3;              // of the readings
  std::string reading_ending = "mm";
  std::vector<int> quaternion = {0, 1, 2, 3};  // component in each column
  std::vector<Mistake> mistakes;
};

/// Of a seed: a robot of six, 30 to 300 poses and one to three mistakes; without them, the same
/// files as they should be.
WrongFiles MakeWrongFiles(int seed, bool with_mistakes = true);

/// The files, and the sealed answer.
CaseFiles FilesOf(const WrongFiles& wrong);

/// "S_00012", of the seed alone.
std::string NameOfWrongFiles(int seed);

}  // namespace dhcal::concealed

#endif  // DHCAL_TOOLS_PROOF_SIMULATOR_SETUPS_WRONG_FILES_H_
