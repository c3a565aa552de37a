// A recording: what was commanded and measured, one row per pose (FORMATS.md, section 1).
#ifndef DHCAL_CORE_MODEL_RECORDING_H_
#define DHCAL_CORE_MODEL_RECORDING_H_

#include <string>
#include <vector>

#include <Eigen/Core>

#include "core/base/diagnostics.h"

namespace dhcal {

/// A column of a file that stands for one of ours, as the problem file says.
struct ColumnAlias {
  std::string ours;    // "q1_rad"
  std::string theirs;  // as in the file's header; its number where the file has none
  SourceLocation ours_where, theirs_where;
};

/// A numeric column that the program does nothing with: one that it has no name for is kept as a
/// possible driver of a mismatch.
struct ExtraColumn {
  std::string name;
  Eigen::VectorXd values;  // NaN = blank
};

/// Columns are stored column-wise, SI units. A matrix or vector with zero rows = the column is
/// absent; NaN = the cell is blank. All present columns have num_rows() rows.
struct Recording {
  std::string file;         // for messages
  std::vector<int> lines;   // line of each row in `file`; empty when made by simulation
  Eigen::VectorXd numbers;  // of each row in another recording, from 0; empty = as they stand

  std::vector<std::string> q_names, p_names;  // of the columns in `file`; empty = not from a file
  int header_line = 0;                        // where they stand

  Eigen::MatrixXd q;             // num_rows x n [rad] or [m], as the controller reported it
  Eigen::MatrixXd p_WQ;          // num_rows x 3 [m] measured position
  Eigen::MatrixXd displacement;  // num_rows x 3 [m] from the previous row of the same run
  Eigen::MatrixXd quaternion;    // num_rows x 4 (w, x, y, z), normalised
  Eigen::VectorXd distance;      // [m] from the measured point to the row's anchor
  Eigen::MatrixXd head;          // num_rows x 3 [m] ruler, height1, height2 of the row's edge
  Eigen::VectorXd sigma;         // [m] standard deviation of this row's coordinates
  Eigen::VectorXd time;          // [s]
  Eigen::VectorXd payload;       // [kg]
  Eigen::MatrixXd temperature;   // num_rows x (1 or n) [degC]
  Eigen::MatrixXd direction;     // num_rows x n, -1, 0 or 1
  Eigen::MatrixXd speed;         // num_rows x n [rad/s] or [m/s]
  Eigen::MatrixXd torque;        // num_rows x n [N m] or [N]

  // Labels: index into the names, one per row; empty vectors = column absent.
  std::vector<std::string> run_names;
  std::vector<int> run_idx;
  std::vector<std::string> target_names;
  std::vector<int> target_idx;
  std::vector<std::string> anchor_names;
  std::vector<int> anchor_idx;  // -1 = blank
  std::vector<std::string> edge_names;
  std::vector<int> edge_idx;  // -1 = blank
  std::vector<bool> is_test;  // set == "test"; empty = no such column
  /// Rows that a diagnosis found misread: neither fitted nor tested with. Empty = none.
  std::vector<bool> set_aside;

  std::vector<ExtraColumn> extra;

  int num_rows() const { return static_cast<int>(q.rows()); }
  int num_joints() const { return static_cast<int>(q.cols()); }
  /// Run of a row; rows of a recording without the column are one run, 0.
  int run(int row_idx) const { return run_idx.empty() ? 0 : run_idx[row_idx]; }
  /// Target of a row; 0 without the column.
  int target(int row_idx) const { return target_idx.empty() ? 0 : target_idx[row_idx]; }
  /// Edge of a row; 0 without the column, -1 where its cell is blank.
  int edge(int row_idx) const { return edge_idx.empty() ? 0 : edge_idx[row_idx]; }
  bool test(int row_idx) const { return !is_test.empty() && is_test[row_idx]; }
};

}  // namespace dhcal

#endif  // DHCAL_CORE_MODEL_RECORDING_H_
