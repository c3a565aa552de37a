// The log of a program: for its developers, not for its users.
#ifndef DHCAL_CORE_BASE_QUIET_LOG_H_
#define DHCAL_CORE_BASE_QUIET_LOG_H_

#include <glog/logging.h>

namespace dhcal {

/// Nothing is logged, unless the environment asks for it (GLOG_v=1), and then to stderr: what users
/// must know is in reports and errors.
inline void StartQuietLog(const char* program) {
  google::InitGoogleLogging(program);
  FLAGS_logtostderr = true;
  FLAGS_minloglevel = FLAGS_v > 0 ? google::GLOG_INFO : google::GLOG_FATAL;
}

}  // namespace dhcal

#endif  // DHCAL_CORE_BASE_QUIET_LOG_H_
