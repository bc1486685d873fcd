// SPDX-License-Identifier: Apache-2.0
#include <dlfcn.h>

#include <string>

#include "message_plan.hpp"
#include "rosidl_runtime_c/message_type_support_struct.h"
#include "rosidl_typesupport_c/python.hpp"

// The extension module rosidl_generator_py._type_support: what the classes of messages give rclpy.
namespace rosidl_generator_py {
namespace {

// rclpy calls these two by the pointers in capsules.
bool convert_from_python(PyObject* object, void* message) {
  const MessagePlan* plan = plan_of(Py_TYPE(object));
  return plan != nullptr && from_python(*plan, object, message);
}

void* convert_to_python(const Layout& layout, void* message) {
  const MessagePlan* plan = plan_of(layout);
  return plan != nullptr ? to_python(*plan, message) : nullptr;
}

// A capsule holds pointers to data. Those to functions are no different on systems of POSIX.
template <typename Function>
PyObject* capsule(Function* pointer) {
  return PyCapsule_New(const_cast<void*>(reinterpret_cast<const void*>(pointer)), nullptr, nullptr);
}

// Calls the function that returns the handle of an interface. `kind` is message, service or action. Libraries stay
// loaded.
const void* handle_of(const char* library, const char* kind, const char* interface) {
  void* loaded = dlopen(library, RTLD_LAZY | RTLD_LOCAL);
  if (loaded == nullptr) {
    PyErr_Format(PyExc_ImportError, "%s", dlerror());
    return nullptr;
  }
  const std::string symbol = std::string("rosidl_typesupport_c__get_") + kind + "_type_support_handle__" + interface;
  void* function = dlsym(loaded, symbol.c_str());
  if (function == nullptr) {
    PyErr_Format(PyExc_ImportError, "%s: no function %s", library, symbol.c_str());
    return nullptr;
  }
  return reinterpret_cast<const void* (*)()>(function)();
}

PyObject* message(PyObject* /*module*/, PyObject* arguments) {
  const char* library = nullptr;
  const char* interface = nullptr;
  if (PyArg_ParseTuple(arguments, "ss", &library, &interface) == 0) {
    return nullptr;
  }
  const auto* handle = static_cast<const rosidl_message_type_support_t*>(handle_of(library, "message", interface));
  if (handle == nullptr) {
    return nullptr;
  }
  const auto& support = rosidl_typesupport_c::message_support(*handle);
  if (plan_of(*support.layout) == nullptr) {
    return nullptr;
  }
  return Py_BuildValue("(NNNNN)", capsule(support.callbacks.create_message), capsule(convert_from_python),
                       capsule(support.to_python), capsule(support.callbacks.destroy_message), capsule(handle));
}

PyObject* interface(PyObject* /*module*/, PyObject* arguments) {
  const char* library = nullptr;
  const char* kind = nullptr;
  const char* name = nullptr;
  if (PyArg_ParseTuple(arguments, "sss", &library, &kind, &name) == 0) {
    return nullptr;
  }
  const void* handle = handle_of(library, kind, name);
  return handle != nullptr ? capsule(handle) : nullptr;
}

PyMethodDef functions[] = {
    {"message", message, METH_VARARGS,
     "message(library, name): the capsules create, convert from Python, convert to Python, destroy and type support of "
     "the "
     "message std_msgs__msg__String in the library for C of its package"},
    {"interface", interface, METH_VARARGS,
     "interface(library, kind, name): the capsule of the type support of a service or an action"},
    {nullptr, nullptr, 0, nullptr}};

PyModuleDef definition = {PyModuleDef_HEAD_INIT,
                          "_type_support",
                          "Type supports of messages, and conversions to and from objects of Python",
                          -1,
                          functions,
                          nullptr,
                          nullptr,
                          nullptr,
                          nullptr};

}  // namespace
}  // namespace rosidl_generator_py

PyMODINIT_FUNC PyInit__type_support() {
  rosidl_typesupport_c::set_to_python(rosidl_generator_py::convert_to_python);
  return PyModule_Create(&rosidl_generator_py::definition);
}
