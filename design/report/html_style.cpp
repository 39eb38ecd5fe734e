#include "design/report/html_page.h"

namespace evenglow::design {

std::string_view page_style() {
  return R"css(
:root { color-scheme: light dark; --bg: #fbfbfa; --panel: #ffffff; --text: #1c2126; --muted: #5c656e; --grid: #e2e5e8;
  --line: #dfe2e5; --accent: #17609f; --s1: #1761b8; --s2: #c25708; --s3: #15805f; --s4: #8449ab; --s5: #94740a;
  --s6: #bd2f55; --rest: #b9c0c7; }
@media (prefers-color-scheme: dark) {
  :root { --bg: #14171a; --panel: #1b1f23; --text: #e6e9ec; --muted: #9ba5ae; --grid: #30363c; --line: #30363c;
    --accent: #7db8ee; --s1: #6fb0f2; --s2: #f0965a; --s3: #56c7a0; --s4: #c594e6; --s5: #d6b64c; --s6: #ef7f9b;
    --rest: #515a63; } }
* { box-sizing: border-box; }
body { margin: 0; background: var(--bg); color: var(--text); font: 16px/1.5 system-ui, "Segoe UI", "DejaVu Sans", sans-serif;
  overflow-wrap: anywhere; }
main { max-width: 1180px; margin: 0 auto; padding: 28px 20px 48px; }
h1 { font-size: 1.7rem; line-height: 1.25; margin: 0 0 4px; font-weight: 650; }
h2 { font-size: 1.15rem; margin: 44px 0 10px; padding-top: 14px; border-top: 1px solid var(--line); font-weight: 650; }
h3 { font-size: 1rem; margin: 28px 0 8px; }
p { margin: 6px 0; max-width: 78ch; }
.sub, .def, figcaption small, .hint { color: var(--muted); }
.def, .hint { font-size: .86rem; line-height: 1.4; }
.cards { display: grid; grid-template-columns: repeat(auto-fit, minmax(220px, 1fr)); gap: 14px; margin: 22px 0 6px; }
.card { background: var(--panel); border: 1px solid var(--line); border-radius: 8px; padding: 14px 16px; }
.card h3 { margin: 0; font-size: .86rem; font-weight: 500; color: var(--muted); }
.card strong { display: block; font-size: 1.5rem; font-weight: 600; line-height: 1.3; margin: 2px 0 4px;
  font-variant-numeric: tabular-nums; }
.card strong small { font-size: .62em; font-weight: 400; color: var(--muted); white-space: nowrap; }
.two, .three { display: grid; gap: 26px 26px; margin-bottom: 26px; grid-template-columns: repeat(auto-fill, minmax(min(100%, 420px), 1fr)); }
.three { grid-template-columns: repeat(auto-fill, minmax(min(100%, 320px), 1fr)); }
figure { margin: 0; min-width: 0; }
figcaption { font-weight: 600; margin-bottom: 6px; }
figcaption small { display: block; font-weight: 400; font-size: .86rem; }
svg { display: block; width: 100%; max-width: 560px; height: auto; touch-action: pan-y; }
svg text { font-family: inherit; }
.section svg { max-width: none; }
.i-text { --c: var(--text); } .i-muted { --c: var(--muted); } .i-grid { --c: var(--grid); }
.i-s1 { --c: var(--s1); } .i-s2 { --c: var(--s2); } .i-s3 { --c: var(--s3); } .i-s4 { --c: var(--s4); }
.i-s5 { --c: var(--s5); } .i-s6 { --c: var(--s6); }
.st { fill: none; stroke: var(--c); stroke-linejoin: round; } .fi { fill: var(--c); }
.ring { fill: var(--bg); stroke: var(--c); stroke-width: 1.4; } .band { fill: var(--c); opacity: .2; }
.guide { stroke: var(--muted); stroke-width: 1; }
.keys { display: flex; flex-wrap: wrap; gap: 2px 18px; font-size: .86rem; }
.keys i { display: inline-block; width: 20px; vertical-align: middle; margin-right: 6px; border-top: 2.5px solid var(--c); }
.keys .dash i { border-top-style: dashed; border-top-width: 2px; }
.keys .dot i { width: 10px; height: 10px; border: 1.6px solid var(--c); transform: rotate(45deg); }
.read { display: block; min-height: 1.4em; font-size: .86rem; color: var(--muted); font-variant-numeric: tabular-nums; }
.map .field { position: relative; margin: 0 8px 40px 44px; }
.map canvas { display: block; width: 100%; image-rendering: pixelated; cursor: crosshair; touch-action: pan-y; }
.map .cross { position: absolute; pointer-events: none; background: #fff; mix-blend-mode: difference; opacity: .8; }
.map .cross[hidden] { display: none; } .map .cross.v { width: 1px; top: 0; bottom: 0; } .map .cross.h { height: 1px; left: 0; right: 0; }
.map canvas:focus-visible { outline: 2px solid var(--accent); outline-offset: 1px; }
.tools { display: flex; flex-wrap: wrap; gap: 0 10px; }
.cut { display: grid; gap: 8px 26px; margin: -8px 0 26px; grid-template-columns: repeat(auto-fill, minmax(min(100%, 420px), 1fr)); }
.cut svg { cursor: crosshair; } .cut figcaption { font-size: .86rem; } .cut .read { grid-column: 1 / -1; }
.cut .key { margin-left: 14px; white-space: nowrap; }
.cut .key i { display: inline-block; width: 16px; vertical-align: middle; margin-right: 5px; border-top: 2.5px solid var(--c); }
.map .ticks span { position: absolute; font-size: .75rem; line-height: 1; color: var(--muted); white-space: nowrap; }
.map .tx span { top: calc(100% + 7px); transform: translateX(-50%); }
.map .ty span { right: calc(100% + 7px); transform: translateY(50%); }
.map .ticks .axis { font-size: .75rem; }
.map .tx .axis { top: calc(100% + 22px); left: 50%; }
.map .ty .axis { right: calc(100% + 26px); bottom: 50%; transform: translateY(50%) rotate(180deg); writing-mode: vertical-rl; }
.bar { display: flex; align-items: center; gap: 8px; font-size: .8rem; color: var(--muted); margin: 0 8px 0 44px;
  font-variant-numeric: tabular-nums; }
.bar i { flex: 1 1 auto; height: 11px; min-width: 60px; border-radius: 2px; }
.polar canvas { width: min(100%, 320px); display: block; cursor: crosshair; touch-action: pan-y; }
.polar .bar { margin: 8px 0 0; max-width: 320px; }
button { font: inherit; font-size: .86rem; color: var(--accent); background: none; border: 1px solid var(--line);
  border-radius: 6px; padding: 3px 10px; cursor: pointer; margin: 4px 0 12px; }
button:hover, button:focus-visible { border-color: var(--accent); }
.scroll { overflow-x: auto; }
table { border-collapse: collapse; font-size: .92rem; font-variant-numeric: tabular-nums; margin: 8px 0; }
th, td { padding: 5px 18px 5px 0; text-align: left; vertical-align: top; border-bottom: 1px solid var(--line);
  overflow-wrap: normal; }
th { font-weight: 600; } thead th { color: var(--muted); font-weight: 500; vertical-align: bottom; }
td.n, th.n { text-align: right; white-space: nowrap; } tr.sum > * { font-weight: 600; border-bottom: 0; }
table.facts td { overflow-wrap: anywhere; } table.facts th { white-space: nowrap; font-weight: 500; color: var(--muted); }
.flow { fill-opacity: .38; }
.spots td { white-space: nowrap; } .flows figcaption { margin-top: 6px; } g:hover > .flow { fill-opacity: .6; }
.f-source { fill: var(--muted); } .f-side, .f-absorbed { fill: var(--rest); }
.swatch { display: inline-block; width: 11px; height: 11px; border-radius: 2px; margin-right: 8px; }
.e0 { background: var(--s1); fill: var(--s1); } .e1 { background: var(--s2); fill: var(--s2); }
.e2 { background: var(--s3); fill: var(--s3); } .e3 { background: var(--s4); fill: var(--s4); }
.e4 { background: var(--s5); fill: var(--s5); } .e5 { background: var(--s6); fill: var(--s6); }
.e6 { background: var(--s1); fill: var(--s1); opacity: .6; } .e7 { background: var(--s2); fill: var(--s2); opacity: .6; }
.e8 { background: var(--s3); fill: var(--s3); opacity: .6; } .e9 { background: var(--s4); fill: var(--s4); opacity: .6; }
.e10 { background: var(--rest); fill: var(--rest); }
pre { background: var(--panel); border: 1px solid var(--line); border-radius: 6px; padding: 12px 14px; overflow-x: auto;
  font: .82rem/1.45 ui-monospace, "DejaVu Sans Mono", monospace; overflow-wrap: normal; }
code { font: .88em ui-monospace, "DejaVu Sans Mono", monospace; }
details { border: 1px solid var(--line); border-radius: 8px; padding: 10px 16px; margin: 12px 0; background: var(--panel); }
details details { background: var(--bg); } summary { cursor: pointer; font-weight: 600; }
details .card { background: var(--bg); } details .ring { fill: var(--panel); }
ul { padding-left: 20px; margin: 6px 0; }
@media (max-width: 520px) { main { padding: 18px 14px 32px; } h1 { font-size: 1.35rem; } th, td { padding-right: 12px; }
  details { padding: 8px 10px; } }
@media print {
  :root { --bg: #fff; --panel: #fff; --text: #000; --muted: #444; --grid: #ddd; --line: #ccc; --accent: #000; --s1: #1761b8;
    --s2: #c25708; --s3: #15805f; --s4: #8449ab; --s5: #94740a; --s6: #bd2f55; --rest: #b9c0c7; color-scheme: light; }
  * { print-color-adjust: exact; -webkit-print-color-adjust: exact; }
  body { font-size: 10pt; } main { max-width: none; padding: 0; } button, .hint, .read:not(.cutread), .map .cross { display: none; }
  figure, .card, tr { break-inside: avoid; } h2, h3, h2 + p, h3 + p { break-after: avoid; } pre { white-space: pre-wrap; }
  .two, .cut { grid-template-columns: 1fr 1fr; } .three { grid-template-columns: 1fr 1fr 1fr; } .scroll { overflow: visible; } }
)css";
}

}  // namespace evenglow::design
