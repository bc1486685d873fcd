// SPDX-License-Identifier: Apache-2.0
// The module `_launch_engine`: gives the Python package `launch` access to the launch that called Python.
#include <pybind11/embed.h>
#include <pybind11/stl.h>

#include <optional>
#include <string>
#include <vector>

#include "launcher/python/module/current_host.hpp"
#include "launcher/python/module/entity_reader.hpp"

namespace py = pybind11;

namespace launch::python {

namespace {

std::string perform(const py::object& value, const std::optional<py::dict>& configurations) {
  const Text text = guarded([&] { return read_text(value); });
  if (!configurations) {
    return guarded([&] { return host().perform(text); });
  }
  Host::Variables variables;
  for (const auto& [name, content] : *configurations) {
    variables.emplace(py::str(name).cast<std::string>(), py::str(content).cast<std::string>());
  }
  return guarded([&] { return host().perform(text, variables); });
}

void visit(const py::object& entities) {
  guarded([&] { host().visit(read_entities(entities)); });
}

Host::Variables& variables(bool environment) {
  return environment ? host().environment() : host().configurations();
}

}  // namespace

}  // namespace launch::python

// NOLINTNEXTLINE: the macro of pybind11
PYBIND11_EMBEDDED_MODULE(_launch_engine, module) {
  using launch::python::host;
  using launch::python::variables;

  module.def("is_running", [] { return launch::python::host_is_there(); });
  module.def("perform", launch::python::perform, py::arg("value"), py::arg("configurations") = py::none());
  module.def("get", [](bool environment, const std::string& name) -> std::optional<std::string> {
    const auto found = variables(environment).find(name);
    return found == variables(environment).end() ? std::nullopt : std::optional(found->second);
  });
  module.def("set", [](bool environment, const std::string& name, const std::string& value) {
    variables(environment).insert_or_assign(name, value);
  });
  module.def("erase", [](bool environment, const std::string& name) { variables(environment).erase(name); });
  module.def("names", [](bool environment) {
    std::vector<std::string> names;
    for (const auto& [name, value] : variables(environment)) {
      names.push_back(name);
    }
    return names;
  });
  module.def("log_directory", [] { return host().log_directory(); });
  module.def("message", [](const std::string& level, const std::string& logger, const std::string& text) {
    host().message(level, logger, text);
  });
  module.def("visit", launch::python::visit);
  module.def("run_coroutine",
             [](py::object object) { host().run_coroutine(launch::python::make_object(std::move(object))); });
  module.def("push", [](bool environment) { host().push(environment); });
  module.def("pop", [](bool environment) { host().pop(environment); });
}
