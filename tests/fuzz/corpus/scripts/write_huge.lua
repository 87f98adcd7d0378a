local ricochet = require "ricochet"
local s = ("x"):rep(1e9) for i = 1, 100 do ricochet.file.write("f" .. i, s) end
