// The catalogue's methods: function.
#include "catalogue/method.hpp"

namespace tessera::catalogue {

std::vector<Method> function_methods() { return {}; }

}  // namespace tessera::catalogue
