// SPDX-License-Identifier: Apache-2.0
// The launch as Python sees it while it runs.
#pragma once

#include <string>

#include "launcher/python/interpreter/python_runtime.hpp"
#include "launcher/python/python_entities.hpp"
#include "launcher/substitution/scope.hpp"

namespace launch {

class LaunchContext;

class PythonHost : public python::Host {
 public:
  // While a file is loaded or a substitution performed: what needs a visit throws.
  PythonHost(PythonFile& file, Scope& scope) : file_(file), scope_(scope) {}
  PythonHost(PythonFile& file, LaunchContext& context);

  Variables& configurations() override { return scope_.configurations; }
  Variables& environment() override { return scope_.environment.own(); }
  std::string log_directory() override { return scope_.log_directory; }
  std::string perform(const python::Text& text) override;
  std::string perform(const python::Text& text, Variables& configurations) override;
  void message(const std::string& level, const std::string& logger, const std::string& text) override;
  void push(bool environment) override;
  void pop(bool environment) override;
  void visit(const std::vector<python::Entity>& entities) override;
  void run_coroutine(python::ObjectPtr object) override;

 private:
  LaunchContext& context();

  PythonFile& file_;
  Scope& scope_;
  LaunchContext* context_ = nullptr;
};

}  // namespace launch
