_G.print = nil; _ENV = nil; print(1)
