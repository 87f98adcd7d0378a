#pragma once
#include <string>
#include <vector>

#include "body/description.hpp"
#include "script/session.hpp"

namespace ricochet {

/// How a plane is cut from a material.
struct Section {
  std::string state = "plane_stress";
  double thickness = 1;

  static const std::vector<Member<Section>>& fields() {
    static const std::vector<Member<Section>> list{
        {{"state",
          "string",
          "",
          "of a body of a material: plane_stress, a sheet that is free to bulge; plane_strain, a long cylinder",
          any_number,
          "plane_stress",
          false,
          {"plane_stress", "plane_strain"}},
         &Section::state},
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
