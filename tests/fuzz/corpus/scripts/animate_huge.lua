local ricochet = require "ricochet"
local s = ricochet.scene { projectile = ricochet.disk { nodes = 60 }, target = ricochet.wall { nodes = 150, width = 4 } } ricochet.animate { scene = s, frames = 1e9, size = {1e5, 1e5} }
