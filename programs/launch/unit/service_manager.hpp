// SPDX-License-Identifier: Apache-2.0
// A service manager of systemd, that of the system or that of a user: where its units are, and systemctl(1) for it.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace launch {

class SystemdManager {
 public:
  // `user`: that of this user, as it always is without root's rights.
  explicit SystemdManager(bool user);

  bool is_of_user() const { return of_user_; }
  std::filesystem::path directory() const;
  std::filesystem::path path_of(const std::string& unit) const;
  // What `systemctl enable` makes.
  std::filesystem::path link_of(const std::string& unit) const;
  bool runs() const;
  // Only then does the service manager of a user start with the machine, and not with the first login.
  bool lingers() const;

  // `systemctl WORDS`. Throws std::runtime_error when it fails, after it has said why.
  void tell(const std::vector<std::string>& words) const;
  // What `systemctl enable` does, which for a user wants a service manager that runs.
  void enable_later(const std::string& unit) const;
  std::map<std::string, std::string> properties_of(const std::string& unit) const;

 private:
  std::vector<std::string> systemctl(std::vector<std::string> words) const;

  bool of_user_;
};

}  // namespace launch
