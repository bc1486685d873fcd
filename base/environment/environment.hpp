// SPDX-License-Identifier: Apache-2.0
// The variables of a process's environment.
//
// Copies share their variables until one copy is changed, because a launch keeps the environment of each of its scopes
// and processes, and nearly all of them are alike. Not thread-safe: even two copies must not be used by two threads at
// once.
#pragma once

#include <initializer_list>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>

namespace launch {

class Environment {
 public:
  using Variables = std::map<std::string, std::string>;
  using value_type = Variables::value_type;
  using const_iterator = Variables::const_iterator;

  Environment() = default;
  Environment(Variables variables) : variables_(std::make_shared<Variables>(std::move(variables))) {}
  Environment(std::initializer_list<value_type> variables) : Environment(Variables(variables)) {}

  const Variables& variables() const {
    static const Variables none;
    return variables_ == nullptr ? none : *variables_;
  }
  operator const Variables&() const { return variables(); }

  const_iterator begin() const { return variables().begin(); }
  const_iterator end() const { return variables().end(); }
  const_iterator find(const std::string& name) const { return variables().find(name); }
  bool contains(const std::string& name) const { return variables().contains(name); }
  std::size_t count(const std::string& name) const { return variables().count(name); }
  const std::string& at(const std::string& name) const { return variables().at(name); }
  bool empty() const { return variables().empty(); }
  std::size_t size() const { return variables().size(); }

  std::string& operator[](const std::string& name) { return own()[name]; }
  void insert_or_assign(const std::string& name, std::string value) { own().insert_or_assign(name, std::move(value)); }
  // Adds the variable unless there is one of that name.
  void emplace(const std::string& name, std::string value) {
    if (!contains(name)) {
      own().emplace(name, std::move(value));
    }
  }
  void erase(const std::string& name) {
    if (contains(name)) {
      own().erase(name);
    }
  }

  bool operator==(const Environment& other) const {
    return variables_ == other.variables_ || variables() == other.variables();
  }
  bool operator<(const Environment& other) const {
    return variables_ != other.variables_ && variables() < other.variables();
  }

  // A launch file has said what this variable is, or that there is none, even if it was so before. So it is on another
  // machine, too (launcher/substitution/machine_view.hpp).
  void decide(const std::string& name) {
    decided_ = std::make_shared<std::set<std::string>>(decided());
    decided_->insert(name);
  }
  const std::set<std::string>& decided() const {
    static const std::set<std::string> none;
    return decided_ == nullptr ? none : *decided_;
  }

  // The variables of this environment alone. They must be changed at once: a later copy of this environment would share
  // the changes.
  Variables& own() {
    if (variables_ == nullptr) {
      variables_ = std::make_shared<Variables>();
    } else if (variables_.use_count() > 1) {
      variables_ = std::make_shared<Variables>(*variables_);
    }
    return *variables_;
  }

 private:
  std::shared_ptr<Variables> variables_;
  std::shared_ptr<std::set<std::string>> decided_;
};

}  // namespace launch
