#include <iterator>
#include <stdexcept>

#include "catalogue/method.hpp"

namespace tessera::catalogue {

const std::vector<Method>& methods() {
  static const std::vector<Method> all = [] {
    std::vector<Method> list;
    for (const auto family : {fresnel_methods, distribution_methods, masking_methods, diffuse_methods, energy_methods,
                              function_methods, blending_methods, dfg_methods}) {
      std::vector<Method> more = family();
      list.insert(list.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
    }
    return list;
  }();
  return all;
}

const Method& method_of(const std::string& term) {
  for (const Method& method : methods())
    if (method.term == term) return method;
  throw std::invalid_argument("no method for the term " + term);
}

}  // namespace tessera::catalogue
