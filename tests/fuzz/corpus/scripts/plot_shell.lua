local ricochet = require "ricochet"
ricochet.plot { rows = {}, x = "`touch evil`", y = {"$(touch evil)"}, name = "p" }
