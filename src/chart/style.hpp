// How every chart looks: CSS over the classes that drawings use.
#pragma once

namespace tessera::chart {

extern const char* const plot_css;

}  // namespace tessera::chart
