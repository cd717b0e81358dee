#include "interruption.h"

#include <signal.h>

#include <array>

namespace isolux {
namespace {

constexpr std::array kSignals = {SIGINT, SIGTERM};
volatile sig_atomic_t flag = 0;

void handle(void (*handler)(int)) {
  struct sigaction action = {};
  action.sa_handler = handler;
  action.sa_flags = SA_RESTART | static_cast<int>(SA_RESETHAND);
  for (const int signal : kSignals) sigaction(signal, &action, nullptr);
}

}  // namespace

Interruption::Interruption() {
  flag = 0;
  handle([](int) { flag = 1; });
}

Interruption::~Interruption() { handle(SIG_DFL); }

bool Interruption::requested() const { return flag != 0; }

void Interruption::ignore() { handle(SIG_IGN); }

}  // namespace isolux
