// SPDX-License-Identifier: Apache-2.0
// A trace as one HTML page that needs nothing else, no server and no network, and what the page consists of.
#pragma once

#include <string>
#include <string_view>

#include "tracing/model/timeline/traced_system.hpp"
#include "tracing/show/page/column_buffer.hpp"

namespace tracing {

// `write` gets the page, part by part.
void write_html_page(const TracedSystem& system, const WriteText& write);
std::string html_page(const TracedSystem& system);

// The page without data. A comment /*facts*/ and a comment /*columns*/ stand where they belong, and a comment
// <!--before--> where those of a run belong with which this one is compared.
extern const std::string_view kPageTemplate;

// Puts a text in the place of a comment.
void fill_place(std::string& page, std::string_view comment, const std::string& text);

// JSON that may stand in an HTML element `script`: no text in it ends the element, or begins a comment.
std::string script_text(std::string json);

// What the page says once: objects, counts, losses, results. JSON that may stand in an HTML element `script`. Times
// count from the timeline's begin.
std::string page_facts(const TracedSystem& system);

// Instances, messages and states of threads as columns of numbers, compressed, as text. script/data.js reads them in
// the same order.
void write_page_columns(const timeline::Timeline& timeline, const WriteText& write);
std::string page_columns(const timeline::Timeline& timeline);

}  // namespace tracing
