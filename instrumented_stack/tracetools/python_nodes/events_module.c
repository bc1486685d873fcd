// SPDX-License-Identifier: Apache-2.0
// The module _launch_rclpy_events: calls the tracetools that the process has loaded. It loads none. It keeps to
// Python's stable interface, so that one file serves every Python from 3.10 on. All functions need Python's lock, as
// usual.
#define Py_LIMITED_API 0x030A0000
#include <Python.h>
#include <dlfcn.h>
#include <stdbool.h>

typedef void (*Pointers)(const void*, const void*);

// Null: the version of tracetools has no such function.
static struct {
  Pointers subscription_init;
  Pointers subscription_callback_added;
  Pointers service_callback_added;
  Pointers timer_callback_added;
  Pointers timer_link_node;
  void (*callback_register)(const void*, const char*);
  void (*callback_start)(const void*, bool);
  void (*callback_end)(const void*);
} tracetools;

// A node has loaded the library for its own use, so its functions are perhaps not visible to all.
static void* find_function(void* library, const char* name) {
  void* const visible = dlsym(RTLD_DEFAULT, name);
  return visible != NULL || library == NULL ? visible : dlsym(library, name);
}

static PyObject* find(PyObject* module, PyObject* ignored) {
  (void)module;
  (void)ignored;
  if (tracetools.callback_end == NULL) {
    // It stays open: the functions are called until the process ends.
    void* const library = dlopen("libtracetools.so", RTLD_NOW | RTLD_NOLOAD);
#define FIND(member, name) *(void**)&tracetools.member = find_function(library, "ros_trace_" name)
    FIND(subscription_init, "rclcpp_subscription_init");
    FIND(subscription_callback_added, "rclcpp_subscription_callback_added");
    FIND(service_callback_added, "rclcpp_service_callback_added");
    FIND(timer_callback_added, "rclcpp_timer_callback_added");
    FIND(timer_link_node, "rclcpp_timer_link_node");
    FIND(callback_register, "rclcpp_callback_register");
    FIND(callback_start, "callback_start");
    FIND(callback_end, "callback_end");
#undef FIND
  }
  return PyBool_FromLong(tracetools.callback_end != NULL);
}

static PyObject* call_with_pointers(Pointers function, PyObject* arguments) {
  unsigned long long first = 0;
  unsigned long long second = 0;
  if (!PyArg_ParseTuple(arguments, "KK", &first, &second)) {
    return NULL;
  }
  if (function != NULL) {
    function((const void*)(uintptr_t)first, (const void*)(uintptr_t)second);
  }
  Py_RETURN_NONE;
}

#define TWO_POINTERS(name)                                       \
  static PyObject* name(PyObject* module, PyObject* arguments) { \
    (void)module;                                                \
    return call_with_pointers(tracetools.name, arguments);       \
  }
TWO_POINTERS(subscription_init)
TWO_POINTERS(subscription_callback_added)
TWO_POINTERS(service_callback_added)
TWO_POINTERS(timer_callback_added)
TWO_POINTERS(timer_link_node)

static PyObject* callback_register(PyObject* module, PyObject* arguments) {
  (void)module;
  unsigned long long callback = 0;
  const char* symbol = NULL;
  if (!PyArg_ParseTuple(arguments, "Ks", &callback, &symbol)) {
    return NULL;
  }
  if (tracetools.callback_register != NULL) {
    tracetools.callback_register((const void*)(uintptr_t)callback, symbol);
  }
  Py_RETURN_NONE;
}

static PyObject* callback_start(PyObject* module, PyObject* number) {
  (void)module;
  void* const callback = PyLong_AsVoidPtr(number);
  if (callback == NULL && PyErr_Occurred() != NULL) {
    return NULL;
  }
  if (tracetools.callback_start != NULL) {
    tracetools.callback_start(callback, false);
  }
  Py_RETURN_NONE;
}

static PyObject* callback_end(PyObject* module, PyObject* number) {
  (void)module;
  void* const callback = PyLong_AsVoidPtr(number);
  if (callback == NULL && PyErr_Occurred() != NULL) {
    return NULL;
  }
  if (tracetools.callback_end != NULL) {
    tracetools.callback_end(callback);
  }
  Py_RETURN_NONE;
}

static PyMethodDef functions[] = {
    {"find", find, METH_NOARGS, "Whether the process has loaded a tracetools."},
    {"subscription_init", subscription_init, METH_VARARGS, "(handle of rcl, subscription)"},
    {"subscription_callback_added", subscription_callback_added, METH_VARARGS, "(subscription, callback)"},
    {"service_callback_added", service_callback_added, METH_VARARGS, "(handle of rcl, callback)"},
    {"timer_callback_added", timer_callback_added, METH_VARARGS, "(handle of rcl, callback)"},
    {"timer_link_node", timer_link_node, METH_VARARGS, "(handle of rcl, handle of the node)"},
    {"callback_register", callback_register, METH_VARARGS, "(callback, symbol)"},
    {"callback_start", callback_start, METH_O, "(callback)"},
    {"callback_end", callback_end, METH_O, "(callback)"},
    {NULL, NULL, 0, NULL}};

static struct PyModuleDef definition = {
    PyModuleDef_HEAD_INIT, "_launch_rclpy_events", NULL, -1, functions, NULL, NULL, NULL, NULL};

PyMODINIT_FUNC PyInit__launch_rclpy_events(void) {
  return PyModule_Create(&definition);
}
