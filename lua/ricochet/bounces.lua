-- scene:bounces: one impact after another, under gravity.
local core = require "ricochet.core"
local rows_of = require("ricochet.rows").rows_of

local function bounces(scene, given)
  if not core.is_scene(scene) then core.fail "is a method of a scene: write scene:bounces { ... }, with a colon" end
  local t = core.check("scene:bounces", given == nil and {} or given)
  local list, reason = core.bounces(scene, t.count, t.least_height)
  return rows_of(list), reason
end

core.add_scene_method("bounces", core.wrap(bounces))
