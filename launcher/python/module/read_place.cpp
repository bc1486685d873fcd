// SPDX-License-Identifier: Apache-2.0
#include "launcher/python/module/read_place.hpp"

#include <cstdint>
#include <string>

namespace py = pybind11;

namespace launch::python {

Place read_place(const py::handle& place) {
  if (place.is_none()) {
    return {};
  }
  const auto parts = place.cast<py::tuple>();
  return {parts[0].cast<std::string>(), parts[1].cast<std::uint32_t>(), parts[2].cast<std::uint32_t>(),
          parts[3].cast<std::uint32_t>()};
}

}  // namespace launch::python
