local ricochet = require "ricochet"
for i = 1, 1e6 do ricochet.file.write("f" .. i, "x") end
