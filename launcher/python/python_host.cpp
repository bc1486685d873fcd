// SPDX-License-Identifier: Apache-2.0
#include "launcher/python/python_host.hpp"

#include <fmt/format.h>

#include <map>
#include <stdexcept>
#include <utility>

#include "launcher/visit/launch_context.hpp"

namespace launch {

PythonHost::PythonHost(PythonFile& file, LaunchContext& context)
    : file_(file), scope_(context.scope()), context_(&context) {}

std::string PythonHost::perform(const python::Text& text) {
  return file_.make_template(text, file_.range({})).perform(scope_);
}

std::string PythonHost::perform(const python::Text& text, Variables& configurations) {
  std::swap(scope_.configurations, configurations);
  try {
    std::string performed = perform(text);
    std::swap(scope_.configurations, configurations);
    return performed;
  } catch (...) {
    std::swap(scope_.configurations, configurations);
    throw;
  }
}

void PythonHost::message(const std::string& level, const std::string& logger, const std::string& text) {
  static const std::map<std::string, LogLevel> levels = {{"debug", LogLevel::kDebug},
                                                         {"info", LogLevel::kInfo},
                                                         {"warning", LogLevel::kWarning},
                                                         {"error", LogLevel::kError},
                                                         {"critical", LogLevel::kCritical}};
  if (context_ != nullptr) {
    context_->message(levels.at(level), logger, text);
  } else {
    fmt::print(stderr, "[{}]: {}\n", logger, text);
  }
}

LaunchContext& PythonHost::context() {
  if (context_ == nullptr) {
    throw std::runtime_error("this can only be done while the launch file is visited");
  }
  return *context_;
}

void PythonHost::visit(const std::vector<python::Entity>& entities) {
  context().visit(file_.make_actions(entities));
}

void PythonHost::run_coroutine(python::ObjectPtr object) {
  context().requests().coroutines.push_back({std::move(object), file_.shared_from_this(), file_.range({})});
}

void PythonHost::push(bool environment) {
  context().kept_scopes(environment).push_back(scope_);
}

void PythonHost::pop(bool environment) {
  std::vector<Scope>& kept = context().kept_scopes(environment);
  if (kept.empty()) {
    throw std::runtime_error("nothing was pushed that could be popped");
  }
  Scope outer = std::move(kept.back());
  kept.pop_back();
  if (environment) {
    scope_.environment = std::move(outer.environment);
  } else {
    scope_.configurations = std::move(outer.configurations);
    scope_.global_parameters = std::move(outer.global_parameters);
    scope_.global_remaps = std::move(outer.global_remaps);
  }
}

}  // namespace launch
