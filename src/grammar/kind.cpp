#include "grammar/kind.h"

namespace espalier {

std::string_view name_of(Kind kind) {
  switch (kind) {
    case Kind::number: return "number";
    case Kind::angle: return "angle";
    case Kind::vector: return "vector";
    case Kind::boolean: return "boolean";
    case Kind::text: return "text";
    case Kind::mesh: return "mesh";
    case Kind::material: return "material";
    case Kind::texture: return "texture";
  }
  return "?";
}

std::string_view phrase_of(Kind kind) {
  switch (kind) {
    case Kind::number: return "a number";
    case Kind::angle: return "an angle";
    case Kind::vector: return "a vector";
    case Kind::boolean: return "a boolean";
    case Kind::text: return "a text";
    case Kind::mesh: return "a mesh";
    case Kind::material: return "a material";
    case Kind::texture: return "a texture";
  }
  return "?";
}

}  // namespace espalier
