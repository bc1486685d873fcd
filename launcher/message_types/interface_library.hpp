// SPDX-License-Identifier: Apache-2.0
// Finds interfaces by name in the packages of AMENT_PREFIX_PATH: PREFIX/share/PACKAGE/{msg,srv,action}/Name.*. The
// extension is that of the folder, or .idl if there is no such file.
//
// No library of the packages is loaded. A name is "std_msgs/msg/String" or, for a message, "std_msgs/String". The
// messages that ROS 2 makes of a service or an action have their usual names ("AddTwoInts_Request",
// "AddTwoInts_Event", "Fibonacci_SendGoal_Response", "Fibonacci_FeedbackMessage").
#pragma once

#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "base/environment/environment.hpp"
#include "launcher/message_types/interface_type.hpp"
#include "launcher/substitution/package_index.hpp"

namespace launch {

class InterfaceLibrary {
 public:
  InterfaceLibrary(PackageIndex packages, Environment environment);

  // Throw LaunchError without a place if there is no such interface (its help names what may be meant), and with the
  // place in its file if the file has an error.
  std::shared_ptr<const MessageType> message(const std::string& name);
  ServiceType service(const std::string& name);
  // One of the services of an action: `part` is "SendGoal" or "GetResult".
  ServiceType action_service(const std::string& action, const std::string& part);

  // The path of the file of an interface, for instance of "std_msgs/srv/Empty". Throws as message() does.
  std::string file_of(const std::string& name);

  // Full names of what is installed, sorted. `kind` is "msg", "srv" or "action".
  std::vector<std::string> names(const std::string& kind) const;
  std::vector<std::string> names_of_package(const std::string& package, const std::string& kind) const;

 private:
  void load(const std::string& package, const std::string& kind, const std::string& name);
  // The message of service introspection, of the service with this full name.
  std::shared_ptr<const MessageType> event_of(const std::string& service);

  mutable PackageIndex packages_;
  Environment environment_;
  std::map<std::string, std::shared_ptr<const MessageType>, std::less<>> messages_;
  std::vector<std::string> loading_;
};

}  // namespace launch
