local s = (""):rep(1e18)
