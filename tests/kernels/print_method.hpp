// How GoogleTest names a method of the catalogue in its messages.
#pragma once
#include <ostream>

#include "catalogue/method.hpp"

namespace tessera::catalogue {

inline void PrintTo(const Method& method, std::ostream* out) { *out << method.title; }

}  // namespace tessera::catalogue
