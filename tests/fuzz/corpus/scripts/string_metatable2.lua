string.format = nil; local s = ("x"):format()
