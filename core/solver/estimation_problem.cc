#include "core/solver/estimation_problem.h"

#include <glog/logging.h>

namespace dhcal {

std::vector<double*> EstimationProblem::blocks() {
  std::vector<double*> pointers;
  pointers.reserve(state.size());
  for (double& value : state) pointers.push_back(&value);
  return pointers;
}

Eigen::VectorXd EstimationProblem::state_vector() const {
  return Eigen::Map<const Eigen::VectorXd>(state.data(), static_cast<Eigen::Index>(state.size()));
}

void EstimationProblem::set_state(const Eigen::VectorXd& x) {
  CHECK_EQ(x.size(), static_cast<Eigen::Index>(state.size()));
  Eigen::Map<Eigen::VectorXd>(state.data(), x.size()) = x;
}

}  // namespace dhcal
