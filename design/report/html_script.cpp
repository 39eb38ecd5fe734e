#include "design/report/html_script.h"

#include "design/report/html_page.h"

namespace evenglow::design {
namespace {

constexpr std::string_view kBase = R"js((function () {
'use strict';
var data = JSON.parse(document.getElementById('data').textContent);
function all(selector, act) { Array.prototype.forEach.call(document.querySelectorAll(selector), act); }
function digits(value) { return value === null || value === undefined ? 'no value' : String(Number(value.toPrecision(4))); }
function measured(value, error) {
  if (value === null || value === undefined) { return 'no value'; }
  if (!(error > 0)) { return digits(value); }
  var decimals = Math.min(8, Math.max(0, 1 - Math.floor(Math.log10(error))));
  return value.toFixed(decimals) + ' \u00b1 ' + error.toFixed(decimals);
}
var palettes = {};
Object.keys(data.colors).forEach(function (name) {
  var hex = data.colors[name];
  palettes[name] = [];
  for (var i = 0; i < hex.length; i += 6) { palettes[name].push(parseInt(hex.substr(i, 6), 16)); }
});
function color(palette, share) {
  return palette[Math.round(255 * Math.min(1, Math.max(0, share)))];
}
function extent(values) {
  var low = Infinity, high = -Infinity;
  values.forEach(function (v) { if (v !== null) { low = Math.min(low, v); high = Math.max(high, v); } });
  if (low > high) { return [0, 1]; }
  if (high - low > 1e-6 * Math.max(Math.abs(low), Math.abs(high))) { return [low, high]; }
  return [low - 0.05 * Math.abs(low) - 0.05, high + 0.05 * Math.abs(high) + 0.05];
}
function paint(image, at, rgb) {
  image.data[at] = rgb >> 16; image.data[at + 1] = rgb >> 8 & 255; image.data[at + 2] = rgb & 255; image.data[at + 3] = 255;
}
function bar(figure, palette, scale, unit) {
  var box = figure.querySelector('.bar'), stops = [];
  for (var i = 0; i <= 16; ++i) { stops.push('#' + ('00000' + color(palette, i / 16).toString(16)).slice(-6)); }
  box.children[0].textContent = digits(scale[0]);
  box.children[1].style.background = 'linear-gradient(to right,' + stops.join(',') + ')';
  box.children[2].textContent = digits(scale[1]) + (unit ? ' ' + unit : '');
}
function follow(target, figure, tell) {
  var read = figure.querySelector('.read'), hint = read.textContent;
  target.addEventListener('pointermove', function (event) {
    var box = target.getBoundingClientRect();
    read.textContent = tell((event.clientX - box.left) / box.width, (event.clientY - box.top) / box.height) || hint;
  });
  target.addEventListener('pointerleave', function () { tell(-1, -1); read.textContent = hint; });
}

)js";

constexpr std::string_view kEnd = R"js(
window.addEventListener('beforeprint', function () { all('details', function (part) { part.open = true; }); });
}());
)js";

}  // namespace

std::string page_script() {
  std::string script(kBase);
  for (const std::string_view part : {map_script(), section_script(), direction_script(), curve_script(), kEnd})
    script += part;
  return script;
}

}  // namespace evenglow::design
