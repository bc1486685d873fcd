// SPDX-License-Identifier: Apache-2.0
// A visit that goes on after an error, for `launch check` and `launch graph`. It also visits what conditions leave out,
// on the side: in a copy of the scope, without messages, and the requests are dropped. Inside such a visit nothing left
// out is visited, so that a file that includes itself comes to an end.
#pragma once

#include <functional>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "base/diagnostics/diagnostic.hpp"
#include "launcher/substitution/scope.hpp"
#include "launcher/visit/requests.hpp"

namespace launch {

class Exploration {
 public:
  struct Observer {
    std::function<void(const LaunchError&, bool left_out)> report;
    // Gets the requests of an action that its condition leaves out.
    std::function<void(Requests)> left_out;
    // False: `report` is not told of what would go wrong only in a run, and no function of a Python launch file that a
    // condition leaves out is called.
    bool judges = true;
    // Whether what ROS 2 would do in another way is told, too.
    bool strict_ros2 = false;
    // Whether it is told what included files leave behind.
    bool finds_leaks = false;
  };

  // `scope` is that of the visit, and must outlive this object.
  explicit Exploration(const Scope& scope) : scope_(scope) {}

  // From now on the visit explores.
  void begin(Observer observer) { observer_ = std::move(observer); }
  bool is_on() const { return observer_.report != nullptr; }
  // Whether it judges what a run would do.
  bool judges() const { return observer_.judges; }
  bool finds_leaks() const { return is_on() && observer_.finds_leaks && !in_left_out_; }
  bool is_strict() const { return is_on() && observer_.strict_ros2; }

  // Tells of an error behind which the visit goes on.
  void report(const LaunchError& error) const { observer_.report(error, in_left_out_); }
  // Tells of what would go wrong only when the requests are carried out. Does nothing in a visit that does not explore.
  void remark(Diagnostic diagnostic) const {
    if (is_on() && observer_.judges && !scope_.incomplete && !scope_.command_was_left_out()) {
      report(LaunchError(std::vector<Diagnostic>{std::move(diagnostic)}));
    }
  }
  // The argument has its value from its own default.
  struct DefaultedArgument {
    SourceRange where;
    std::string value;
  };
  void note_default(const std::string& name, const SourceRange& where, const std::string& value) {
    if (is_on() && !in_left_out_) {
      defaulted_.insert_or_assign(name, DefaultedArgument{where, value});
    }
  }
  const DefaultedArgument* defaulted(const std::string& name) const {
    const auto found = defaulted_.find(name);
    return found == defaulted_.end() ? nullptr : &found->second;
  }

  // A file that does nothing but declare arguments: it is included to set them for others.
  void note_settings_file(const std::string& path) { settings_files_.insert(path); }
  bool is_settings_file(const std::string& path) const { return settings_files_.contains(path); }

  // Something that is to be told at the end unless a later action settles it: a parameter file of a scope has a section
  // for one of the nodes. The key is of the place and the matter.
  void postpone(const std::string& key, Diagnostic diagnostic) {
    if (!in_left_out_ && !scope_.incomplete && !scope_.command_was_left_out()) {
      const auto [first, is_new] = postponed_.emplace(key, std::move(diagnostic));
      if (!is_new && !first->second.message.ends_with(kOthers)) {
        first->second.message += kOthers;
      }
    }
  }
  void settle(const std::string& key) { settled_.insert(key); }
  void tell_postponed() const {
    for (const auto& [key, diagnostic] : postponed_) {
      if (!settled_.contains(key)) {
        report(LaunchError(std::vector<Diagnostic>{diagnostic}));
      }
    }
  }
  // Whether a file was not seen before: a file that many nodes read is judged once.
  bool sees_first(const std::string& path) { return seen_files_.emplace(path, in_left_out_).second; }

  // For the visit: an action that its condition leaves out begins and ends.
  bool enters_left_out() { return is_on() && !std::exchange(in_left_out_, true); }
  void leave_left_out() { in_left_out_ = false; }
  void tell_left_out(Requests requests) const {
    if (observer_.left_out) {
      observer_.left_out(std::move(requests));
    }
  }

 private:
  static constexpr const char* kOthers = ", nor for another node that gets it";

  const Scope& scope_;
  Observer observer_;                                  // empty: not exploring
  std::set<std::pair<std::string, bool>> seen_files_;  // path, in what is left out
  std::map<std::string, DefaultedArgument> defaulted_;
  std::set<std::string> settings_files_;
  std::map<std::string, Diagnostic> postponed_;
  std::set<std::string> settled_;
  bool in_left_out_ = false;
};

}  // namespace launch
