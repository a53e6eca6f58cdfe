// The files page.html, page.css and page.js, as strings (cmake/embed.cmake).
#pragma once

namespace tessera::chart {

extern const char *const page_html, *const page_css, *const page_js;

}  // namespace tessera::chart
