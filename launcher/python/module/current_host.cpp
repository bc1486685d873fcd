// SPDX-License-Identifier: Apache-2.0
#include "launcher/python/module/current_host.hpp"

#include <stdexcept>
#include <vector>

namespace py = pybind11;

namespace launch::python {

namespace {

Host*& current() {
  static Host* host = nullptr;
  return host;
}

std::vector<std::exception_ptr>& failures() {
  static auto* const list = new std::vector<std::exception_ptr>;
  return *list;
}

}  // namespace

bool host_is_there() {
  return current() != nullptr;
}

Host& host() {
  if (current() == nullptr) {
    throw std::runtime_error("no launch is running here");
  }
  return *current();
}

void throw_host_failure(const std::exception& error) {
  failures().push_back(std::current_exception());
  const py::object failure = py::module_::import("launch.substitutions").attr("SubstitutionFailure")(error.what());
  failure.attr("_number") = failures().size() - 1;
  PyErr_SetObject(py::type::of(failure).ptr(), failure.ptr());
  throw py::error_already_set();
}

CurrentHost::CurrentHost(Host& host) : outer_(current()) {
  current() = &host;
}

CurrentHost::~CurrentHost() {
  current() = outer_;
  if (outer_ == nullptr) {
    failures().clear();
  }
}

std::exception_ptr host_failure(std::size_t number) {
  return number < failures().size() ? failures()[number] : nullptr;
}

}  // namespace launch::python
