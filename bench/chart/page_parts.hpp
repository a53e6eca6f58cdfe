// The files page.html, page.css, page.js and plot.css, as strings (cmake/embed.cmake).
#pragma once

namespace tessera::chart {

extern const char *const page_html, *const page_css, *const page_js, *const plot_css;

}  // namespace tessera::chart
