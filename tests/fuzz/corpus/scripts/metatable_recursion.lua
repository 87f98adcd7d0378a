local t = setmetatable({}, {}) getmetatable(t).__index = function(_, k) return t[k] end print(t.x)
