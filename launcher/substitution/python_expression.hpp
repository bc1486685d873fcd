// Python expressions, evaluated by a CPython that is loaded when the first one is met.
#pragma once

#include <string>

namespace launch {

// str() of the value of `expression`. `modules` are names separated by commas; the names of "math" are also available
// unqualified. Throws std::runtime_error with one line: Python's error, or what to install when there is no Python.
// Not for several threads at once.
std::string evaluate_python(const std::string& expression, const std::string& modules);

// Where the module liblaunch_python.so is loaded from, instead of ../lib/launch beside the program's directory.
// For programs that are not installed; counts until the first expression.
void use_python_module(std::string path);

// What the module exports: the value, or on failure the error; false on failure.
using PythonEvaluate = bool (*)(const char* expression, const char* modules, std::string* result);
constexpr const char* kPythonEvaluateSymbol = "launch_evaluate_python";

}  // namespace launch
