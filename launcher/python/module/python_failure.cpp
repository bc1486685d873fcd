// SPDX-License-Identifier: Apache-2.0
#include "launcher/python/module/python_failure.hpp"

#include <cstdint>
#include <string>

namespace py = pybind11;

namespace launch::python {

bool& shows_tracebacks() {
  static bool shows = false;
  return shows;
}

void throw_failure(py::error_already_set& error) {
  std::string message;
  std::string help;
  std::string traceback;
  Place where;
  std::exception_ptr cause;
  try {
    const py::object trace = error.trace() ? py::object(error.trace()) : py::none();
    const py::tuple explained =
        py::module_::import("launch._explain").attr("explain")(error.value(), trace, shows_tracebacks());
    message = explained[0].cast<std::string>();
    where = read_place(explained[1]);
    help = explained[2].cast<std::string>();
    traceback = explained[3].cast<std::string>();
    if (!explained[4].is_none()) {
      cause = host_failure(explained[4].cast<std::size_t>());
    }
  } catch (const std::exception& failure) {
    message = std::string("a Python error that can't be explained: ") + error.what();
  }
  throw Error(message, std::move(where), std::move(help), std::move(traceback), std::move(cause));
}

Place read_place(const py::handle& place) {
  if (place.is_none()) {
    return {};
  }
  const auto parts = place.cast<py::tuple>();
  return {parts[0].cast<std::string>(), parts[1].cast<std::uint32_t>(), parts[2].cast<std::uint32_t>(),
          parts[3].cast<std::uint32_t>()};
}

}  // namespace launch::python
