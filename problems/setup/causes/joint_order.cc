// Joint coordinates that stand under another joint's name.
#include <algorithm>
#include <numeric>

#include <fmt/format.h>

#include "problems/setup/cause.h"
#include "problems/setup/words.h"

namespace dhcal {
namespace {

class JointOrderKind : public CauseKind {
 public:
  std::string name() const override { return "joint_order"; }
  void Neighbours(const Files& files,
                  const SetUp& from,
                  std::vector<SetUp>* set_ups) const override {
    for (int i = 0; i < files.num_joints(); ++i) {
      for (int j = i + 1; j < files.num_joints(); ++j) {
        if (files.revolute(i) != files.revolute(j)) continue;
        set_ups->push_back(from);
        auto& joints = set_ups->back().joints;
        std::swap(joints[static_cast<std::size_t>(i)].column,
                  joints[static_cast<std::size_t>(j)].column);
      }
    }
  }
  void FarJumps(const Files& files, const SetUp& from, std::vector<SetUp>* set_ups) const override {
    constexpr int kMostPermuted = 7;  // joints; 5,040 orders
    if (files.num_joints() > kMostPermuted) return;
    std::vector<int> order(static_cast<std::size_t>(files.num_joints()));
    std::iota(order.begin(), order.end(), 0);
    while (std::next_permutation(order.begin(), order.end())) {
      bool same_types = true;
      SetUp set_up = from;
      for (int j = 0; j < files.num_joints(); ++j) {
        const int column = order[static_cast<std::size_t>(j)];
        same_types = same_types && files.revolute(j) == files.revolute(column);
        set_up.joints[static_cast<std::size_t>(j)].column = column;
      }
      if (same_types) set_ups->push_back(set_up);
    }
  }
  int Weight(const SetUp& set_up) const override {
    const int n = static_cast<int>(set_up.joints.size());
    int moved = 0;
    bool reversed = n > 2;
    for (int j = 0; j < n; ++j) {
      const int column = set_up.joints[static_cast<std::size_t>(j)].column;
      moved += column != j ? 1 : 0;
      reversed = reversed && column == n - 1 - j;
    }
    // One wrong order is one cause, but few columns are confused more easily than many.
    if (moved == 0) return 0;
    return moved <= 3 || reversed ? kOneCause : 2 * kOneCause;
  }
  void Undo(const SetUp& set_up, std::vector<SetUp>* set_ups) const override {
    for (std::size_t j = 0; j < set_up.joints.size(); ++j) {
      if (set_up.joints[j].column == static_cast<int>(j)) continue;
      // Gives joint j its own column, and who had it the column that j had.
      set_ups->push_back(set_up);
      auto& joints = set_ups->back().joints;
      for (SetUp::Joint& other : joints) {
        if (other.column == static_cast<int>(j)) other.column = joints[j].column;
      }
      joints[j].column = static_cast<int>(j);
    }
  }
  void Describe(const Files& files,
                const SetUp& set_up,
                std::vector<SetupCause>* causes) const override {
    SetupCause cause;
    cause.kind = name();
    std::string order, columns;
    for (int j = 0; j < files.num_joints(); ++j) {
      const int column = set_up.joints[static_cast<std::size_t>(j)].column;
      order += (order.empty() ? "" : ", ") + std::to_string(column + 1);
      if (column == j) continue;
      cause.joints.push_back(j + 1);
      columns += fmt::format("{}{}: {}",
                             columns.empty() ? "" : ", ",
                             JointColumn(files, j),
                             JointColumn(files, column));
    }
    if (cause.joints.empty()) return;
    cause.sentence =
        fmt::format("the joint columns stand in another order: joints 1 to {} read columns {}",
                    files.num_joints(),
                    order);
    cause.where = files.spec.recording_where;
    cause.text = "columns: {" + columns + "}";
    causes->push_back(cause);
  }
  void Cure(const SetUp& set_up, CuredFiles* files) const override {
    const Eigen::MatrixXd q = files->recording.q;
    for (std::size_t j = 0; j < set_up.joints.size(); ++j) {
      files->recording.q.col(static_cast<Eigen::Index>(j)) = q.col(set_up.joints[j].column);
    }
  }
};

}  // namespace

const CauseKind& JointOrder() {
  static const JointOrderKind kind;
  return kind;
}

}  // namespace dhcal
