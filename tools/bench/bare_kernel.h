// The least that a linearisation can cost: what tools/dhcal_bench.cc compares the real one with.
#ifndef DHCAL_TOOLS_BENCH_BARE_KERNEL_H_
#define DHCAL_TOOLS_BENCH_BARE_KERNEL_H_

namespace dhcal {

constexpr int kBareJoints = 6;
constexpr int kBareColumns = 4 * kBareJoints + 1;  // theta, d, a, alpha of each joint; -r

/// Plain standard rows of turning joints between plain ends, and nothing else.
struct BareRobot {
  double theta[kBareJoints], d[kBareJoints], a[kBareJoints], alpha[kBareJoints];
};

/// Sums the lower triangle of [J, -r]'[J, -r] over 8 `num_packs` poses, in blocks and lanes as
/// core/simd/kernels.h has them. `readings`: per pack of 8 poses, six joint angles [rad] and the
/// measured position x y z [m], 8 doubles each. Compiled for the machine that compiles it, with
/// fused multiply-add: to be run there only.
void BareNormalMatrix(const BareRobot& robot, const double* readings, int num_packs, double* sums);

}  // namespace dhcal

#endif  // DHCAL_TOOLS_BENCH_BARE_KERNEL_H_
