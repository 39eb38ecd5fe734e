#include "design/report/html_page.h"

namespace evenglow::design {

std::string_view page_script() {
  return R"js((function () {
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

function drawMap(figure, own) {
  var map = data[figure.dataset.map], canvas = figure.querySelector('canvas');
  var scale = own ? extent(map.v) : map.scale, palette = palettes[map.colors];
  var context = canvas.getContext('2d'), image = context.createImageData(map.nx, map.ny);
  map.v.forEach(function (value, i) {
    var row = map.ny - 1 - Math.floor(i / map.nx), share = (value - scale[0]) / (scale[1] - scale[0]);
    paint(image, 4 * (row * map.nx + i % map.nx), value === null ? 0x999999 : color(palette, share));
  });
  context.putImageData(image, 0, 0);
  bar(figure, palette, scale, map.unit);
}
all('figure.map', function (figure) {
  var map = data[figure.dataset.map], canvas = figure.querySelector('canvas');
  canvas.width = map.nx;
  canvas.height = map.ny;
  drawMap(figure, false);
  follow(canvas, figure, function (u, v) {
    if (u < 0 || u >= 1 || v < 0 || v >= 1) { return ''; }
    var ix = Math.floor(u * map.nx), iy = Math.floor((1 - v) * map.ny), i = Math.min(iy, map.ny - 1) * map.nx + ix;
    return 'x ' + digits(map.x0 + (ix + 0.5) * map.dx) + ' mm, y ' + digits(map.y0 + (iy + 0.5) * map.dy) + ' mm: ' +
      measured(map.v[i], map.s[i]) + (map.unit ? ' ' + map.unit : '');
  });
});
all('button[data-scales]', function (button) {
  var own = false, texts = ['Give each map its own scale', 'Back to one common scale'];
  button.textContent = texts[0];
  button.addEventListener('click', function () {
    own = !own;
    button.textContent = texts[own ? 1 : 0];
    Array.prototype.forEach.call(document.getElementById(button.dataset.scales).querySelectorAll('figure.map'),
      function (figure) { drawMap(figure, own); });
  });
});

function polarBin(polar, azimuths, x, y) {
  var theta = 90 * Math.hypot(x, y), phi = (Math.atan2(y, x) * 180 / Math.PI + 360) % 360;
  for (var p = 0; p + 1 < polar.length; ++p) {
    if (theta >= polar[p] && theta < polar[p + 1]) {
      return {i: p * azimuths + Math.min(azimuths - 1, Math.floor(phi / 360 * azimuths)), theta: theta, phi: phi};
    }
  }
  return null;
}
all('figure.polar', function (figure) {
  var set = data[figure.dataset.polar], canvas = figure.querySelector('canvas'), size = 640;
  var scale = [0, set.top], palette = palettes[set.colors];
  canvas.width = canvas.height = size;
  var context = canvas.getContext('2d'), image = context.createImageData(size, size);
  for (var at = 0; at < size * size; ++at) {
    var x = (at % size + 0.5) / size * 2 - 1, y = 1 - (Math.floor(at / size) + 0.5) / size * 2;
    var bin = polarBin(set.polar, set.azimuths, x, y);
    if (bin) { paint(image, 4 * at, set.v[bin.i] === null ? 0x999999 : color(palette, set.v[bin.i] / scale[1])); }
  }
  context.putImageData(image, 0, 0);
  context.font = '24px system-ui, sans-serif';
  context.lineWidth = 2;
  [30, 60].forEach(function (theta) {
    context.strokeStyle = 'rgba(255,255,255,.55)';
    context.beginPath();
    context.arc(size / 2, size / 2, theta / 90 * size / 2, 0, 2 * Math.PI);
    context.stroke();
    context.fillStyle = 'rgba(255,255,255,.9)';
    context.strokeStyle = 'rgba(0,0,0,.45)';
    context.strokeText(theta + '\u00b0', size / 2 + 6, size / 2 - theta / 90 * size / 2 + 28);
    context.fillText(theta + '\u00b0', size / 2 + 6, size / 2 - theta / 90 * size / 2 + 28);
  });
  bar(figure, palette, scale, set.unit);
  follow(canvas, figure, function (u, v) {
    var bin = u < 0 ? null : polarBin(set.polar, set.azimuths, 2 * u - 1, 1 - 2 * v);
    return bin ? 'polar ' + bin.theta.toFixed(0) + '\u00b0, azimuth ' + bin.phi.toFixed(0) + '\u00b0: ' +
      measured(set.v[bin.i], set.s[bin.i]) + ' ' + set.unit : '';
  });
});

all('figure.curves', function (figure) {
  var plot = data[figure.dataset.curves], svg = figure.querySelector('svg'), view = svg.viewBox.baseVal;
  var guide = document.createElementNS('http://www.w3.org/2000/svg', 'line');
  guide.setAttribute('class', 'guide');
  guide.setAttribute('y1', 0.14 * view.height);
  guide.setAttribute('y2', 0.84 * view.height);
  guide.style.display = 'none';
  svg.insertBefore(guide, svg.firstChild);
  follow(svg, figure, function (u) {
    var best = null, wanted = plot.range[0] + (u - plot.area[0]) / (plot.area[1] - plot.area[0]) * (plot.range[1] - plot.range[0]);
    plot.curves.forEach(function (curve) {
      curve.x.forEach(function (x) { if (x !== null && (best === null || Math.abs(x - wanted) < Math.abs(best - wanted))) { best = x; } });
    });
    guide.style.display = u < 0 || best === null ? 'none' : '';
    if (u < 0 || best === null) { return ''; }
    var place = plot.area[0] + (best - plot.range[0]) / (plot.range[1] - plot.range[0]) * (plot.area[1] - plot.area[0]);
    guide.setAttribute('x1', place * view.width);
    guide.setAttribute('x2', place * view.width);
    var parts = [];
    plot.curves.forEach(function (curve) {
      var i = curve.x.indexOf(best);
      if (i >= 0) { parts.push(curve.n + ' ' + measured(curve.y[i], curve.s[i])); }
    });
    return plot.x + ' ' + digits(best) + ': ' + parts.join('; ');
  });
});
window.addEventListener('beforeprint', function () { all('details.variant', function (part) { part.open = true; }); });
}());
)js";
}

}  // namespace evenglow::design
