// Methods that are not terms, for they read textures: ways to keep, order and filter texels, and to light by an
// environment. Charts take their texts from here.
#pragma once
#include <string>
#include <vector>

namespace tessera::catalogue {

struct Lookup {
  std::string family;  // "sampling", "ibl"
  std::string id;      // of [a-z0-9-]
  std::string title, formula, paper, file;
  std::string fails;  // where it fails, in words; empty: nowhere known
};

const std::vector<Lookup>& lookups();

/// Throws std::invalid_argument for an id that is not there.
const Lookup& lookup_of(const std::string& id);

}  // namespace tessera::catalogue
