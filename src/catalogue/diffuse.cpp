// The catalogue's methods: diffuse.
#include "catalogue/method.hpp"

namespace tessera::catalogue {

std::vector<Method> diffuse_methods() { return {}; }

}  // namespace tessera::catalogue
