// What is known of the loads on a joint where no masses are stated.
#ifndef DHCAL_PROBLEMS_DIAGNOSIS_HYPOTHESES_LOADS_H_
#define DHCAL_PROBLEMS_DIAGNOSIS_HYPOTHESES_LOADS_H_

#include <vector>

#include "core/model/effect_request.h"
#include "core/physics/context.h"

namespace dhcal {

/// Whether guessed masses say anything of a joint: they put the last links' masses on their axes,
/// where they load nothing, whatever the true ones do.
class GuessedLoads {
 public:
  explicit GuessedLoads(const PhysicsContext& context);
  bool tells(int joint) const { return load_[static_cast<std::size_t>(joint - 1)] >= least_; }

 private:
  std::vector<double> load_;  // [N m or N], root mean square
  double least_ = 0;
};

/// The requests that follow a gravity torque of which the masses tell nothing, each with moments
/// instead: of the joint's own link or of the next one, in directions all around (half of them: the
/// other half is the other sense), finely around those of `near`, and with some friction.
std::vector<EffectRequest> WithMoments(const PhysicsContext& context,
                                       const GuessedLoads& guessed,
                                       const std::vector<EffectRequest>& near,
                                       const std::vector<EffectRequest>& requests);

}  // namespace dhcal

#endif  // DHCAL_PROBLEMS_DIAGNOSIS_HYPOTHESES_LOADS_H_
