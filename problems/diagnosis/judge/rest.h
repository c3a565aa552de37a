// What a model leaves that is more than noise: the strongest structure of all, and the curve of it.
#ifndef DHCAL_PROBLEMS_DIAGNOSIS_JUDGE_REST_H_
#define DHCAL_PROBLEMS_DIAGNOSIS_JUDGE_REST_H_

#include <vector>

#include "core/model/diagnosis.h"
#include "problems/diagnosis/hypotheses/bank.h"
#include "problems/diagnosis/refit/joint_model.h"
#include "problems/diagnosis/search/gram.h"

namespace dhcal {

struct Structure {
  double log_p = 0;           // of the strongest, corrected for all that were looked at
  int item = -1;              // position in the bank
  double gain = 0;            // squares that it would remove
  std::vector<MapEntry> map;  // of the cells, strongest first
  Bank::Rest rest;            // of the rows beside the bank's members
};

/// Looks at every item of a bank beside its members.
Structure StrongestStructure(const Bank& bank, const EvidenceRule& rule, double sigma);

/// Place, driver and, where one thing drives it, the curve of an item in a rest of the rows.
Unexplained DescribeRest(const Item& item,
                         const JointRows& joint,
                         const Bank::Rest& rest,
                         double sigma_scale);

}  // namespace dhcal

#endif  // DHCAL_PROBLEMS_DIAGNOSIS_JUDGE_REST_H_
