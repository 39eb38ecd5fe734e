#pragma once

#include <array>

#include <linux/capability.h>

namespace evenglow::tests {

/// While it lives, the calling thread must keep to the permissions of files even if root runs the tests.
class ObeyingPermissions {
 public:
  ObeyingPermissions();
  ~ObeyingPermissions();
  ObeyingPermissions(const ObeyingPermissions&) = delete;
  ObeyingPermissions& operator=(const ObeyingPermissions&) = delete;

 private:
  std::array<__user_cap_data_struct, 2> before_{};
};

/// For a child before it becomes another program: that one must keep to permissions too. Nothing changes for others
/// than root.
void obey_permissions_after_exec();

}  // namespace evenglow::tests
