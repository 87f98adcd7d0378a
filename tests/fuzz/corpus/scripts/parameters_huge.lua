local ricochet = require "ricochet"
local t = {} for i = 1, 1e6 do t["p" .. i] = i end ricochet.parameters(t)
