#pragma once
#include <string>
#include <vector>

#include "body/description.hpp"
#include "script/session.hpp"

namespace ricochet {

/// How a plane is cut from a material, beside its state.
struct Section {
  double thickness = 1;

  static const std::vector<Member<Section>>& fields() {
    static const std::vector<Member<Section>> list{
        {{"thickness", "number", "m", "of a body of a material, across the plane: a disk is a cylinder of that length",
          positive, "1"},
         &Section::thickness},
    };
    return list;
  }
};

/// The body of the table at index 1, checked; functions of the place are asked at its nodes. Throws FieldError.
Body read_body(lua_State* L);

}  // namespace ricochet
