// The catalogue's methods: fresnel.
#include "catalogue/method.hpp"

namespace tessera::catalogue {

std::vector<Method> fresnel_methods() { return {}; }

}  // namespace tessera::catalogue
