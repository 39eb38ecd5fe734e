#include "tests/support/permissions.h"

#include <stdexcept>

#include <sys/prctl.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace evenglow::tests {
namespace {

constexpr unsigned kPowers = (1u << CAP_DAC_OVERRIDE) | (1u << CAP_DAC_READ_SEARCH);

void set(const std::array<__user_cap_data_struct, 2>& powers) {
  __user_cap_header_struct header{_LINUX_CAPABILITY_VERSION_3, 0};
  if (::syscall(SYS_capset, &header, powers.data()) != 0) throw std::runtime_error("cannot set capabilities");
}

}  // namespace

ObeyingPermissions::ObeyingPermissions() {
  __user_cap_header_struct header{_LINUX_CAPABILITY_VERSION_3, 0};
  if (::syscall(SYS_capget, &header, before_.data()) != 0) throw std::runtime_error("cannot get capabilities");
  auto without = before_;
  without[0].effective &= ~kPowers;
  set(without);
}

ObeyingPermissions::~ObeyingPermissions() {
  set(before_);
}

void obey_permissions_after_exec() {
  ::prctl(PR_CAPBSET_DROP, CAP_DAC_OVERRIDE, 0, 0, 0);
  ::prctl(PR_CAPBSET_DROP, CAP_DAC_READ_SEARCH, 0, 0, 0);
}

}  // namespace evenglow::tests
