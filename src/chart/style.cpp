#include "chart/style.hpp"

namespace tessera::chart {

const char* const plot_css = R"css(
svg { font-family: "Liberation Sans", Helvetica, Arial, "DejaVu Sans", sans-serif; font-size: 13px; }
.paper { fill: #ffffff; }
.title { font-size: 20px; font-weight: 600; fill: #14181f; }
.subtitle { fill: #4d5766; }
.caption { font-size: 11.5px; fill: #6b7584; }
.panel { fill: #f7f8fa; }
.grid { stroke: #d9dde4; stroke-width: 1; fill: none; }
.grid.minor { stroke: #eaedf1; }
.tick { fill: #4d5766; }
.tick.note { font-size: 11px; fill: #7b8594; }
.tickmark { stroke: #9aa3b0; }
.floor { stroke: #9aa3b0; stroke-dasharray: 5 4; }
.axis { fill: #2b323d; }
.beaten { fill: #1b63d6; fill-opacity: 0.05; }
.stairs { stroke: #1b63d6; stroke-width: 1.6; fill: none; stroke-linejoin: round; }
.better path { stroke: #14804a; stroke-width: 2.2; fill: none; stroke-linecap: round; }
.better text { fill: #14804a; font-weight: 600; }
.hit { fill: #000000; fill-opacity: 0; }
.spread { stroke: #1b63d6; stroke-width: 1.3; fill: none; }
.frontier .dot { fill: #1b63d6; stroke: #ffffff; stroke-width: 1.3; }
.dominated .dot { fill: #b4bcc9; stroke: #ffffff; stroke-width: 1.3; }
.dominated .spread { stroke: #b4bcc9; }
.arithmetic { fill: #ffffff; stroke: #c2560a; stroke-width: 1.5; }
.other { fill: none; stroke: #8a3fb8; stroke-width: 1.6; }
.moved { stroke: #8a3fb8; stroke-width: 1; stroke-dasharray: 2 3; fill: none; }
.label { paint-order: stroke; stroke: #f7f8fa; stroke-width: 3px; stroke-linejoin: round; }
.label.frontier { fill: #14181f; font-weight: 600; }
.label.dominated { fill: #5d6776; }
.leader { stroke: #9aa3b0; stroke-width: 0.9; fill: none; }
.legend text { fill: #4d5766; }
.map-title { font-size: 16px; font-weight: 600; fill: #14181f; }
.limit { stroke: #b3261e; stroke-width: 1.4; stroke-dasharray: 7 4; fill: none; }
.beyond { fill: #b3261e; fill-opacity: 0.05; }
.limit-name { fill: #b3261e; font-weight: 600; }
.chosen-ring { fill: none; stroke: #14804a; stroke-width: 2.4; }
.label.chosen { fill: #14804a; font-weight: 600; }
.series { fill: none; stroke-width: 1.8; stroke-linejoin: round; }
.series-dot { stroke: #ffffff; stroke-width: 1.3; }
.proportional { stroke: #9aa3b0; stroke-width: 1.2; stroke-dasharray: 2 4; fill: none; }
)css";

}  // namespace tessera::chart
