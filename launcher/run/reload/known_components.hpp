// SPDX-License-Identifier: Apache-2.0
// The components and the transitions that a launch file asks for, from one reading to the next.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "launcher/ros/ros_tasks.hpp"
#include "launcher/run/reload/reload_report.hpp"
#include "launcher/visit/requests.hpp"

namespace launch {

class KnownComponents {
 public:
  // The tasks must outlive this object; they are not used before take_over().
  explicit KnownComponents(RosTasks& tasks) : tasks_(tasks) {}

  // The file asks for these, too.
  void note(const Requests& requests);
  // Adds to the report what another reading asks for.
  void compare(const Requests& requests, ReloadReport& report) const;
  // Unloads what is gone, loads what is new, and does both with what has changed. Takes the loads and transitions.
  // `loads_anew` tells whether the process of a container, by its full name, ends or starts again: all that it holds is
  // gone then.
  void take_over(Requests& requests, const std::function<bool(const std::string& container)>& loads_anew);

 private:
  struct Component {
    std::string container;  // full name
    std::string identity;
    std::string text;
    ComposableNode node;
    Environment environment;
    SourceRange origin;
  };
  static std::vector<Component> components_of(const Requests& requests);

  RosTasks& tasks_;
  std::vector<Component> components_;
  std::vector<TransitionRequest> transitions_;
};

}  // namespace launch
