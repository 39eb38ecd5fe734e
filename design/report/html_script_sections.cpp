#include "design/report/html_script.h"

namespace evenglow::design {

std::string_view section_script() {
  return R"js(
function svgNode(name, attributes, parent) {
  var node = document.createElementNS('http://www.w3.org/2000/svg', name);
  Object.keys(attributes).forEach(function (key) { node.setAttribute(key, attributes[key]); });
  if (parent) { parent.appendChild(node); }
  return node;
}
function roundTicks(low, high, wanted) {
  var rough = (high - low) / wanted, power = Math.pow(10, Math.floor(Math.log10(rough))), step = 10 * power, ticks = [];
  [5, 2.5, 2, 1].forEach(function (factor) { if (factor * power >= rough) { step = factor * power; } });
  for (var k = Math.ceil(low / step - 1e-9); k * step <= high + 1e-9 * step; ++k) { ticks.push(Number((k * step).toPrecision(10))); }
  return ticks;
}
var plotBox = {width: 420, height: 216, left: 52, right: 408, top: 30, bottom: 176};

// One chart of the group's maps along a row (alongX) or a column of cells.
function makeChart(parent, alongX) {
  var figure = document.createElement('figure');
  var caption = document.createElement('figcaption');
  parent.appendChild(figure).appendChild(caption);
  var svg = svgNode('svg', {viewBox: '0 0 420 216', role: 'img', 'aria-label': 'section along ' + (alongX ? 'x' : 'y')}, figure);
  var body = svgNode('g', {}, svg), guide = svgNode('line', {class: 'guide', y1: plotBox.top, y2: plotBox.bottom}, svg);
  return {figure: figure, caption: caption, svg: svg, body: body, guide: guide, alongX: alongX};
}
function label(chart, x, y, text, anchor) {
  svgNode('text', {class: 'fi i-muted', x: x, y: y, 'font-size': 12, 'text-anchor': anchor}, chart.body).textContent = text;
}
function valueRange(figures) {
  var values = [];
  figures.forEach(function (figure) { values.push.apply(values, extent(mapOf(figure).v)); });
  var range = extent(values), room = 0.04 * (range[1] - range[0]);
  return [range[0] - room, range[1] + room];
}
function drawChart(chart, figures, inks, ix, iy) {
  var map = mapOf(figures[0]), along = chart.alongX, count = along ? map.nx : map.ny;
  var from = along ? map.x0 : map.y0, length = count * (along ? map.dx : map.dy), range = valueRange(figures);
  function px(place) { return plotBox.left + (place - from) / length * (plotBox.right - plotBox.left); }
  function py(value) { return plotBox.bottom - (value - range[0]) / (range[1] - range[0]) * (plotBox.bottom - plotBox.top); }
  function at(i) { return along ? centerX(map, i) : centerY(map, i); }
  chart.body.textContent = '';
  roundTicks(range[0], range[1], 4).forEach(function (tick) {
    svgNode('line', {class: 'st i-grid', x1: plotBox.left, x2: plotBox.right, y1: py(tick), y2: py(tick)}, chart.body);
    label(chart, plotBox.left - 6, py(tick) + 4, String(tick), 'end');
  });
  roundTicks(from, from + length, 5).forEach(function (tick) { label(chart, px(tick), plotBox.bottom + 16, String(tick), 'middle'); });
  svgNode('line', {class: 'st i-muted', x1: plotBox.left, x2: plotBox.right, y1: plotBox.bottom, y2: plotBox.bottom}, chart.body);
  label(chart, (plotBox.left + plotBox.right) / 2, plotBox.bottom + 34, (along ? 'x' : 'y') + ' (mm)', 'middle');
  label(chart, 0, 14, map.quantity + (map.unit ? ' (' + map.unit + ')' : ''), 'start');
  figures.forEach(function (figure, k) {
    var own = mapOf(figure), upper = [], lower = [], line = '', alone = own.v[along ? iy * map.nx : ix];
    for (var i = 0; i < count; ++i) {
      var cell = along ? iy * map.nx + i : i * map.nx + ix, value = own.v[cell], error = own.s[cell];
      if (value === null) { line += ' '; continue; }
      line += (line === '' || line.slice(-1) === ' ' ? 'M' : 'L') + px(at(i)).toFixed(1) + ',' + py(value).toFixed(1);
      if (error > 0) {
        upper.push(px(at(i)).toFixed(1) + ',' + Math.max(plotBox.top, py(value + error)).toFixed(1));
        lower.unshift(px(at(i)).toFixed(1) + ',' + Math.min(plotBox.bottom, py(value - error)).toFixed(1));
      }
    }
    if (upper.length > 1) { svgNode('polygon', {class: 'band ' + inks[k], points: upper.concat(lower).join(' ')}, chart.body); }
    if (count === 1 && alone !== null) { line = 'M' + plotBox.left + ',' + py(alone).toFixed(1) + 'H' + plotBox.right; }
    svgNode('path', {class: 'st ' + inks[k], 'stroke-width': 1.7, d: line}, chart.body);
  });
  chart.guide.setAttribute('x1', px(at(along ? ix : iy)));
  chart.guide.setAttribute('x2', px(at(along ? ix : iy)));
  chart.caption.textContent = along ? 'Along x at y ' + digits(centerY(map, iy)) + ' mm' : 'Along y at x ' + digits(centerX(map, ix)) + ' mm';
}
function makeSections(cut, group) {
  var charts = [makeChart(cut, true), makeChart(cut, false)], read = document.createElement('output'), shown = null;
  read.className = 'read cutread';
  cut.appendChild(read);
  group.tell = function (figure, ix, iy) {
    var map = mapOf(figure), inks = [], parts = [];
    var figures = group.figures.filter(function (other) {
      var seen = mapOf(other);
      return seen.quantity === map.quantity && seen.nx === map.nx && seen.ny === map.ny;
    });
    figures.forEach(function (other, k) {
      var series = mapOf(other).series;
      inks.push('i-s' + ((series < 0 ? k : series) % 6 + 1));
      parts.push([inks[k], mapOf(other).name + ' ' + valueText(mapOf(other), ix, iy)]);
    });
    shown = [figure, ix, iy];
    charts.forEach(function (chart) { drawChart(chart, figures, inks, ix, iy); });
    read.textContent = placeText(map, ix, iy);
    parts.forEach(function (part) {
      var key = document.createElement('span');
      key.className = 'key ' + part[0];
      key.appendChild(document.createElement('i'));
      key.appendChild(document.createTextNode(part[1] + (map.unit ? ' ' + map.unit : '')));
      read.appendChild(key);
    });
    cut.dataset.cell = ix + ',' + iy;
  };
  charts.forEach(function (chart) {
    function cellAt(event) {
      var place = chart.svg.getBoundingClientRect(), map = mapOf(shown[0]), count = chart.alongX ? map.nx : map.ny;
      var x = (event.clientX - place.left) / place.width * plotBox.width;
      return clampTo((x - plotBox.left) / (plotBox.right - plotBox.left) * count, count);
    }
    function move(event, act) { act(shown[0], chart.alongX ? cellAt(event) : shown[1], chart.alongX ? shown[2] : cellAt(event)); }
    chart.svg.addEventListener('pointermove', function (event) { move(event, group.show); });
    chart.svg.addEventListener('click', function (event) { move(event, group.choose); });
    chart.svg.addEventListener('pointerleave', group.rest);
  });
}
all('.cut', function (cut) {
  var group = makeGroup(document.getElementById(cut.dataset.cut));
  if (!group) { return; }
  makeSections(cut, group);
  group.figures.forEach(function (figure) { watchMap(figure, group); });
  var map = mapOf(group.figures[0]);
  group.choose(group.figures[0], Math.floor(map.nx / 2), Math.floor(map.ny / 2));
});
all('figure.map', function (figure) { if (!figure.parentNode.id) { watchMap(figure, null); } });
)js";
}

}  // namespace evenglow::design
