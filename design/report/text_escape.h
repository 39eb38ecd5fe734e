#pragma once

#include <string>
#include <string_view>

/// Text from run files and command lines, made safe for the place where it will stand.
namespace evenglow::design {

/// Well-formed UTF-8 without control characters (tab and line feed stay): U+FFFD stands for each byte that was not.
std::string clean_utf8(std::string_view text);

/// For the content and the quoted attributes of HTML and SVG: & < > " ' as character references, cleaned as above.
std::string html_escape(std::string_view text);

/// JSON for the content of a `<script>` element: every < and the line separators of old JavaScript become `\u` escapes,
/// so that neither `</script>` nor `<!--` can stand in it. Changes nothing outside of JSON strings, where no < can
/// occur.
std::string script_safe(std::string_view json);

/// A field of a CSV table (RFC 4180): quoted if it holds a comma, a quote or a line break.
std::string csv_field(std::string_view text);

/// In one line: line breaks and tabs become spaces.
std::string one_line(std::string_view text);

}  // namespace evenglow::design
