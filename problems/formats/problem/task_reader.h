// Reads the section `task` of a problem file.
#ifndef DHCAL_PROBLEMS_FORMATS_PROBLEM_TASK_READER_H_
#define DHCAL_PROBLEMS_FORMATS_PROBLEM_TASK_READER_H_

#include "core/io/yaml_value.h"
#include "core/model/robot.h"
#include "core/model/task.h"
#include "problems/formats/problem/simulation_reader.h"

namespace dhcal {

/// `{box_m: [[x, y, z], [x, y, z]]}` or `{poses: file.csv}`; the file's joint columns are read.
void ReadTask(const YamlValue& value,
              const RobotModel& robot,
              const PathResolver& resolve_path,
              TaskSpec* task);

}  // namespace dhcal

#endif  // DHCAL_PROBLEMS_FORMATS_PROBLEM_TASK_READER_H_
