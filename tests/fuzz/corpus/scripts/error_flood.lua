local s = ("x"):rep(1e8) error(s)
