#pragma once

#include <initializer_list>
#include <string>
#include <string_view>

namespace evenglow::design {

/// A whole page in one file: `title` is plain text, `body` is HTML, `data` is JSON that is safe in a `<script>`
/// element. Its policy forbids every load from outside.
std::string html_page(std::string_view title, std::string_view body, std::string_view data);

/// Parts one after another. They are made in the order in which they are named, which `a + b` would leave open: the
/// data of a page depends on it.
std::string joined(std::initializer_list<std::string> parts);

/// The style sheet: light, dark (as the reader's system asks) and print.
std::string_view page_style();
/// The script: draws maps from the page's data, reads out values under the pointer, links maps and sections.
std::string page_script();

}  // namespace evenglow::design
