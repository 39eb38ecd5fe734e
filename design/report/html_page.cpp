#include "design/report/html_page.h"

#include <fmt/format.h>

#include "design/report/text_escape.h"

namespace evenglow::design {

std::string joined(std::initializer_list<std::string> parts) {
  std::string all;
  for (const std::string& part : parts) all += part;
  return all;
}

std::string html_page(std::string_view title, std::string_view body, std::string_view data) {
  return fmt::format(R"(<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta http-equiv="Content-Security-Policy" content="default-src 'none'; style-src 'unsafe-inline'; script-src 'unsafe-inline'; img-src data:">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta name="color-scheme" content="light dark">
<link rel="icon" href="data:,">
<title>{}</title>
<style>
{}</style>
</head>
<body>
<main>
{}</main>
<script type="application/json" id="data">{}</script>
<script>
{}</script>
</body>
</html>
)",
                     html_escape(title), page_style(), body, data, page_script());
}

}  // namespace evenglow::design
