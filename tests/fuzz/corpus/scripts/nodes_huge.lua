local ricochet = require "ricochet"
ricochet.disk { nodes = 1e9 }
