// SPDX-License-Identifier: Apache-2.0
// The plain data of the interface with Python (python_runtime.hpp) as JSON. launch/_script/_values.py is the other
// side.
#pragma once

#include <cstdint>
#include <functional>
#include <nlohmann/json.hpp>
#include <vector>

#include "launcher/python/interpreter/python_runtime.hpp"

namespace launch {

// Makes the object that stands for the Python object of this number.
using MakeScriptObject = std::function<python::ObjectPtr(std::int64_t)>;

// These throw nlohmann::json::exception for what the other side never writes.
python::Place read_place(const nlohmann::json& place);
python::Text read_text(const nlohmann::json& text, const MakeScriptObject& make_object);
std::vector<python::Entity> read_entities(const nlohmann::json& entities, const MakeScriptObject& make_object);

nlohmann::json write_place(const python::Place& place);
nlohmann::json write_element(const python::Element& element);
nlohmann::json write_arguments(const std::vector<python::Argument>& arguments);

}  // namespace launch
