#include "design/report/html_script.h"

namespace evenglow::design {

std::string_view direction_script() {
  return R"js(
function polarBin(polar, azimuths, x, y) {
  var theta = 90 * Math.hypot(x, y), phi = (Math.atan2(y, x) * 180 / Math.PI + 360) % 360;
  for (var p = 0; p + 1 < polar.length; ++p) {
    if (theta >= polar[p] && theta < polar[p + 1]) {
      return {i: p * azimuths + Math.min(azimuths - 1, Math.floor(phi / 360 * azimuths)), theta: theta, phi: phi};
    }
  }
  return null;
}
function drawDisc(figure) {
  var set = data[figure.dataset.polar], canvas = figure.querySelector('canvas'), size = 480;
  var scale = [0, set.top], palette = paletteOf(set.colors);
  canvas.width = canvas.height = size;
  var context = canvas.getContext('2d'), image = context.createImageData(size, size);
  for (var at = 0; at < size * size; ++at) {
    var x = (at % size + 0.5) / size * 2 - 1, y = 1 - (Math.floor(at / size) + 0.5) / size * 2;
    var bin = polarBin(set.polar, set.azimuths, x, y);
    if (bin) { paint(image, 4 * at, set.v[bin.i] === null ? 0x999999 : color(palette, set.v[bin.i] / scale[1])); }
  }
  context.putImageData(image, 0, 0);
  context.font = '18px system-ui, sans-serif';
  context.lineWidth = 2;
  [30, 60].forEach(function (theta) {
    context.strokeStyle = 'rgba(255,255,255,.55)';
    context.beginPath();
    context.arc(size / 2, size / 2, theta / 90 * size / 2, 0, 2 * Math.PI);
    context.stroke();
    context.fillStyle = 'rgba(255,255,255,.9)';
    context.strokeStyle = 'rgba(0,0,0,.45)';
    context.strokeText(theta + '\u00b0', size / 2 + 6, size / 2 - theta / 90 * size / 2 + 21);
    context.fillText(theta + '\u00b0', size / 2 + 6, size / 2 - theta / 90 * size / 2 + 21);
  });
  bar(figure, palette, scale, set.unit);
}
all('figure.polar', function (figure) {
  var set = data[figure.dataset.polar], canvas = figure.querySelector('canvas');
  drawDisc(figure);
  follow(canvas, figure, function (u, v) {
    var bin = u < 0 ? null : polarBin(set.polar, set.azimuths, 2 * u - 1, 1 - 2 * v);
    return bin ? 'polar ' + bin.theta.toFixed(0) + '\u00b0, azimuth ' + bin.phi.toFixed(0) + '\u00b0: ' +
      measured(set.v[bin.i], set.s[bin.i]) + ' ' + set.unit : '';
  });
});

)js";
}

std::string_view curve_script() {
  return R"js(
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
)js";
}

}  // namespace evenglow::design
