// The catalogue's methods: masking.
#include "catalogue/method.hpp"

namespace tessera::catalogue {

std::vector<Method> masking_methods() { return {}; }

}  // namespace tessera::catalogue
