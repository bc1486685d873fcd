// SPDX-License-Identifier: Apache-2.0
#include "tracing/decode/python_api/loss_object.hpp"

#include <pybind11/stl.h>

#include <cstdint>
#include <optional>
#include <string>

namespace tracing::python {

namespace py = pybind11;

namespace {

struct LossObject {
  std::int64_t time_ns = 0;
  std::optional<std::int64_t> end_ns;
  std::string kind;
  std::optional<std::uint64_t> count;
  std::string stream;
};

}  // namespace

void add_loss_type(py::module_& module) {
  py::class_<LossObject>(module, "Loss", "Events that the tracer could not keep, according to the trace itself.")
      .def_readonly("time_ns", &LossObject::time_ns, "The earliest time at which the loss began")
      .def_readonly("end_ns", &LossObject::end_ns, "The latest time at which it had ended, or None")
      .def_readonly("kind", &LossObject::kind, "'events', or 'packets' with an unknown number of events each")
      .def_readonly("count", &LossObject::count, "How many; None: some, but the number is unknown")
      .def_readonly("stream", &LossObject::stream, "The file of the stream")
      .def("__repr__", [](const LossObject& loss) {
        return "<Loss of " + (loss.count ? std::to_string(*loss.count) : "some") + " " + loss.kind + " at " +
               std::to_string(loss.time_ns) + " ns>";
      });
}

py::object make_loss(const Loss& loss) {
  return py::cast(LossObject{loss.begin_ns.value_or(0), loss.end_ns,
                             loss.kind == Loss::Kind::kEvents ? "events" : "packets", loss.count, loss.stream->name});
}

}  // namespace tracing::python
