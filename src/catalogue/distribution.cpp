// The catalogue's methods: distribution.
#include "catalogue/method.hpp"

namespace tessera::catalogue {

std::vector<Method> distribution_methods() { return {}; }

}  // namespace tessera::catalogue
