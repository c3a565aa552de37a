// The arms that recordings are made of, as drawn.
#ifndef DHCAL_TOOLS_PROOF_SIMULATOR_ARMS_H_
#define DHCAL_TOOLS_PROOF_SIMULATOR_ARMS_H_

#include "tools/proof/simulator/arm.h"

namespace dhcal::concealed {

/// KUKA KR 15/2, Universal Robots UR10, and a small arm of ABB IRB 120 size. Masses of the KR 15
/// and of the tools are rough figures.
Arm KukaKr15();
Arm UniversalUr10();
Arm SmallArm();

/// Six joints in modified rows, seven joints, and a SCARA whose third joint slides. Sizes as of
/// such arms, of no particular maker.
Arm ModifiedSix();
Arm SevenAxes();
Arm Scara();

}  // namespace dhcal::concealed

#endif  // DHCAL_TOOLS_PROOF_SIMULATOR_ARMS_H_
