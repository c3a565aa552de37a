// What Ctrl-C says before it ends the program.
#ifndef DHCAL_TOOLS_SUPPORT_INTERRUPT_H_
#define DHCAL_TOOLS_SUPPORT_INTERRUPT_H_

#include <string>

namespace dhcal {

/// From now on SIGINT, SIGTERM and SIGHUP print `words` to stderr and then end the program as they
/// would have; "" = silently. What is written when they come is whole or not there
/// (core/io/folder_swap.h), so there is nothing to undo.
void SayOnInterrupt(const std::string& words);

}  // namespace dhcal

#endif  // DHCAL_TOOLS_SUPPORT_INTERRUPT_H_
