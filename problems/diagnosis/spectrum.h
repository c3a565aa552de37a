// Periodic errors of unknown order: a periodogram of each joint's angle with the geometry taken
// out, and the false-alarm probability of its peaks.
#ifndef DHCAL_PROBLEMS_DIAGNOSIS_SPECTRUM_H_
#define DHCAL_PROBLEMS_DIAGNOSIS_SPECTRUM_H_

#include <vector>

#include <Eigen/Core>

#include "core/physics/context.h"
#include "problems/diagnosis/design_rows.h"

namespace dhcal {

/// Orders are scanned up to twice the highest usual gear ratio (161): a wave generator's mesh.
constexpr double kHighestOrder = 330;
/// Below, whole orders of gear_harmonic are the only lines that are named: a sine of order 2.3,
/// say, imitates any bump of a smooth function, and no gear has it.
constexpr double kLowestOrder = 8;

/// The effect that a line of the spectrum is.
constexpr char kLineEffect[] = "gear_harmonic";

/// True for a line that a scan found, or may have.
bool IsScannedLine(const EffectRequest& request);

/// True if a joint stops at few places, several times at each.
bool StopsAtFewPlaces(const Eigen::VectorXd& q);

struct SpectralPeak {
  int joint = -1;     // from 0
  double order = 0;   // per turn of the joint
  double Q = 0;       // squares that sine and cosine remove
  double p = 1;       // of this order alone
  double p_scan = 1;  // that the largest peak of all joints is as high under noise
};

/// W of all joints together: the scan is as large as so many independent orders.
double ScanWidth(const PhysicsContext& context);

/// Probability under noise that the highest of all orders has this p or less.
double ScanProbability(double p, double width);

/// What a scan looks at: rows without what is modelled already.
struct ScannedRows {
  Eigen::MatrixXd basis;     // orthonormal: geometry and what is modelled
  Eigen::VectorXd y;         // projected off it
  double nu = 0;             // its degrees of freedom
  bool sigma_known = false;  // y has unit variance
  bool with_rivals = false;  // orders that remove nearly as much are wanted, too
};

/// The highest peak of each revolute joint; with rivals, behind it the orders that remove as much
/// to within `list_margin`, if any does by more than chance: at evenly stepped places orders
/// repeat. An order of which the places show one phase only is none. The scan's false-alarm
/// probability is Baluev's (2008) bound for periodograms: with W turns times spread of the angle,
/// P(max > z) <= W sqrt(z) exp(-z), z = -log p.
std::vector<SpectralPeak> ScanOrders(const PhysicsContext& context,
                                     const DesignRows& rows,
                                     const ScannedRows& scanned);

}  // namespace dhcal

#endif  // DHCAL_PROBLEMS_DIAGNOSIS_SPECTRUM_H_
