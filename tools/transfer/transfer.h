// Does what was found hold elsewhere? Prediction of whole blocks of consecutive rows, and of
// another recording of the same robot with the physics held and only the geometry fitted again.
#ifndef DHCAL_TOOLS_TRANSFER_TRANSFER_H_
#define DHCAL_TOOLS_TRANSFER_TRANSFER_H_

#include <string>
#include <vector>

#include "core/model/diagnosis.h"
#include "core/model/problem_spec.h"
#include "core/model/recording.h"
#include "problems/fit.h"

namespace dhcal {

/// Errors of predicted points over some rows, geometry alone and with the physics.
struct Errors {
  int rows = 0;                                // poses where they are shared by differences
  double before = kUnknown, after = kUnknown;  // [m] 3-D RMS (of one coordinate for distances)
};

/// The fold of each row when `count` blocks of consecutive rows are left out in turn.
std::vector<int> ConsecutiveBlocks(int num_rows, int count);

/// Each block predicted from the others with the effects estimated again without it; last: all
/// rows together. The effects themselves were chosen by someone who may have seen the block.
std::vector<Errors> PredictBlocks(const ProblemSpec& spec,
                                  const Recording& recording,
                                  const std::vector<EffectRequest>& effects,
                                  int count,
                                  const Progress& progress);

/// One block predicted by a diagnosis that never saw it: neither the search nor the fits.
struct UnseenBlock {
  Errors errors;
  std::vector<EffectRequest> model;
};
UnseenBlock DiagnoseWithoutBlock(const ProblemSpec& spec,
                                 const Recording& recording,
                                 int block,
                                 int count,
                                 const Progress& progress);

struct Transfer {
  Errors all, inside, outside;  // of the first recording's joint ranges
  Errors visited;               // rows of which every joint has been within a knot's distance
  std::vector<std::string> left_behind;  // effects that the second recording cannot have
};

/// `model` (with values) held on `spec`'s recording, geometry, base and tool fitted again.
Transfer TransferTo(const ProblemSpec& spec,
                    const Recording& recording,
                    const Recording& first,
                    const std::vector<EffectRequest>& model,
                    const Progress& progress);

}  // namespace dhcal

#endif  // DHCAL_TOOLS_TRANSFER_TRANSFER_H_
