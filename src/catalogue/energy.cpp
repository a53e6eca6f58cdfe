// The catalogue's methods: energy.
#include "catalogue/method.hpp"

namespace tessera::catalogue {

std::vector<Method> energy_methods() { return {}; }

}  // namespace tessera::catalogue
