#include "design/report/html_script.h"

namespace evenglow::design {

std::string_view map_script() {
  return R"js(
var rainbow = false;
function paletteOf(name) { return palettes[rainbow && name !== 'difference' ? 'rainbow' : name]; }
function mapOf(figure) { return data[figure.dataset.map]; }
function ownScale(map) {
  var range = extent(map.v);
  if (map.colors !== 'difference') { return range; }
  var most = Math.max(Math.abs(range[0]), Math.abs(range[1]));
  return [-most, most];
}
function drawMap(figure) {
  var map = mapOf(figure), canvas = figure.querySelector('canvas');
  var scale = figure.dataset.own ? ownScale(map) : map.scale, palette = paletteOf(map.colors);
  var context = canvas.getContext('2d'), image = context.createImageData(map.nx, map.ny);
  map.v.forEach(function (value, i) {
    var row = map.ny - 1 - Math.floor(i / map.nx), share = (value - scale[0]) / (scale[1] - scale[0]);
    paint(image, 4 * (row * map.nx + i % map.nx), value === null ? 0x999999 : color(palette, share));
  });
  context.putImageData(image, 0, 0);
  bar(figure, palette, scale, map.unit);
}
function centerX(map, ix) { return map.x0 + (ix + 0.5) * map.dx; }
function centerY(map, iy) { return map.y0 + (iy + 0.5) * map.dy; }
function clampTo(value, count) { return Math.min(count - 1, Math.max(0, Math.floor(value))); }
function valueText(map, ix, iy) {
  var i = iy * map.nx + ix;
  return measured(map.v[i], map.s[i]);
}
function placeText(map, ix, iy) {
  return 'x ' + digits(centerX(map, ix)) + ' mm, y ' + digits(centerY(map, iy)) + ' mm: ';
}

// A group of maps shows one cell in all of them: the one under the pointer, else the chosen one.
function makeGroup(box) {
  var group = {box: box, figures: Array.prototype.slice.call(box.querySelectorAll('figure.map')), tell: null, chosen: null};
  if (!group.figures.length) { return null; }
  group.show = function (figure, ix, iy) {
    var map = mapOf(figure);
    group.figures.forEach(function (other) {
      var seen = mapOf(other), same = seen.nx === map.nx && seen.ny === map.ny;
      cross(other, same ? (ix + 0.5) / map.nx : -1, (iy + 0.5) / map.ny);
    });
    if (group.tell) { group.tell(figure, ix, iy); }
  };
  group.choose = function (figure, ix, iy) {
    group.chosen = [figure, ix, iy];
    group.show(figure, ix, iy);
  };
  group.rest = function () { group.show.apply(null, group.chosen); };
  return group;
}
function cross(figure, u, v) {
  var lines = figure.querySelectorAll('.cross');
  lines[0].style.left = 100 * u + '%';
  lines[1].style.bottom = 100 * v + '%';
  lines[0].hidden = lines[1].hidden = u < 0;
}
function watchMap(figure, group) {
  var map = mapOf(figure), canvas = figure.querySelector('canvas'), read = figure.querySelector('.read');
  var hint = read.textContent;
  function cellAt(event) {
    var place = canvas.getBoundingClientRect();
    return [clampTo((event.clientX - place.left) / place.width * map.nx, map.nx),
      clampTo((1 - (event.clientY - place.top) / place.height) * map.ny, map.ny)];
  }
  function readOut(cell) {
    read.textContent = placeText(map, cell[0], cell[1]) + valueText(map, cell[0], cell[1]) + (map.unit ? ' ' + map.unit : '');
  }
  canvas.addEventListener('pointermove', function (event) {
    var cell = cellAt(event);
    readOut(cell);
    if (group) { group.show(figure, cell[0], cell[1]); }
  });
  canvas.addEventListener('pointerleave', function () {
    read.textContent = hint;
    if (group) { group.rest(); }
  });
  canvas.addEventListener('click', function (event) {
    var cell = cellAt(event);
    readOut(cell);
    if (group) { group.choose(figure, cell[0], cell[1]); }
  });
  canvas.addEventListener('keydown', function (event) {
    var step = {ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1]}[event.key];
    if (!step || !group) { return; }
    event.preventDefault();
    var cell = [clampTo(group.chosen[1] + step[0], map.nx), clampTo(group.chosen[2] + step[1], map.ny)];
    readOut(cell);
    group.choose(figure, cell[0], cell[1]);
  });
}
all('figure.map', function (figure) {
  var map = mapOf(figure), canvas = figure.querySelector('canvas'), field = figure.querySelector('.field');
  ['v', 'h'].forEach(function (way) {
    var line = document.createElement('i');
    line.className = 'cross ' + way;
    line.hidden = true;
    field.appendChild(line);
  });
  canvas.width = map.nx;
  canvas.height = map.ny;
  drawMap(figure);
});
all('button[data-scales]', function (button) {
  var own = false, texts = ['Give each map its own scale', 'Back to one common scale'];
  var figures = document.getElementById(button.dataset.scales).querySelectorAll('figure.map');
  button.textContent = texts[0];
  var quantities = Array.prototype.map.call(figures, function (figure) { return mapOf(figure).quantity; });
  button.hidden = quantities.every(function (quantity, i) { return quantities.indexOf(quantity) === i; });
  button.addEventListener('click', function () {
    own = !own;
    button.textContent = texts[own ? 1 : 0];
    Array.prototype.forEach.call(figures, function (figure) {
      figure.dataset.own = own ? 'yes' : '';
      drawMap(figure);
    });
  });
});
function tellPalette() {
  all('button[data-palette]', function (button) {
    button.textContent = rainbow ? 'Back to perceptually uniform colors' : 'Rainbow colors, as in the literature';
  });
}
tellPalette();
all('button[data-palette]', function (button) {
  var figures = button.parentNode.nextElementSibling.querySelectorAll('figure.map');
  button.hidden = Array.prototype.every.call(figures, function (figure) { return mapOf(figure).colors === 'difference'; });
  button.addEventListener('click', function () {
    rainbow = !rainbow;
    tellPalette();
    all('figure.map', drawMap);
    all('figure.polar', drawDisc);
  });
});
)js";
}

}  // namespace evenglow::design
