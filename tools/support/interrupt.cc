#include "tools/support/interrupt.h"

#include <array>
#include <atomic>
#include <csignal>
#include <list>
#include <unistd.h>

namespace dhcal {
namespace {

// A handler may only call what is safe at any moment: no lock, no allocation. It reads a text that
// never changes; a new one takes its place by one store.
std::atomic<const std::string*> g_words = nullptr;
static_assert(std::atomic<const std::string*>::is_always_lock_free);

constexpr std::array<int, 3> kSignals = {SIGINT, SIGTERM, SIGHUP};

void SayAndEnd(int signal) {
  const std::string* const words = g_words.load();
  if (words != nullptr) {
    // Nothing can be done about a terminal that has gone.
    [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, words->data(), words->size());
  }
  ::signal(signal, SIG_DFL);
  ::raise(signal);
}

}  // namespace

void SayOnInterrupt(const std::string& words) {
  static std::list<std::string> all;  // a handler may still read an earlier one
  all.push_back(words);
  g_words.store(&all.back());
  for (const int signal : kSignals) {
    // Who started the program may have asked that it ignores one (nohup).
    if (::signal(signal, SayAndEnd) == SIG_IGN) ::signal(signal, SIG_IGN);
  }
}

}  // namespace dhcal
